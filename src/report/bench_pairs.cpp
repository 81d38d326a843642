#include "report/bench_pairs.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "measure/records.hpp"

namespace lantern::measure {

template <class Visit>
void each_field(const BoxBenchRow& row, Visit&& visit) {
  visit(Field("workload"), row.workload);
  visit(Field("dimension"), row.dimension);
  visit(Field("bodies"), row.bodies);
  visit(Field("contestant"), row.contestant);
  visit(Field("version"), row.version);
  visit(Field("setting"), row.setting);
  visit(Field("status"), row.status);
  visit(Field("reason"), row.reason);
  each_timing(row.timing, "seconds", "iqr", "seconds_iqr", visit);
  const bool timed = row.timing.repeats > 0;
  visit(Field("wall", "seconds_wall", "seconds"), IfTimed(row.wall, timed));
  visit(Field("found"), row.found);
  visit(Field("missed"), row.missed);
  visit(Field("invented"), row.invented);
  visit(Field("checked"), row.checked);
  visit(Field("allocations"), row.allocations);
  visit(Field("bytes"), row.bytes);
  visit(Field("pair_tests"), row.counts.pair_tests);
  visit(Field("box_tests"), row.counts.box_tests);
  visit(Field("nodes_visited"), row.counts.nodes_visited);
  visit(Field("nodes"), row.counts.nodes);
  visit(Field("entries"), row.counts.entries);
}

template <class Visit>
void each_field(const BoxPeerWords& peer, Visit&& visit) {
  visit(Field("name"), peer.name);
  visit(Field("version"), peer.version);
  visit(Field("how"), peer.how);
}

}  // namespace lantern::measure

namespace lantern::report {
namespace {

// "12.3k", for what is only counted.
std::string short_count(const std::optional<double>& n) {
  if (!n) return "";
  if (*n < 1e4) return fmt::format("{:.4g}", *n);
  return *n < 1e6 ? fmt::format("{:.3g}k", *n / 1e3) : fmt::format("{:.3g}M", *n / 1e6);
}

bool is_asked(const BoxBenchRow& row) {
  for (const BoxWorkload& workload : box_workloads())
    if (workload.name == row.workload) return workload.task != BoxTask::pairs;
  return false;
}

std::string row_text(const BoxBenchResult& result, const BoxBenchRow& row) {
  std::string text = fmt::format("  {:<17}", row.contestant);
  if (row.timing.repeats == 0) return fmt::format("{}{}: {}\n", text, row.status, row.reason);
  const double unit = is_asked(row) ? 1e6 : 1e3;
  const Timing& t = row.timing;
  text +=
      fmt::format(" {:>9.4g} {:>17}", unit * t.median,
                  fmt::format("{:.3g} - {:.3g}", unit * t.lower_quartile, unit * t.upper_quartile));
  text += fmt::format(" {:>9.4g}", unit * row.wall);
  const BoxBenchRow* peer = fastest_peer(result.rows, row);
  text += fmt::format(" {:>7}", peer ? fmt::format("{:.3g}", peer->timing.median / t.median) : "");
  for (const auto& count : {row.allocations, row.bytes, row.counts.pair_tests, row.counts.box_tests,
                            row.counts.nodes_visited, row.counts.entries})
    text += fmt::format(" {:>7}", short_count(count));
  text += "  " + row.setting;
  if (row.status != "ok") text += fmt::format("  {}: {}", row.status, row.reason);
  return text + "\n";
}

std::string stage_text(const BoxBenchRow& row) {
  std::string text = fmt::format("\n{} with {} boxes", row.workload, row.bodies);
  const bool asked = is_asked(row);
  text += fmt::format(": {} {}", row.found, asked ? "bodies found by 400 questions" : "pairs");
  if (!row.checked.empty()) text += ", checked by " + row.checked;
  return text +
         fmt::format("\n  {:<17} {:>9} {:>17} {:>9} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7}\n",
                     asked ? "us a question" : "ms a step", "median", "quartiles", "clock", "times",
                     "calls", "bytes", "pairs", "boxes", "nodes", "entries");
}

constexpr std::string_view kPairsMeanings =
    "Each contestant gives all pairs, each once, in order of ids, within its time; what others "
    "find\n"
    "is ordered by our own code, and boxes are given to all alike. Milliseconds are of the\n"
    "processor, all threads together; clock: by the clock; times: as quick as the "
    "quickest\n"
    "other library; calls: for memory in a warm step; bytes: held for each box, pairs too; pairs,\n"
    "boxes, nodes, entries: comparisons of boxes with boxes and with nodes, nodes visited, bodies "
    "in\n"
    "leaves. Where nobody counts nothing stands.\n";

}  // namespace

std::string to_table(const BoxBenchResult& result) {
  std::string text(kPairsMeanings);
  const BoxBenchRow* last = nullptr;
  for (const BoxBenchRow& row : result.rows) {
    if (!last || last->workload != row.workload || last->bodies != row.bodies) {
      // The first that was run knows what was found.
      const BoxBenchRow* told = &row;
      for (const BoxBenchRow& one : result.rows)
        if (told->checked.empty() && one.workload == row.workload && one.bodies == row.bodies)
          told = &one;
      text += stage_text(*told);
    }
    text += row_text(result, row);
    last = &row;
  }
  return text;
}

std::string to_csv(const BoxBenchResult& result) { return csv_of(result.rows); }

std::string to_json(const BoxBenchResult& result) {
  const Circumstances& c = result.circumstances;
  JsonWriter json;
  json.begin_object().line().member("format", "lantern.bench.pairs/1");
  json.line().member("command", result.command).member("seed", result.config.seed);
  json.line().member("rounds", result.config.rounds);
  json.line().member("version", c.version).member("sources", c.sources);
  json.line().member("compiler", c.compiler).member("flags", c.flags);
  json.line().member("processor", c.processor);
  write_rows("peers", result.peers, json);
  write_rows("rows", result.rows, json);
  json.line().end_object();
  return json.text() + "\n";
}

}  // namespace lantern::report
