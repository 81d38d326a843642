#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "base/grouped.hpp"
#include "base/json_writer.hpp"
#include "measure/broad_phase_cost.hpp"
#include "measure/records.hpp"

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

namespace {

// "quadtree, capacity 8, depth limit 7"
std::string settings_of(const BroadPhaseCost& row) {
  if (!row.has_settings()) return "";
  return fmt::format("capacity {}, depth limit {}", row.capacity, row.depth_limit);
}

std::string table_row(const BroadPhaseCost& row) {
  return fmt::format(
      "  {:<15}{:<28}{:>12}{:>12}{:>9}{:>12.2f}{:>10.2f}{:>8}{:>7}{:>10.3f}{:>10.3f}{:>9.3f}\n",
      to_string(row.kind), settings_of(row), row.counts.pair_tests, row.counts.box_tests,
      row.counts.entries, row.false_per_true(), row.entries_per_body(), row.counts.nodes,
      row.counts.missed + row.counts.invented, 1e3 * row.timing.median, 1e3 * row.timing.least,
      1e3 * row.timing.spread());
}

// What smallest and largest leaves cost more, if it can be told.
std::string neighbour_words(std::span<const BroadPhaseCost> rows, const BroadPhaseCost& best) {
  std::uint32_t most = 1;
  for (const BroadPhaseCost& row : rows) most = std::max(most, row.capacity);
  std::string text;
  const auto beside = [&](std::uint32_t capacity, std::uint64_t BroadPhaseCounts::*count,
                          const char* words) {
    const BroadPhaseCost* row = row_of(rows, best.scene, best.kind, capacity, best.depth_limit);
    if (row == nullptr || best.counts.*count == 0) return;
    const double ratio =
        static_cast<double>(row->counts.*count) / static_cast<double>(best.counts.*count);
    if (ratio > 1.05)
      text += fmt::format("; capacity {} needs {:.1f} times as many {}", capacity, ratio, words);
  };
  beside(1, &BroadPhaseCounts::entries, "entries");
  beside(most, &BroadPhaseCounts::pair_tests, "pair tests");
  return text;
}

// Which pairs brute force counts, where some are of two static bodies.
std::string brute_force_words(const BroadPhaseCost& row) {
  const BroadPhaseCounts& c = row.counts;
  if (c.testable_pairs == c.all_pairs) return "";
  const std::uint64_t tests = c.pair_tests / row.updates, testable = c.testable_pairs / row.updates;
  if (tests == testable) return " (pairs of two static bodies left out)";
  return fmt::format(" (all pairs; {} without those of two static bodies)",
                     grouped(static_cast<std::int64_t>(testable), " "));
}

}  // namespace

std::string sentence_about(std::span<const BroadPhaseCost> rows, const BoxScene& scene,
                           StructureKind kind) {
  const BroadPhaseCost* best = cheapest(rows, scene.name, kind, CostBy::work);
  if (best == nullptr) return "";
  const auto work = [](const BroadPhaseCost& row) {
    return grouped(static_cast<std::int64_t>((row.counts.work() + row.updates / 2) / row.updates),
                   " ");
  };
  std::string text = fmt::format("For {}: capacity {}, depth limit {}: {} comparisons", scene.words,
                                 best->capacity, best->depth_limit, work(*best));
  if (best->updates > 1) text += " an update";
  text += neighbour_words(rows, *best);
  if (const auto* sweep = cheapest(rows, scene.name, StructureKind::sort_and_sweep, CostBy::work))
    text += "; sort and sweep " + work(*sweep);
  if (const auto* force = cheapest(rows, scene.name, StructureKind::brute_force, CostBy::work))
    text += "; brute force " + work(*force) + brute_force_words(*force);
  return text + ".";
}

// Of the trees only the cheapest cells; all of them are in the files.
std::string to_table(std::span<const BroadPhaseCost> rows, std::span<const BoxScene> scenes) {
  std::string text =
      fmt::format("  {:<15}{:<28}{:>12}{:>12}{:>9}{:>12}{:>10}{:>8}{:>7}{:>10}{:>10}{:>9}\n",
                  "structure", "cheapest settings", "pair tests", "box tests", "entries",
                  "false/true", "ent/body", "nodes", "wrong", "ms", "least", "iqr");
  for (const BoxScene& scene : scenes) {
    std::string lines;
    for (const StructureKind kind : kStructureKinds)
      if (const BroadPhaseCost* best = cheapest(rows, scene.name, kind, CostBy::work))
        lines += table_row(*best);
    if (lines.empty()) continue;
    const StructureKind tree =
        scene.dimension() == 2 ? StructureKind::quadtree : StructureKind::octree;
    text += fmt::format("\n{}\n{}", scene.name, lines);
    text += fmt::format("  {} {}\n", to_string(tree), sentence_about(rows, scene, tree));
  }
  return text;
}

std::string to_csv(const std::vector<BroadPhaseCost>& rows) { return csv_of(rows); }

std::string to_json(std::span<const BroadPhaseCost> rows, std::span<const BoxScene> scenes) {
  JsonWriter json;
  json.begin_object().line().member("format", "lantern.measure.broad_phase/1");
  json.line().key("scenes").begin_array();
  for (const BoxScene& scene : scenes) {
    json.line().begin_object().member("name", scene.name).member("words", scene.words);
    json.member("dimension", scene.dimension()).key("sentences").begin_array();
    for (const StructureKind kind : kStructureKinds)
      if (const BroadPhaseCost* best = cheapest(rows, scene.name, kind, CostBy::work);
          best != nullptr && best->has_settings())
        json.value(fmt::format("{}: {}", to_string(kind), sentence_about(rows, scene, kind)));
    json.end_array().end_object();
  }
  write_rows("rows", rows, json.line().end_array());
  json.line().end_object();
  return json.text() + "\n";
}

}  // namespace lantern::measure
