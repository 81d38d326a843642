#include "report/bench_step.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "measure/records.hpp"

namespace lantern::measure {

template <class Visit>
void each_field(const StepRow& row, Visit&& visit) {
  visit(Field("pile"), row.pile);
  visit(Field("solver"), row.solver);
  visit(Field("version"), row.version);
  visit(Field("status"), row.status);
  visit(Field("reason"), row.reason);
  visit(Field("simulated_seconds"), row.simulated);
  visit(Field("mean", "mean_ms", "step_ms"), row.mean);
  visit(Field("median", "median_ms", "step_ms"), row.median);
  visit(Field("lower_quartile", "lower_quartile_ms", "step_ms"), row.lower_quartile);
  visit(Field("upper_quartile", "upper_quartile_ms", "step_ms"), row.upper_quartile);
  visit(Field("last_second", "last_second_ms", "step_ms"), row.last_second);
  visit(Field("wall", "wall_ms", "step_ms"), row.wall);
  visit(Field("deepest"), row.end.deepest);
  visit(Field("mean_depth"), row.end.mean);
  visit(Field("touching_pairs"), row.end.touching);
  visit(Field("outside"), row.end.outside);
  visit(Field("creep"), row.creep);
  visit(Field("most_creep"), row.most_creep);
  visit(Field("energy_lost"), row.lost);
  visit(Field("energy_gained"), row.gained);
  for (const WorldCounter& counter : kWorldCounters) {
    const std::string name(counter.name);
    visit(Field(name.c_str(), name.c_str(), "work"), row.work.*counter.count);
  }
}

template <class Visit>
void each_field(const StepComparison& c, Visit&& visit) {
  visit(Field("pile"), c.pile);
  visit(Field("peer"), c.peer);
  visit(Field("of_its_penetration"), c.of);
  visit(Field("deepest"), c.deepest);
  visit(Field("peer_ms"), c.peer_ms);
  visit(Field("our_ms"), c.our_ms);
  visit(Field("by"), c.by);
}

}  // namespace lantern::measure

namespace lantern::report {
namespace {

std::string depth_text(double depth) { return depth == 0 ? "0" : fmt::format("{:.1e}", depth); }

std::string row_text(const StepRow& row, double seconds) {
  std::string text = fmt::format("  {:<16}", row.solver);
  if (row.simulated == 0)
    return fmt::format("{} {}: {}\n", text, to_string(row.status), row.reason);
  text += fmt::format(" {:>8.3g} {:>8.3g} {:>17} {:>8.3g} {:>8.3g}", row.mean, row.median,
                      fmt::format("{:.3g} - {:.3g}", row.lower_quartile, row.upper_quartile),
                      row.last_second, row.wall);
  text += fmt::format(" {:>8} {:>8} {:>8} {:>8} {:>6.1f}% {:>8}", depth_text(row.end.deepest),
                      depth_text(row.end.mean), depth_text(row.creep), depth_text(row.most_creep),
                      100 * row.lost, depth_text(row.gained));
  if (row.status != Status::ok)
    text += fmt::format("  {}: {}", to_string(row.status), row.reason);
  else if (!row.is_whole(seconds))
    text += fmt::format("  only {:.2g} s of it", row.simulated);
  return text + "\n";
}

// What ours counted in a step, on average.
std::string work_text(const StepRow& row) {
  const auto per_step = [&](std::uint64_t WorldWork::*count) {
    const double steps = std::max(1.0, static_cast<double>(row.work.steps));
    return fmt::format("{:.4g}", static_cast<double>(row.work.*count) / steps);
  };
  return fmt::format("  {:<16} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10} {:>8} {:>8}\n", row.solver,
                     per_step(&WorldWork::pair_tests), per_step(&WorldWork::narrow_pairs),
                     per_step(&WorldWork::narrow_tests), per_step(&WorldWork::contact_points),
                     per_step(&WorldWork::normal_rows), per_step(&WorldWork::friction_rows),
                     per_step(&WorldWork::direct_solves), per_step(&WorldWork::retries));
}

std::string comparison_text(const StepComparison& c) {
  const std::string at =
      fmt::format("  at {}{}'s penetration ({})", c.of == 1 ? "" : fmt::format("{:g} of ", c.of),
                  c.peer, depth_text(c.deepest));
  if (c.our_ms == 0) return at + ": no effort of ours that came to the end is so exact\n";
  return fmt::format("{}: ours takes {:.3g} of its time ({:.3g} ms, {})\n", at, c.ratio(), c.our_ms,
                     c.by);
}

std::string pile_text(const StepBenchResult& result, const std::string& pile,
                      const std::vector<StepComparison>& comparisons) {
  std::string times = fmt::format(
      "{}\n  {:<16} {:>8} {:>8} {:>17} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>7} {:>8}\n", pile,
      "ms a step", "mean", "median", "quartiles", "last s", "wall", "deepest", "mean", "creep",
      "most", "lost", "gained");
  std::string work = fmt::format("  {:<16} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10} {:>8} {:>8}\n",
                                 "counted a step", "box tests", "pairs", "narrow", "points",
                                 "normal", "friction", "direct", "retries");
  bool has_work = false;
  for (const StepRow& row : result.rows) {
    if (row.pile != pile) continue;
    times += row_text(row, result.config.seconds);
    if (row.is_peer() || row.work.steps == 0) continue;
    work += work_text(row);
    has_work = true;
  }
  if (has_work) times += work;
  for (const StepComparison& c : comparisons)
    if (c.pile == pile) times += comparison_text(c);
  return times;
}

constexpr std::string_view kMeanings =
    "ms a step: processor time of single steps; last s: mean of the last second; wall: mean by\n"
    "the clock.\n"
    "deepest, mean: overlap at the end, from poses, by our narrow phase, of shapes with the skin\n"
    "that the engine keeps around them.\n"
    "creep, most: how far bodies moved in the last second, mean and farthest. lost, gained:\n"
    "energy over that of the start; gained is the largest rise.\n";

}  // namespace

std::string to_table(const StepBenchResult& result) {
  std::string text =
      fmt::format("piles that fall for {:g} s in steps of 1/60 s, friction 0.5, nothing sleeps\n{}",
                  result.config.seconds, kMeanings);
  const std::vector<StepComparison> comparisons = compared(result);
  std::string_view last;
  for (const StepRow& row : result.rows)
    if (row.pile != last) {
      last = row.pile;
      text += "\n" + pile_text(result, row.pile, comparisons);
    }
  return text;
}

std::string to_csv(const StepBenchResult& result) { return csv_of(result.rows); }

std::string to_json(const StepBenchResult& result) {
  const Circumstances& c = result.circumstances;
  JsonWriter json;
  json.begin_object().line().member("format", "lantern.bench.step/1");
  json.line().member("seconds", result.config.seconds).member("longest", result.config.longest);
  json.line().member("structure", to_string(result.config.structure));
  json.line().member("command", result.command);
  json.line().member("version", c.version).member("sources", c.sources);
  json.line().member("compiler", c.compiler).member("flags", c.flags);
  json.line().member("processor", c.processor);
  write_rows("rows", result.rows, json);
  write_rows("comparisons", compared(result), json);
  json.line().end_object();
  return json.text() + "\n";
}

}  // namespace lantern::report
