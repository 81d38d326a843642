// `bench step`: what a step of many bodies costs, and how exact it is.

#include "base/number.hpp"
#include "base/suggest.hpp"
#include "report/benches.hpp"

namespace lantern::measure {

void each_field(const StepRow& row, auto&& visit) {
  visit_fields(visit, "pile", row.pile, "solver", row.solver, "version", row.version, "status",
               row.status, "reason", row.reason, "simulated_seconds", row.simulated);
  visit(Field("mean", "mean_ms", "step_ms"), row.mean);
  visit(Field("median", "median_ms", "step_ms"), row.median);
  visit(Field("lower_quartile", "lower_quartile_ms", "step_ms"), row.lower_quartile);
  visit(Field("upper_quartile", "upper_quartile_ms", "step_ms"), row.upper_quartile);
  visit(Field("last_second", "last_second_ms", "step_ms"), row.last_second);
  visit(Field("wall", "wall_ms", "step_ms"), row.wall);
  visit_fields(visit, "deepest", row.end.deepest, "mean_depth", row.end.mean, "touching_pairs",
               row.end.touching, "outside", row.end.outside, "creep", row.creep, "most_creep",
               row.most_creep, "energy_lost", row.lost, "energy_gained", row.gained);
  for (const WorldCounter& counter : kWorldCounters) {
    const std::string name(counter.name);
    visit(Field(name.c_str(), name.c_str(), "work"), row.work.*counter.count);
  }
}

void each_field(const StepComparison& c, auto&& visit) {
  visit_fields(visit, "pile", c.pile, "peer", c.peer, "of_its_penetration", c.of, "deepest",
               c.deepest, "peer_ms", c.peer_ms, "our_ms", c.our_ms, "by", c.by);
}

}  // namespace lantern::measure

namespace lantern::report {
namespace {

std::string ms_text(double ms) { return fmt::format("{:.3g}", ms); }
std::string size_text(double size) { return size == 0 ? "0" : fmt::format("{:.1e}", size); }

constexpr std::string_view kMeanings =
    "Solvers take turns of a quarter of a second. ms a step: processor time of single steps; last "
    "s: mean of the last second; wall: mean by the clock. deepest, mean depth: overlap at the end, "
    "from poses, by one narrow phase for all, of shapes with the skin that the engine keeps around "
    "them. creep, most: how far bodies moved in the last second, mean and farthest. lost, gained: "
    "energy over that of the start; gained is the largest rise.";

Cell remark_on(const StepRow& row, double seconds) {
  if (row.status != Status::ok)
    return {fmt::format("{}: {}", to_string(row.status), row.reason), true};
  return row.is_whole(seconds) ? "" : fmt::format("only {:.2g} s of it", row.simulated);
}

// Down is more exact, left is sooner.
Sheet<StepRow>::Curve cost_curve() {
  Plot plot;
  plot.title = "Cost of a step, and what it leaves";
  plot.x_name = "ms a step, mean; whiskers: quartiles of single steps";
  plot.y_name = "deepest overlap at the end, units: lower left is better";
  return {
      plot, [](const StepRow& row) -> std::optional<PlotPoint> {
        if (row.simulated == 0) return std::nullopt;
        PlotPoint point{{row.mean, row.end.deepest}};
        point.beyond = row.status != Status::ok;
        point.spread = Box<2>{{row.lower_quartile, point.at.y}, {row.upper_quartile, point.at.y}};
        return point;
      }};
}

// What ours counted in a step, on average.
Table work_table(const std::vector<StepRow>& rows, const std::string& pile) {
  constexpr std::pair<const char*, std::uint64_t WorldWork::*> kCounts[] = {
      {"box tests", &WorldWork::pair_tests}, {"pairs", &WorldWork::narrow_pairs},
      {"narrow", &WorldWork::narrow_tests},  {"points", &WorldWork::contact_points},
      {"normal", &WorldWork::normal_rows},   {"friction", &WorldWork::friction_rows},
      {"direct", &WorldWork::direct_solves}, {"retries", &WorldWork::retries}};
  Table table{"", {{"counted a step", false}}};
  for (const auto& [name, count] : kCounts) table.columns.push_back({name});
  for (const StepRow& row : rows) {
    if (row.pile != pile || row.is_peer() || row.work.steps == 0) continue;
    Table::Line& line = table.lines.emplace_back(Table::Line{{row.solver}, {row.solver}});
    for (const auto& [name, count] : kCounts)
      line.cells.emplace_back(fmt::format(
          "{:.4g}", static_cast<double>(row.work.*count) / static_cast<double>(row.work.steps)));
  }
  return table;
}

// Ours, as exact as each peer and a hundred times more.
Table comparison_table(const std::vector<StepComparison>& all, const std::string& pile) {
  Table table{"", columns_of({"as exact as|", "of its depth", "deepest", "its ms", "our ms",
                              "of its time", "by|"})};
  for (const StepComparison& c : all) {
    if (c.pile != pile) continue;
    const bool is_met = c.our_ms > 0;
    table.lines.push_back(
        {{c.peer},
         {c.peer, fmt::format("{:g}", c.of), size_text(c.deepest), ms_text(c.peer_ms),
          is_met ? ms_text(c.our_ms) : "–", is_met ? ms_text(c.ratio()) : "–",
          is_met ? c.by : "no effort of ours that came to the end"}});
  }
  return table;
}

Sheet<StepRow> sheet_of(const StepBenchResult& result) {
  const StepBenchConfig& config = result.config;
  Sheet<StepRow> sheet;
  sheet.format = "lantern.bench.step/1";
  sheet.title = "A step of many bodies in contact";
  sheet.about =
      fmt::format("Piles that fall for {:g} s in steps of 1/60 s, friction 0.5, nothing sleeps. {}",
                  config.seconds, kMeanings);
  sheet.head = [&config](JsonWriter& json) {
    json.members("seconds", config.seconds, "longest", config.longest);
    json.line().member("structure", to_string(config.structure));
  };
  sheet.lists = [&result](JsonWriter& json) { write_rows("comparisons", compared(result), json); };
  sheet.who = [](const StepRow& row) { return row.solver; };
  sheet.chapter = [](const StepRow& row) { return row.pile; };
  sheet.columns = {
      {"mean ms", [](auto& row) { return ms_text(row.mean); }},
      {"median", [](auto& row) { return ms_text(row.median); }},
      {"quartiles",
       [](auto& row) {
         return fmt::format("{:.3g} - {:.3g}", row.lower_quartile, row.upper_quartile);
       }},
      {"last s", [](auto& row) { return ms_text(row.last_second); }},
      {"wall", [](auto& row) { return ms_text(row.wall); }},
      {"deepest", [](auto& row) { return size_text(row.end.deepest); }},
      {"mean depth", [](auto& row) { return size_text(row.end.mean); }},
      {"creep", [](auto& row) { return size_text(row.creep); }},
      {"most", [](auto& row) { return size_text(row.most_creep); }},
      {"lost", [](auto& row) { return fmt::format("{:.1f}%", 100 * row.lost); }},
      {"gained", [](auto& row) { return size_text(row.gained); }},
  };
  sheet.has_numbers = [](const StepRow& row) { return row.simulated > 0; };
  sheet.remark = [&config](const StepRow& row) { return remark_on(row, config.seconds); };
  sheet.curves = {cost_curve()};
  sheet.beside = [&result, all = compared(result)](const StepRow& row) -> std::vector<Table> {
    return {work_table(result.rows, row.pile), comparison_table(all, row.pile)};
  };
  return sheet;
}

class StepBench : public ExperimentOf<StepBenchResult> {
 public:
  Options options() override {
    StepBenchConfig& c = result_.config;
    return {
        option("--pile", &piles_, {.value = "PILE", .one_each = true},
               "boxes2d:N, balls2d:N, boxes3d:N, balls3d:N; the default is some of 500 and 2,000"),
        option("--seconds", &seconds_, {.value = "S", .least = 1, .most = 3600},
               "of the fall; the default is 4, with --full 10"),
        longest_option("a solver ends early at a pile that takes it more seconds than this; the "
                       "default is 20, with --full 600",
                       longest_),
        only_option("only these: soft:8, impulse:100, Box2D, ...", c.only),
        {"--full", &full_, "500, 2,000 and 5,000 boxes and balls in 2D and 3D: hours"},
        peers_option("without other engines", c.peers),
        option("--broad-phase", &broad_phase_, {.value = "KIND"},
               "ours: sort_and_sweep, quadtree, octree, ...")};
  }
  void prepare() override {
    StepBenchConfig& c = result_.config;
    c.seconds = seconds_.value_or(full_ ? 10 : c.seconds);
    c.longest = longest_.value_or(full_ ? 600 : c.longest);
    c.piles = full_ ? all_piles() : usual_piles();
    if (!piles_.empty()) c.piles.clear();
    for (const std::string& name : piles_) {
      const auto pile = pile_named(name);
      if (!pile)
        throw Refused(
            "there is no pile '{}'; write boxes2d:500, balls2d:500, boxes3d:500 or "
            "balls3d:500, with 1 to 100000 bodies",
            name);
      c.piles.push_back(*pile);
    }
    const auto kinds = mapped(kStructureKinds, [](StructureKind kind) { return to_string(kind); });
    const auto kind = structure_named(broad_phase_);
    if (!kind || *kind == StructureKind::none)
      throw Refused(with_suggestion(fmt::format("there is no broad phase '{}'", broad_phase_),
                                    broad_phase_, kinds, kinds.size()));
    for (const Pile& pile : c.piles)
      if (!is_possible(*kind, pile.dimension))
        throw Refused("{}: an octree needs three dimensions", pile.name());
    c.structure = *kind;
  }
  std::vector<std::string> announcement() const override {
    return {fmt::format("{}; each solver has {:g} s at each", counted(stages(), "pile"),
                        result_.config.longest)};
  }
  std::string unit() const override { return "piles"; }
  std::size_t stages() const override { return result_.config.piles.size(); }
  void run(const std::function<void(const std::string&)>& tell) override {
    std::size_t begun = 0;
    bench_steps(result_, [&](const Pile& pile, double share) {
      begun += share == 0;
      tell(fmt::format("pile {} of {}, {}: {:.0f}% of the fall", begun, stages(), pile.name(),
                       100 * share));
    });
  }

 private:
  std::vector<std::string> piles_;
  std::optional<double> seconds_, longest_;
  std::string broad_phase_ = "sort_and_sweep";
  bool full_ = false;
};

}  // namespace

Texts texts_of(const StepBenchResult& result) {
  const Sheet<StepRow> sheet = sheet_of(result);
  return texts_of(result, sheet, document_of(result, sheet));
}

std::unique_ptr<Experiment> step_bench() { return std::make_unique<StepBench>(); }

}  // namespace lantern::report
