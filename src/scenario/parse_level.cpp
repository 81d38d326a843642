// A level's walls, and the chart.
#include <algorithm>

#include <fmt/format.h>

#include "scenario/draft.hpp"

namespace lantern {
namespace {

// Walls of no length have no line.
void check_loops(const LevelSpec& level, const TableReader& table, Draft& draft) {
  std::size_t walls = 0, number = 0;
  for (const auto& loop : level.loops) {
    ++number;
    walls += loop.size();
    for (std::size_t i = 0; i < loop.size(); ++i)
      if (loop[i] == loop[(i + 1) % loop.size()]) {
        draft.problems.add(table.place("loops"),
                           fmt::format("polygon {} has the corner [{}, {}] twice in a row", number,
                                       loop[i].x, loop[i].y),
                           "the last corner is joined to the first by itself");
        break;
      }
  }
  if (walls > kMostWalls)
    draft.problems.add(table.place("loops"),
                       fmt::format("{} walls in all, the limit is {}", walls, kMostWalls));
}

bool is_count(std::string_view name) {
  const auto counts = known_counts();
  return std::any_of(counts.begin(), counts.end(),
                     [&](const CountDoc& doc) { return doc.name == name; });
}

void check_count(const Named& count, Draft& draft) {
  if (is_count(count.name)) return;
  draft.problems.add(count.where, fmt::format("there is no count {}", in_quotes(count.name)),
                     [name = count.name] {
                       std::vector<std::string_view> known;
                       for (const CountDoc& doc : known_counts()) known.push_back(doc.name);
                       return nearest(name, known);
                     });
}

}  // namespace

void read_level(const TableReader& file, Draft& draft) {
  if (file.has("level")) draft.scenario.level.emplace();  // a bad one is told once
  for (const TomlValue* value : file.tables("level")) {
    const TableReader table = open(*value, language_table("level"), draft);
    LevelSpec level;
    level.loops = table.loops("loops");
    level.balance = table.number("balance").value_or(level.balance);
    level.cuts = table.number("cuts").value_or(level.cuts);
    level.first_wall = table.text("choose") == "first_wall";
    level.where = draft.position(value->where);
    check_loops(level, table, draft);
    draft.scenario.level = std::move(level);
    if (!draft.has_world)
      draft.problems.add(value->where, "a [level] needs a [world]",
                         "add [world] with size = [64, 64]");
    else if (draft.dimension == 3)
      draft.problems.add(value->where, "a [level] needs a flat world, this one is solid",
                         "write [world] with size = [64, 64]");
  }
}

void read_chart(const TableReader& file, Draft& draft) {
  if (file.has("chart")) draft.scenario.chart.emplace();
  for (const TomlValue* value : file.tables("chart")) {
    const TableReader table = open(*value, language_table("chart"), draft);
    ChartSpec chart;
    chart.where = draft.position(value->where);
    chart.logarithmic = table.truth("logarithmic");
    if (const auto x = table.text("x")) {
      chart.x = *x;
      check_count({*x, table.place("x")}, draft);
    }
    std::vector<Named> y = table.texts("y");
    if (const auto bars = table.text("bars")) y = {{*bars, table.place("bars")}};
    for (const Named& count : y) {
      check_count(count, draft);
      if (std::find(chart.y.begin(), chart.y.end(), count.name) != chart.y.end())
        draft.problems.add(count.where,
                           fmt::format("{} stands twice in 'y'", in_quotes(count.name)));
      chart.y.push_back(count.name);
    }
    constexpr std::size_t kMostLines = 8;  // as many as a theme has colours
    if (chart.y.size() > kMostLines)
      draft.problems.add(table.place("y"), fmt::format("{} lines in one chart, the limit is {}",
                                                       chart.y.size(), kMostLines));
    draft.scenario.chart = std::move(chart);
  }
}

}  // namespace lantern
