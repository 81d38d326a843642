#include <algorithm>
#include <string>

#include <fmt/format.h>

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

}  // namespace

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
    text += fmt::format("\n{}\n{}", scene.name, lines);
  }
  return text;
}

std::string to_csv(const std::vector<BroadPhaseCost>& rows) { return csv_of(rows); }

std::string to_json(std::span<const BroadPhaseCost> rows, std::span<const BoxScene> scenes) {
  JsonWriter json;
  json.begin_object().line().member("format", "lantern.measure.broad_phase/2");
  json.line().key("scenes").begin_array();
  for (const BoxScene& scene : scenes) {
    json.line().begin_object().member("name", scene.name).member("words", scene.words);
    json.member("dimension", scene.dimension()).end_object();
  }
  write_rows("rows", rows, json.line().end_array());
  json.line().end_object();
  return json.text() + "\n";
}

}  // namespace lantern::measure
