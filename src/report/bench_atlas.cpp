#include "report/bench_atlas.hpp"

#include <fmt/format.h>

#include "base/grouped.hpp"
#include "measure/records.hpp"

namespace lantern::measure {

template <class Visit>
void each_field(const AtlasRow& row, Visit&& visit) {
  visit(Field("set"), row.set);
  visit(Field("textures"), row.textures);
  visit(Field("contestant"), row.contestant);
  visit(Field("version"), row.version);
  visit(Field("status"), row.status);
  visit(Field("reason"), row.reason);
  visit(Field("width"), row.width);
  visit(Field("height"), row.height);
  visit(Field("fill"), row.fill);
  visit(Field("packed"), row.packed);
  visit(Field("turned"), row.turned);
  each_timing(row.timing, "seconds", "interquartile_range", "seconds_interquartile_range", visit);
  const bool searched = row.searching.repeats > 0;
  visit(Field("median", "search_seconds_median", "search_seconds"),
        IfTimed(row.searching.median, searched));
  visit(Field("lower_quartile", "search_seconds_lower_quartile", "search_seconds"),
        IfTimed(row.searching.lower_quartile, searched));
  visit(Field("upper_quartile", "search_seconds_upper_quartile", "search_seconds"),
        IfTimed(row.searching.upper_quartile, searched));
  visit(Field("sides_tried"), row.sides);
  visit(Field("leaf_tests"), row.leaf_tests);
  visit(Field("bytes"), row.bytes);
  visit(Field("overlaps"), row.overlaps);
  visit(Field("outside"), row.outside);
  visit(Field("wrong_sizes"), row.wrong_sizes);
}

template <class Visit>
void each_field(const AtlasPeerWords& c, Visit&& visit) {
  visit(Field("name"), c.name);
  visit(Field("version"), c.version);
  visit(Field("how"), c.how);
}

}  // namespace lantern::measure

namespace lantern::report {
namespace {

std::string row_text(const AtlasRow& row, const AtlasRow* peer) {
  std::string text = fmt::format("  {:<24}", row.contestant);
  if (row.status == "left out") return fmt::format("{} {}: {}\n", text, row.status, row.reason);
  const auto ms = [](double seconds) { return fmt::format("{:.3g}", 1e3 * seconds); };
  text += fmt::format(" {:>7.2f}% {:>13} {:>9} {:>19} {:>9} {:>6} {:>10} {:>10}", 100 * row.fill,
                      fmt::format("{} x {}", row.width, row.height), ms(row.timing.median),
                      ms(row.timing.lower_quartile) + " - " + ms(row.timing.upper_quartile),
                      row.searching.repeats > 0 ? ms(row.searching.median) : "-", row.sides,
                      row.leaf_tests > 0 ? grouped(static_cast<std::int64_t>(row.leaf_tests)) : "-",
                      grouped(static_cast<std::int64_t>(row.bytes)));
  if (row.status != "ok") text += fmt::format("  {}: {}", row.status, row.reason);
  if (row.packed < row.textures)
    text += fmt::format("  {} of {} textures", row.packed, row.textures);
  if (peer && !row.is_peer() && row.status == "ok" && row.timing.median > 0) {
    const double times = peer->timing.median / row.timing.median;
    text +=
        fmt::format("  {:+.2f} points, {:.3g} times as fast", 100 * (row.fill - peer->fill), times);
  }
  return text + "\n";
}

}  // namespace

std::string to_table(const AtlasBenchResult& result) {
  std::string text = result.config.atlas
                         ? "textures packed into an atlas of a given size\n"
                         : "textures packed into the smallest square: sides from the square root "
                           "of their area up by 0.2 %\nuntil all fit. ms: of one packing into that "
                           "square, median and quartiles; search: of all sides tried\n";
  text += "ms are of the processor; points, times as fast: beside the fullest other packer\n";
  const AtlasRow* last = nullptr;
  for (const AtlasRow& row : result.rows) {
    if (!last || row.set != last->set || row.textures != last->textures)
      text += fmt::format(
          "\n{}, {} textures\n  {:<24} {:>8} {:>13} {:>9} {:>19} {:>9} {:>6} {:>10} {:>10}\n",
          row.set, grouped(static_cast<std::int64_t>(row.textures)), "", "full", "atlas", "ms",
          "quartiles", "search ms", "sides", "leaf tests", "bytes");
    text += row_text(row, fullest_peer(result.rows, row));
    last = &row;
  }
  return text;
}

std::string to_csv(const AtlasBenchResult& result) { return csv_of(result.rows); }

std::string to_json(const AtlasBenchResult& result) {
  const Circumstances& c = result.circumstances;
  JsonWriter json;
  json.begin_object().line().member("format", "lantern.bench.atlas/1");
  json.line().member("rounds", result.config.rounds).member("seed", result.config.seed);
  json.line().member("command", result.command);
  json.line().member("version", c.version).member("sources", c.sources);
  json.line().member("compiler", c.compiler).member("flags", c.flags);
  json.line().member("processor", c.processor);
  write_rows("contestants", result.contestants, json);
  write_rows("rows", result.rows, json);
  json.line().end_object();
  return json.text() + "\n";
}

}  // namespace lantern::report
