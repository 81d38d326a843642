// `measure broad_phase`: the settings of trees.
#include <algorithm>

#include <fmt/format.h>

#include "report/benches.hpp"
#include "report/pages.hpp"

namespace lantern::measure {

template <class Visit>
void each_field(const BroadPhaseCost& row, Visit&& visit) {
  const BroadPhaseCounts& c = row.counts;
  visit(Field("scene"), row.scene);
  visit(Field("dimension"), row.dimension);
  visit(Field("structure"), to_string(row.kind));
  visit(Field("capacity"), row.capacity);
  visit(Field("depth_limit"), row.depth_limit);
  visit(Field("bodies"), row.bodies);
  visit(Field("updates"), row.updates);
  visit(Field("all_pairs"), c.all_pairs);
  visit(Field("testable_pairs"), c.testable_pairs);
  visit(Field("true_pairs"), c.true_pairs);
  visit(Field("missed"), c.missed);
  visit(Field("invented"), c.invented);
  visit(Field("candidates"), c.candidates);
  visit(Field("false_candidates"), c.false_candidates());
  visit(Field("false_per_true"), row.false_per_true());
  visit(Field("pair_tests"), c.pair_tests);
  visit(Field("entries"), c.entries);
  visit(Field("entries_per_body"), row.entries_per_body());
  visit(Field("box_tests"), c.box_tests);
  visit(Field("nodes"), c.nodes);
  visit(Field("depth"), row.depth);
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
      json.line()
          .begin_object()
          .members("name", scene.name, "words", scene.words, "dimension", scene.dimension())
          .end_object();
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
      {"pair tests", [](auto& row) { return fmt::format("{}", row.counts.pair_tests); }},
      {"box tests", [](auto& row) { return fmt::format("{}", row.counts.box_tests); }},
      {"entries", [](auto& row) { return fmt::format("{}", row.counts.entries); }},
      {"false/true", [](auto& row) { return fmt::format("{:.2f}", row.false_per_true()); }},
      {"ent/body", [](auto& row) { return fmt::format("{:.2f}", row.entries_per_body()); }},
      {"nodes", [](auto& row) { return fmt::format("{}", row.counts.nodes); }},
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
    std::size_t all = 0;
    for (const BoxScene& scene : result_.config.scenes)
      all += broad_phase_rows(scene, result_.config);
    return all;
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
  Texts texts() const override { return texts_of(result_); }
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
    std::uint64_t wrong = 0;
    for (const BroadPhaseCost& row : result_.rows) wrong += wrong_of(row);
    if (wrong == 0) return "";
    return fmt::format("{} missed or invented; see the column 'wrong'",
                       wrong == 1 ? "1 pair is" : fmt::format("{} pairs are", wrong));
  }

 private:
  std::vector<std::string> files_;
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

}  // namespace lantern::report
