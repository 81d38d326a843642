// `measure broad_phase`: the settings of trees.

#include "draw/number_text.hpp"
#include "report/benches.hpp"
#include "report/pages.hpp"

namespace lantern::measure {

void each_field(const BroadPhaseCost& row, auto&& visit) {
  const BroadPhaseCounts& c = row.counts;
  visit_fields(visit, "scene", row.scene, "dimension", row.dimension, "structure",
               to_string(row.kind), "capacity", row.capacity, "depth_limit", row.depth_limit,
               "bodies", row.bodies, "updates", row.updates, "all_pairs", c.all_pairs,
               "testable_pairs", c.testable_pairs, "true_pairs", c.true_pairs, "missed", c.missed,
               "invented", c.invented, "candidates", c.candidates, "false_candidates",
               c.false_candidates(), "false_per_true", row.false_per_true(), "pair_tests",
               c.pair_tests, "entries", c.entries, "entries_per_body", row.entries_per_body(),
               "box_tests", c.box_tests, "nodes", c.nodes, "depth", row.depth);
  each_timing(row.timing, "seconds", "iqr", "seconds_iqr", visit);
}

}  // namespace lantern::measure

namespace lantern::report {
namespace {

constexpr std::size_t kBodies = 2000;
constexpr std::uint64_t kSeed = 1;

std::uint64_t wrong_of(const BroadPhaseCost& row) {
  return row.counts.missed + row.counts.invented;
}
std::string in_thousandths(double seconds) { return fmt::format("{:.3f}", 1e3 * seconds); }

Sheet<BroadPhaseCost> sheet_of(const BroadPhaseResult& result) {
  Sheet<BroadPhaseCost> sheet;
  sheet.format = "lantern.measure.broad_phase/2";
  sheet.title = "What it costs to find all pairs";
  sheet.about =
      "Each structure at its cheapest settings by counted work: comparisons of boxes with nodes "
      "while building and with each other while pairing. The files have all settings.";
  sheet.head = [&result](JsonWriter& json) {
    json.key("scenes").begin_array();
    for (const BoxScene& scene : result.config.scenes)
      json.line().object("name", scene.name, "words", scene.words, "dimension", scene.dimension());
    json.line().end_array();
  };
  sheet.who = [](const BroadPhaseCost& row) { return std::string(to_string(row.kind)); };
  sheet.chapter = [](const BroadPhaseCost& row) { return row.scene; };
  sheet.words = [&result](const BroadPhaseCost& row) -> std::vector<std::string> {
    const auto scene = std::ranges::find(result.config.scenes, row.scene, &BoxScene::name);
    return {scene == result.config.scenes.end() ? "" : scene->words};
  };
  sheet.columns = {
      {"cheapest settings",
       [](auto& row) {
         return row.has_settings()
                    ? fmt::format("capacity {}, depth limit {}", row.capacity, row.depth_limit)
                    : "";
       }},
      {"pair tests", [](auto& row) { return count_text(row.counts.pair_tests); }},
      {"box tests", [](auto& row) { return count_text(row.counts.box_tests); }},
      {"entries", [](auto& row) { return count_text(row.counts.entries); }},
      {"false/true", [](auto& row) { return fmt::format("{:.2f}", row.false_per_true()); }},
      {"ent/body", [](auto& row) { return fmt::format("{:.2f}", row.entries_per_body()); }},
      {"nodes", [](auto& row) { return count_text(row.counts.nodes); }},
      {"wrong", [](auto& row) { return fmt::format("{}", wrong_of(row)); }},
      {"ms", [](auto& row) { return in_thousandths(row.timing.median); }},
      {"least", [](auto& row) { return in_thousandths(row.timing.least); }},
      {"iqr", [](auto& row) { return in_thousandths(row.timing.spread()); }},
  };
  return sheet;
}

class BroadPhases : public ExperimentOf<BroadPhaseResult> {
 public:
  BroadPhases(std::vector<std::string> files, bool full) : files_(std::move(files)) {
    if (full) result_.config.timing = {15, 0.05};
  }
  Options options() override { return {{"FILE", &files_, "scenario files"}}; }
  void prepare() override {
    std::vector<BoxScene>& scenes = result_.config.scenes;
    if (files_.empty()) scenes = seeded_box_scenes(kBodies, kSeed);
    for (const std::string& file : files_) scenes.push_back(box_scene_of(load_scenario(file)));
  }
  std::string unit() const override { return "rows"; }
  std::size_t stages() const override {
    return sum_of<std::size_t>(result_.config.scenes, [&](const BoxScene& scene) {
      return broad_phase_rows(scene, result_.config);
    });
  }
  void run(const std::function<void(const std::string&)>& tell) override {
    std::size_t done = 0;
    for (const BoxScene& scene : result_.config.scenes) {
      const std::vector<BroadPhaseCost> more = measure_broad_phases(scene, result_.config, [&] {
        tell(fmt::format("{} of {} rows done, now {}", ++done, stages(), scene.name));
      });
      result_.rows.insert(result_.rows.end(), more.begin(), more.end());
    }
  }
  std::vector<Picture> pages() const override {
    std::vector<Picture> pages;
    for (const BoxScene& scene : result_.config.scenes)
      for (const StructureKind kind : kStructureKinds)
        if (const BroadPhaseCost* best = cheapest(result_.rows, scene.name, kind, CostBy::work);
            best != nullptr && best->has_settings())
          pages.push_back({fmt::format("broad_phase_{}_{}", scene.name, to_string(kind)),
                           draw_broad_phase_page(result_.rows, scene, kind)});
    return pages;
  }
  bool is_good() const override { return complaint().empty(); }
  std::string complaint() const override {
    const auto wrong = sum_of<std::uint64_t>(result_.rows, wrong_of);
    if (wrong == 0) return "";
    return fmt::format("{} missed or invented; see the column 'wrong'",
                       wrong == 1 ? "1 pair is" : fmt::format("{} pairs are", wrong));
  }

 private:
  std::vector<std::string> files_;
};

constexpr double kGridMargin = 60, kFoot = 836;

// Five tones of blue, light where it is cheap, in every theme; `above` is the largest ratio to the
// cheapest cell, `ink` what can be read on it.
struct GridTone {
  double above;
  Role fill, ink;
};
constexpr std::array<GridTone, 5> kTones = {
    {{1.1, in_tone(Role::body_6, Tone::lit), Role::pupil},
     {1.5, Role::body_6, Role::pupil},
     {2.5, in_tone(Role::body_4, Tone::lit), Role::pupil},
     {5, Role::body_4, Role::eye},
     {1e300, in_tone(Role::body_4, Tone::shade), Role::eye}}};

const GridTone& tone_of(double ratio) {
  return *std::ranges::find_if(kTones, [&](const GridTone& tone) { return ratio <= tone.above; });
}

std::string words_of(StructureKind kind) {
  const std::string words(traits_of(kind).words);
  return traits_of(kind).has(Setting::planes) ? words + " of medians" : words;
}

std::string ratio_text(double ratio) {
  return ratio < 9.95 ? fmt::format("{:.1f}×", ratio) : number_text(ratio) + "×";
}

double milliseconds(const BroadPhaseCost& row) { return 1e3 * row.timing.least; }

double work_of(const BroadPhaseCost& row) {
  return static_cast<double>(row.counts.work()) / static_cast<double>(row.updates);
}

class GridPage {
 public:
  GridPage(std::span<const BroadPhaseCost> rows, const BoxScene& scene, StructureKind kind)
      : rows_(rows), scene_(scene), kind_(kind), labels_(list_) {
    for (const BroadPhaseCost& row : rows) {
      if (row.scene != scene.name || row.kind != kind || !row.has_settings()) continue;
      capacities_.insert(row.capacity);
      depths_.insert(row.depth_limit);
    }
  }

  DrawList drawn() {
    title();
    if (capacities_.empty()) {
      labels_.add("Nothing was measured.", {{0.5 * list_.page.x, 450}, 0.5},
                  {30, Weight::regular, Role::quiet_ink, Role::none}, all());
      return std::move(list_);
    }
    const BroadPhaseCost* best = cheapest(rows_, scene_.name, kind_, CostBy::work);
    grid({{kGridMargin, 104}, {990, kFoot}}, CostBy::work, *best);
    const bool with_time = best->timing.repeats > 0;
    if (with_time)
      grid({{1060, 104}, {list_.page.x - kGridMargin, 500}}, CostBy::time,
           *cheapest(rows_, scene_.name, kind_, CostBy::time));
    others({{1060, with_time ? 536.0 : 104.0}, {list_.page.x - kGridMargin, kFoot}}, with_time);
    foot();
    return std::move(list_);
  }

 private:
  Box<2> all() const { return {Vec<2>(0.0), list_.page}; }

  void title() {
    const std::string text = fmt::format("Where to set capacity and depth limit of {} {}",
                                         words_of(kind_)[0] == 'o' ? "an" : "a", words_of(kind_));
    draw_page_title(text, scene_.words, kGridMargin, list_, labels_);
  }

  // Depth limits go down the page, as a tree does; capacities to the right.
  //
  //   counted work ...
  //                     leaf capacity
  //      depth limit    1    2    4
  //                2   [ ]  [ ]  [ ]
  void grid(const Box<2>& place, CostBy by, const BroadPhaseCost& best) {
    const bool large = by == CostBy::work;
    const TextStyle head{large ? 23.0 : 20.0, Weight::semibold, Role::ink, Role::none};
    const TextStyle tick{large ? 22.0 : 18.0, Weight::regular, Role::quiet_ink, Role::none};
    const std::string words =
        large ? "Box comparisons an update, building and pairing"
              : fmt::format("Milliseconds an update, least of {}", best.timing.repeats);
    labels_.add(words, {{place.lo.x, place.lo.y + head.size}, 0}, head, place);
    if (large)
      labels_.add("times the cheapest", {{place.hi.x, place.lo.y + head.size}, 1}, tick, place);

    const double left = place.lo.x + (large ? 128 : 62);
    const double top = place.lo.y + (large ? 112 : 84);
    const Vec<2> cell((place.hi.x - left) / static_cast<double>(capacities_.size()),
                      (place.hi.y - top) / static_cast<double>(depths_.size()));
    capacity_ticks({left, top}, cell.x, tick, place);
    labels_.add(large ? "depth limit" : "depth", {{place.lo.x, top - 0.55 * tick.size}, 0}, tick,
                place);
    double y = top;
    for (const std::uint32_t depth : depths_) {
      labels_.add(std::to_string(depth), {{left - 14, y + 0.5 * cell.y + 0.36 * tick.size}, 1},
                  tick, place);
      double x = left;
      for (const std::uint32_t capacity : capacities_) {
        if (const BroadPhaseCost* row = row_of(rows_, scene_.name, kind_, capacity, depth))
          cell_at({{x, y}, {x + cell.x, y + cell.y}}, *row, by, best);
        x += cell.x;
      }
      y += cell.y;
    }
    mark(best, {left, top}, cell, large);
  }

  void capacity_ticks(const Vec<2>& corner, double width, const TextStyle& style,
                      const Box<2>& place) {
    const double lower = corner.y - 0.55 * style.size, upper = lower - 1.35 * style.size;
    labels_.add("leaf capacity", {{corner.x + 0.12 * width, upper}, 0}, style, place);
    double x = corner.x + 0.5 * width;
    for (const std::uint32_t capacity : capacities_) {
      labels_.add(std::to_string(capacity), {{x, lower}, 0.5}, style, place);
      x += width;
    }
  }

  void cell_at(const Box<2>& box, const BroadPhaseCost& row, CostBy by,
               const BroadPhaseCost& best) {
    const bool large = by == CostBy::work;
    const double least = large ? work_of(best) : milliseconds(best);
    const double ratio = least > 0 ? (large ? work_of(row) : milliseconds(row)) / least : 1;
    const GridTone& tone = tone_of(ratio);
    list_.crisp_rect(box, tone.fill, {Role::paper, large ? 3.0 : 2.0});
    const bool cut_back = was_cut_back(rows_, row);
    const std::string mark = !cut_back ? "" : large ? " †" : "†";
    some_cut_back_ |= cut_back;
    const bool is_best = &row == &best;
    const std::string text = !is_best ? ratio_text(ratio)
                             : large  ? number_text(work_of(row))
                                      : short_number(milliseconds(row));
    const double size = !large ? 17.4 : is_best ? 24 : 23;
    const TextStyle style{size, is_best ? Weight::semibold : Weight::regular, tone.ink, Role::none};
    labels_.add(shortened(text + mark, box.size().x - 4, style),
                {box.center() + Vec<2>(0, 0.36 * size), 0.5}, style, box);
  }

  // The frame round the best cell, over its neighbours.
  void mark(const BroadPhaseCost& best, const Vec<2>& corner, const Vec<2>& cell, bool large) {
    const auto column = std::distance(capacities_.begin(), capacities_.find(best.capacity));
    const auto row = std::distance(depths_.begin(), depths_.find(best.depth_limit));
    const Vec<2> lo = corner + cell * Vec<2>(static_cast<double>(column), static_cast<double>(row));
    const double width = large ? 6 : 4;
    const Box<2> frame = shrunk({lo, lo + cell}, -0.5 * width);
    for (const Stroke& stroke : {Stroke{Role::paper, width + 5}, Stroke{Role::lit, width}})
      list_.shapes.emplace_back(RectShape{frame, 2, Role::none, stroke, true});
  }

  // What each structure needs at its best.
  void others(const Box<2>& place, bool with_time) {
    const TextStyle head{20, Weight::semibold, Role::ink, Role::none};
    const TextStyle plain{20, Weight::regular, Role::ink, Role::none};
    const TextStyle strong{20, Weight::semibold, Role::lit_ink, Role::none};
    const double right = place.hi.x, middle = with_time ? right - 120 : right;
    double y = place.lo.y + head.size;
    labels_.add("Cheapest capacity / limit", {{place.lo.x, y}, 0}, head, place);
    const TextStyle quiet{18, Weight::regular, Role::quiet_ink, Role::none};
    labels_.add("tests", {{middle, y}, 1}, quiet, place);
    if (with_time) labels_.add("time", {{right, y}, 1}, quiet, place);
    y += 34;
    const auto lines = std::ranges::count_if(kStructureKinds, [&](StructureKind kind) {
      return cheapest(rows_, scene_.name, kind, CostBy::work) != nullptr;
    });
    const double step = std::min(42.0, (place.hi.y - y) / static_cast<double>(lines));
    for (const StructureKind kind : kStructureKinds) {
      const BroadPhaseCost* row = cheapest(rows_, scene_.name, kind, CostBy::work);
      if (!row) continue;
      const TextStyle& style = kind == kind_ ? strong : plain;
      const std::string name = row->has_settings() ? fmt::format("{} {} / {}", words_of(kind),
                                                                 row->capacity, row->depth_limit)
                                                   : words_of(kind);
      const std::string work = number_text(work_of(*row));
      const double room = middle - text_width(work, style) - 12 - place.lo.x;
      labels_.add(shortened(name, room, style), {{place.lo.x, y}, 0}, style, place);
      labels_.add(work, {{middle, y}, 1}, style, place);
      if (with_time)
        labels_.add(short_number(milliseconds(*row)) + " ms", {{right, y}, 1}, style, place);
      y += step;
    }
  }

  void foot() {
    if (!some_cut_back_) return;
    const TextStyle quiet{20, Weight::regular, Role::quiet_ink, Role::none};
    labels_.add(
        "† The tree would hold more than 64 entries a body: its depth limit was halved until it "
        "does not.",
        {{kGridMargin, kFoot + 40}, 0}, quiet,
        {{kGridMargin, kFoot}, {list_.page.x - kGridMargin, list_.page.y}});
  }

  std::span<const BroadPhaseCost> rows_;
  const BoxScene& scene_;
  StructureKind kind_;
  std::set<std::uint32_t> capacities_, depths_;
  bool some_cut_back_ = false;
  DrawList list_;
  Labels labels_;
};

}  // namespace

Texts texts_of(const BroadPhaseResult& result) {
  const Sheet<BroadPhaseCost> sheet = sheet_of(result);
  BroadPhaseResult told{result.config, result.circumstances, result.command, {}, {}, {}};
  for (const BoxScene& scene : result.config.scenes)
    for (const StructureKind kind : kStructureKinds)
      if (const auto* best = cheapest(result.rows, scene.name, kind, CostBy::work)) {
        told.rows.push_back(*best);
        const std::string name(to_string(kind));
        if (std::ranges::find(told.contestants, name, &Contestant::name) == told.contestants.end())
          told.contestants.push_back({name, "", ""});
      }
  return texts_of(result, sheet, document_of(told, sheet));
}

std::unique_ptr<Experiment> broad_phases(std::vector<std::string> files, bool full) {
  return std::make_unique<BroadPhases>(std::move(files), full);
}

DrawList draw_broad_phase_page(std::span<const BroadPhaseCost> rows, const BoxScene& scene,
                               StructureKind kind) {
  return GridPage(rows, scene, kind).drawn();
}

}  // namespace lantern::report
