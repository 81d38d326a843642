// `bench pairs`: all pairs of moving boxes, and what rays, boxes and balls meet.

#include "report/benches.hpp"

namespace lantern::measure {

void each_field(const BoxBenchRow& row, auto&& visit) {
  visit_fields(visit, "workload", row.workload, "dimension", row.dimension, "bodies", row.bodies,
               "contestant", row.contestant, "version", row.version, "setting", row.setting,
               "status", row.status, "reason", row.reason);
  each_timing(row.timing, "seconds", "iqr", "seconds_iqr", visit);
  const bool timed = row.timing.repeats > 0;
  visit(Field("wall", "seconds_wall", "seconds"), IfTimed(row.wall, timed));
  visit_fields(visit, "found", row.found, "missed", row.missed, "invented", row.invented, "checked",
               row.checked, "allocations", row.allocations, "bytes", row.bytes, "pair_tests",
               row.counts.pair_tests, "box_tests", row.counts.box_tests, "nodes_visited",
               row.counts.nodes_visited, "nodes", row.counts.nodes, "entries", row.counts.entries,
               "frames", row.frames, "found_in_all", row.found_in_all);
}

}  // namespace lantern::measure

namespace lantern::report {
namespace {

bool has_times(const BoxBenchRow& row) { return row.timing.repeats > 0; }

std::string figure_of(const std::optional<double>& n) { return n ? figure(*n) : ""; }

const BoxWorkload* known_workload(const std::string& name) {
  for (const BoxWorkload& workload : box_workloads())
    if (workload.name == name) return &workload;
  return nullptr;
}

bool is_asked(const BoxBenchRow& row) {
  const BoxWorkload* workload = known_workload(row.workload);
  return workload && workload->task != BoxTask::pairs;
}

// As quick as the quickest other library; nothing where there is none.
std::optional<double> times_of(const BoxBenchResult& result, const BoxBenchRow& row) {
  const BoxBenchRow* peer = fastest_peer(result.rows, row);
  return peer ? std::optional(peer->timing.median / row.timing.median) : std::nullopt;
}

// The first that was run, and is right, knows what was found.
std::string stage_of(const BoxBenchResult& result, const BoxBenchRow& row) {
  const std::string what = fmt::format("{} with {} boxes: ", row.workload, row.bodies);
  const auto told = std::ranges::find_if(result.rows, [&](const BoxBenchRow& one) {
    return one.workload == row.workload && one.bodies == row.bodies && has_times(one) &&
           one.is_good();
  });
  if (told == result.rows.end()) return what + "nobody has found what is to be found";
  std::string found = counted(told->found, "pair");
  if (is_asked(row)) found = fmt::format("{} bodies found by 400 questions", told->found);
  if (told->frames > 1) found += fmt::format(" at the first of {} frames", told->frames);
  if (told->found_in_all) found += fmt::format(", {} in all", figure(*told->found_in_all));
  return fmt::format("{}{}, checked by {}", what, found, told->checked);
}

constexpr std::string_view kAbout =
    "All pairs of boxes that overlap, step by step, while the boxes move; and what rays, boxes and "
    "balls meet, and which body is nearest. All contestants get the same boxes in the same run, in "
    "turns; each gives its pairs in order of ids, each once, within its time. What others find is "
    "ordered by Lantern’s own code. Times of a step, or of a question, are of the processor, all "
    "threads together: medians over steps between which the boxes move; clock: by the clock; "
    "times: how many times as quick as the quickest other library; calls: how often a warm step "
    "asks for memory; bytes: held for each box, pairs too; pairs, boxes, nodes, entries: "
    "comparisons of boxes with boxes and with nodes, nodes visited, bodies in leaves; of a "
    "question: boxes tested in double, those compared in float before, several by an instruction, "
    "and nodes, or rows of boxes, that were looked at. What nobody counts is left empty.";

// Nanoseconds a box, or a question; or the ratio to the quickest other library. Of worlds of one
// size there is no plot.
Sheet<BoxBenchRow>::Curve curve_of(const BoxBenchResult& result, bool as_ratio) {
  Plot plot;
  plot.title = as_ratio ? "Times as quick as the quickest other library"
                        : "Time a box and step, or a question";
  plot.x_name = "boxes";
  plot.y_name = as_ratio ? "ratio; above 1 is quicker" : "nanoseconds";
  std::map<std::string, std::set<std::uint64_t>> sizes;
  for (const BoxBenchRow& row : result.rows) sizes[row.workload].insert(row.bodies);
  return {plot, [&result, as_ratio, sizes](const BoxBenchRow& row) -> std::optional<PlotPoint> {
            if (sizes.at(row.workload).size() < 2 || !has_times(row) || !row.is_good())
              return std::nullopt;
            const auto x = static_cast<double>(row.bodies);
            if (as_ratio) {
              const auto times = times_of(result, row);
              return times ? std::optional(PlotPoint{{x, *times}}) : std::nullopt;
            }
            const double unit = is_asked(row) ? 1e9 : 1e9 / x;
            const Timing& t = row.timing;
            return PlotPoint{
                .at = {x, unit * t.median},
                .spread = Box<2>{{x, unit * t.lower_quartile}, {x, unit * t.upper_quartile}}};
          }};
}

Sheet<BoxBenchRow> sheet_of(const BoxBenchResult& result) {
  Sheet<BoxBenchRow> sheet;
  sheet.format = "lantern.bench.pairs/1";
  sheet.title = "Pairs of boxes";
  sheet.about = kAbout;
  sheet.head = [&result](JsonWriter& json) {
    json.members("seed", result.config.seed, "rounds", result.config.rounds);
  };
  sheet.lists = [&result](JsonWriter& json) {
    std::vector<Contestant> peers = result.contestants;
    std::erase_if(peers, [](const Contestant& one) { return !one.is_peer(); });
    write_rows("peers", peers, json);
  };
  sheet.who = [](const BoxBenchRow& row) { return row.contestant; };
  sheet.chapter = [](const BoxBenchRow& row) { return row.workload; };
  sheet.words = [&result](const BoxBenchRow& row) -> std::vector<std::string> {
    const BoxWorkload* workload = known_workload(row.workload);
    if (workload) return {std::string(workload->words)};
    return {result.config.own ? result.config.own->words : ""};
  };
  sheet.stage = [&result](const BoxBenchRow& row) { return stage_of(result, row); };
  sheet.columns = {
      {"median, µs", [](auto& row) { return figure(1e6 * row.timing.median); }},
      {"quartiles, µs", [](auto& row) { return range_text(row.timing, 1e6); }},
      {"clock, µs", [](auto& row) { return figure(1e6 * row.wall); }},
      {"times",
       [&result](auto& row) {
         const auto times = times_of(result, row);
         return times ? fmt::format("{:.3g}", *times) : "";
       }},
      {"found", [](auto& row) { return count_text(row.found); }},
      {"calls", [](auto& row) { return figure_of(row.allocations); }},
      {"bytes", [](auto& row) { return figure_of(row.bytes); }},
      {"pairs", [](auto& row) { return figure_of(row.counts.pair_tests); }},
      {"boxes", [](auto& row) { return figure_of(row.counts.box_tests); }},
      {"nodes", [](auto& row) { return figure_of(row.counts.nodes_visited); }},
      {"entries", [](auto& row) { return figure_of(row.counts.entries); }},
  };
  sheet.has_numbers = has_times;
  sheet.remark = [](const BoxBenchRow& row) -> Cell {
    if (row.status == "ok") return row.setting;
    return {fmt::format("{}{}: {}", row.setting.empty() ? "" : row.setting + "; ", row.status,
                        row.reason),
            row.status == "wrong"};
  };
  sheet.curves = {curve_of(result, false), curve_of(result, true)};
  return sheet;
}

// Those of all rows, with a sentence on those that were run.
std::vector<Contestant> contestants_of(const BoxBenchResult& result) {
  std::vector<Contestant> all;
  for (const BoxBenchRow& row : result.rows) {
    if (std::ranges::find(all, row.contestant, &Contestant::name) != all.end()) continue;
    const auto run = std::ranges::find(result.contestants, row.contestant, &Contestant::name);
    all.push_back({row.contestant, row.version, run == result.contestants.end() ? "" : run->how});
  }
  return all;
}

// Each world beside the quickest other library.
Table ratio_table(const BoxBenchResult& result, const std::vector<Choice>& choices) {
  Table table{"How many times as quick as the quickest other library",
              {{"world", false}, {"boxes"}}};
  for (const Choice& choice : choices) table.columns.push_back({choice.name, true, {choice.name}});
  const BoxBenchRow* last = nullptr;
  for (const BoxBenchRow& row : result.rows) {
    if (!last || last->workload != row.workload || last->bodies != row.bodies) {
      Table::Line& line = table.lines.emplace_back();
      line.cells = {row.workload, count_text(row.bodies)};
      line.cells.resize(2 + choices.size(), Cell("–"));
    }
    last = &row;
    const auto at = std::ranges::find(choices, row.contestant, &Choice::name) - choices.begin();
    Cell& cell = table.lines.back().cells[2 + static_cast<std::size_t>(at)];
    if (!has_times(row))
      cell = row.status;
    else if (!row.is_good())
      cell = {"wrong", true};
    else if (const auto times = times_of(result, row))
      cell = fmt::format("{:.3g}", *times);
  }
  return table;
}

class PairsBench : public ExperimentOf<BoxBenchResult> {
 public:
  Options options() override {
    BoxBenchConfig& c = result_.config;
    return {
        option("--workload", &workloads_, {.value = "NAME", .one_each = true},
               "only these: uniform, clustered, mixed, thin, coincident, brownian, free_fall, "
               "gravity, town, or what is asked: rays, first_hits, boxes, balls, nearest; "
               "uniform_2d is only one of two dimensions"),
        option("--bodies", &c.bodies, {.value = "N", .least = 2, .most = 2e7, .one_each = true},
               "how many boxes; the default is each workload's own numbers"),
        only_option("only these: quadtree, sort_and_sweep, CGAL, ...", c.only),
        option("--boxes", &boxes_, {.value = "FILE", .without = "--workload,--bodies"},
               "boxes of your own instead: CSV, a line a box (lo_x,lo_y,hi_x,hi_y or named "
               "columns, with id and frame if they move), or .aabbs of Broadmark"),
        option("--columns", &columns_, {.value = "OURS=THEIRS,..."},
               "what columns of --boxes are called: x=cx,y=cy,width=w,height=h"),
        {"--full", &c.full, "up to a million boxes: the better part of an hour"},
        peers_option("without other libraries", c.peers),
        option("--seconds", &seconds_, {.value = "S", .above_0 = true},
               "that a contestant is timed at a world, but three rounds at least; the default is "
               "0.1, with --full 4"),
        longest_option("leave out who needs more seconds a step than this; the default is 1, with "
                       "--full 10",
                       longest_),
        rounds_option("turns of each contestant; medians count", c.rounds),
        seed_option("of the boxes", c.seed)};
  }
  void prepare() override {
    BoxBenchConfig& c = result_.config;
    c.seconds = seconds_.value_or(c.full ? 4 : c.seconds);
    c.longest = longest_.value_or(c.full ? 10 : c.longest);
    if (c.full) c.search = 4;
    if (boxes_.empty())
      c.workloads = workloads();
    else
      c.own = read_boxes(boxes_, c.seed, columns_);
  }
  std::string unit() const override { return "worlds"; }
  std::size_t stages() const override { return box_stages(result_.config); }
  void run(const std::function<void(const std::string&)>& tell) override {
    bench_boxes(result_, [&](std::size_t stage, const std::string& words) {
      tell(fmt::format("world {} of {}, {}", stage + 1, stages(), words));
    });
  }
  bool is_good() const override {
    return complaint().empty() && std::ranges::all_of(result_.rows, &BoxBenchRow::is_good);
  }
  std::string complaint() const override {
    if (result_.rows.empty() || std::ranges::any_of(result_.rows, has_times)) return "";
    return fmt::format("nothing was measured: {}: {}", result_.rows[0].contestant,
                       result_.rows[0].reason);
  }

 private:
  std::vector<const BoxWorkload*> workloads() const {
    const std::vector<std::string_view> names = mapped(box_workloads(), &BoxWorkload::name);
    std::vector<const BoxWorkload*> all;
    for (const BoxWorkload& one : box_workloads())
      if (workloads_.empty()) all.push_back(&one);
    for (const std::string& name : workloads_) {
      const auto found = box_workloads_named(name);
      if (found.empty())
        throw Refused(with_suggestion(fmt::format("there is no workload '{}'", name), name, names,
                                      names.size()));
      all.insert(all.end(), found.begin(), found.end());
    }
    return all;
  }

  std::vector<std::string> workloads_;
  std::string boxes_, columns_;
  std::optional<double> seconds_, longest_;
};

}  // namespace

Texts texts_of(const BoxBenchResult& result) {
  const Sheet<BoxBenchRow> sheet = sheet_of(result);
  BoxBenchResult told = result;
  told.contestants = contestants_of(result);
  Document document = document_of(told, sheet);
  if (!result.rows.empty()) document.head.push_back(ratio_table(result, document.choices));
  return texts_of(result, sheet, document);
}

std::unique_ptr<Experiment> pairs_bench() { return std::make_unique<PairsBench>(); }

}  // namespace lantern::report
