// `bench atlas`: how full texture atlases become, and how soon.

#include "base/number.hpp"
#include "report/benches.hpp"

namespace lantern::measure {

void each_field(const AtlasRow& row, auto&& visit) {
  visit_fields(visit, "set", row.set, "textures", row.textures, "contestant", row.contestant,
               "version", row.version, "status", row.status, "reason", row.reason, "width",
               row.width, "height", row.height, "fill", row.fill, "packed", row.packed, "turned",
               row.turned);
  each_timing(row.timing, "seconds", "interquartile_range", "seconds_interquartile_range", visit);
  const bool searched = row.searching.repeats > 0;
  visit(Field("median", "search_seconds_median", "search_seconds"),
        IfTimed(row.searching.median, searched));
  visit(Field("lower_quartile", "search_seconds_lower_quartile", "search_seconds"),
        IfTimed(row.searching.lower_quartile, searched));
  visit(Field("upper_quartile", "search_seconds_upper_quartile", "search_seconds"),
        IfTimed(row.searching.upper_quartile, searched));
  visit_fields(visit, "sides_tried", row.sides, "leaf_tests", row.leaf_tests, "bytes", row.bytes,
               "overlaps", row.overlaps, "outside", row.outside, "wrong_sizes", row.wrong_sizes);
}

}  // namespace lantern::measure

namespace lantern::report {
namespace {

std::string in_ms(double seconds) { return fmt::format("{:.3g}", 1e3 * seconds); }

Cell remark_on(const AtlasRow& row) {
  return {row.status + (row.reason.empty() ? "" : ": " + row.reason), row.status == "wrong"};
}

// Up is fuller, left is sooner.
Sheet<AtlasRow>::Curve fill_curve(bool search) {
  Plot plot;
  plot.title = search ? "Searching the smallest square" : "Packing into it";
  plot.x_name = "ms of the processor, median; whiskers: quartiles";
  plot.y_name = "% of the atlas under textures: upper left is better";
  plot.log_y = false;
  return {plot, [search](const AtlasRow& row) -> std::optional<PlotPoint> {
            const Timing& timing = search ? row.searching : row.timing;
            if (row.status != "ok" || timing.repeats == 0) return std::nullopt;
            return level_point(timing, 1e3, 100 * row.fill);
          }};
}

Sheet<AtlasRow> sheet_of(const AtlasBenchResult& result) {
  const AtlasBenchConfig& config = result.config;
  Sheet<AtlasRow> sheet;
  sheet.format = "lantern.bench.atlas/1";
  sheet.title = "Texture atlases: how full, how soon";
  sheet.about = config.atlas
                    ? "Textures packed into an atlas of a given size."
                    : "Textures packed into the smallest square: sides from the square root of "
                      "their area up by 0.2 % until all fit. ms: of one packing into that square, "
                      "median and quartiles; search: of all sides tried.";
  sheet.about +=
      " Contestants take turns; ms are of the processor. Each layout is checked: nothing overlaps, "
      "all lies inside, sizes are right. Points of fullness, and times as fast: beside the fullest "
      "other packer.";
  sheet.head = [&config](JsonWriter& json) {
    json.members("rounds", config.rounds, "seed", config.seed);
  };
  sheet.lists = [&result](JsonWriter& json) {
    write_rows("contestants", result.contestants, json);
  };
  sheet.who = [](const AtlasRow& row) { return row.contestant; };
  sheet.chapter = [](const AtlasRow& row) {
    return fmt::format("{}, {} textures", row.set, count_text(row.textures));
  };
  sheet.words = [](const AtlasRow& row) -> std::vector<std::string> {
    return {texture_set_words(row.set)};
  };
  const auto beside = [&result](const AtlasRow& row, const auto& text) -> std::string {
    const AtlasRow* peer = fullest_peer(result.rows, row);
    if (!peer || row.is_peer() || row.status != "ok" || !(row.timing.median > 0)) return "";
    return text(*peer);
  };
  sheet.columns = {
      {"full", [](auto& row) { return fmt::format("{:.2f}%", 100 * row.fill); }},
      {"atlas", [](auto& row) { return fmt::format("{} x {}", row.width, row.height); }},
      {"textures", [](auto& row) { return count_text(row.packed); }},
      {"ms", [](auto& row) { return in_ms(row.timing.median); }},
      {"quartiles", [](auto& row) { return range_text(row.timing, 1e3); }},
      {"search ms",
       [](auto& row) { return row.searching.repeats > 0 ? in_ms(row.searching.median) : "-"; }},
      {"sides", [](auto& row) { return count_text(row.sides); }},
      {"leaf tests",
       [](auto& row) { return row.leaf_tests > 0 ? count_text(row.leaf_tests) : "-"; }},
      {"bytes", [](auto& row) { return count_text(row.bytes); }},
      {"points",
       [=](auto& row) {
         return beside(row, [&](const AtlasRow& peer) {
           return fmt::format("{:+.2f}", 100 * (row.fill - peer.fill));
         });
       }},
      {"times",
       [=](auto& row) {
         return beside(row, [&](const AtlasRow& peer) {
           return fmt::format("{:.3g}", peer.timing.median / row.timing.median);
         });
       }},
  };
  sheet.has_numbers = [](const AtlasRow& row) { return row.status != "left out"; };
  sheet.remark = remark_on;
  sheet.curves = {fill_curve(false)};
  if (!config.atlas) sheet.curves.push_back(fill_curve(true));
  return sheet;
}

class AtlasBench : public ExperimentOf<AtlasBenchResult> {
 public:
  Options options() override {
    AtlasBenchConfig& c = result_.config;
    c.counts.clear();
    return {option("--set", &c.sets, {.value = "NAME", .one_each = true},
                   "only these: square, powers, tall, glyphs"),
            option("--count", &c.counts, {.value = "N", .least = 1, .most = 1e6, .one_each = true},
                   "textures of each set; the default is 500 and 5000"),
            option("--sizes", &sizes_, {.value = "FILE", .without = "--set,--count"},
                   "textures of your own instead: CSV, a line WIDTH,HEIGHT each"),
            option("--size", &atlas_, {.value = "WxH"},
                   "into an atlas of this size; the default is the smallest square"),
            only_option("only these: first_fit, best_texture, stb_rect_pack, ...", c.only),
            peers_option("without other packers", c.peers),
            rounds_option("turns of each contestant; medians count", c.rounds),
            seed_option("of the sets", c.seed)};
  }
  void prepare() override {
    AtlasBenchConfig& c = result_.config;
    for (const std::string& name : c.sets) texture_set(name, 1, 1);  // is there one?
    if (c.counts.empty()) c.counts = AtlasBenchConfig().counts;
    if (!sizes_.empty()) c.own = read_texture_sizes(sizes_);
    if (!atlas_.empty()) c.atlas = atlas_size();
  }
  std::string unit() const override { return "sets"; }
  std::size_t stages() const override { return atlas_bench_stages(result_.config); }
  void run(const std::function<void(const std::string&)>& tell) override {
    bench_atlases(result_, [&](std::size_t stage, const TextureSet& set) {
      tell(fmt::format("set {} of {}, {}: {} textures", stage + 1, stages(), set.name,
                       set.sizes.size()));
    });
  }
  bool is_good() const override {
    return std::ranges::none_of(result_.rows,
                                [](const AtlasRow& row) { return row.status == "wrong"; });
  }

 private:
  TextureSize atlas_size() const {
    constexpr int kLeast = 16, kMost = 65536;
    const auto size = two_numbers_in<int>(atlas_, 'x');
    if (!size || std::min(size->first, size->second) < kLeast ||
        std::max(size->first, size->second) > kMost)
      throw Refused("--size {}: give width x height in pixels, {} to {} each, as 1280x720", atlas_,
                    kLeast, kMost);
    return {size->first, size->second};
  }

  std::string sizes_, atlas_;
};

}  // namespace

Texts texts_of(const AtlasBenchResult& result) {
  const Sheet<AtlasRow> sheet = sheet_of(result);
  return texts_of(result, sheet, document_of(result, sheet));
}

std::unique_ptr<Experiment> atlas_bench() { return std::make_unique<AtlasBench>(); }

}  // namespace lantern::report
