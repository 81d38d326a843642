// [level]: its walls.

#include <fmt/format.h>

#include "scenario/draft.hpp"
#include "scenario/key.hpp"

namespace lantern::scenario {
namespace {

// Walls of no length have no line.
void check_loops(const LevelSpec& level, const TableReader& table) {
  std::size_t walls = 0, number = 0;
  for (const auto& loop : level.loops) {
    ++number;
    walls += loop.size();
    for (std::size_t i = 0; i < loop.size(); ++i)
      if (loop[i] == loop[(i + 1) % loop.size()]) {
        table.bad_value("loops",
                        fmt::format("polygon {} has the corner [{}, {}] twice in a row", number,
                                    loop[i].x, loop[i].y),
                        "the last corner is joined to the first by itself");
        break;
      }
  }
  if (walls > kMostWalls)
    table.bad_value("loops", fmt::format("{} walls in all, the limit is {}", walls, kMostWalls));
}

}  // namespace

TableDoc level_table() {
  using namespace keys;
  using L = LevelSpec;
  TableDoc table = {
      "level", "[level]",
      "Walls in a 2D world that `do = \"compile\"` turns into a BSP, as for a first-person game."};
  table.keys = {
      key(&L::loops, "loops",
          "Closed polygons, as `[[[0, 0], [8, 0], [8, 6]]]`, each with its solid side on the "
          "right as you go round. 2000 walls in all are allowed.",
          must(), range(-kFar, kFar)),
      key(&L::balance, "balance",
          "What a line's score counts for each wall that one side has more than the other.",
          range(0, 1e6)),
      key(&L::cuts, "cuts", "What it counts for each wall that the line cuts in two.",
          range(0, 1e6)),
      key(KeyType::choice, "choose", "The line with the lowest score, or the first wall's.",
          one_of({"score", "first_wall"}), by_default("\"score\"")),
  };
  return table;
}

void read_level(const TableReader& file, Draft& draft) {
  if (file.has("level")) draft.scenario.level.emplace();  // a bad one is told once
  for (const TomlValue* value : file.tables("level")) {
    const TableReader table = open(*value, language_table("level"), draft);
    LevelSpec level;
    table.fill(level);
    level.first_wall = table.get<std::string>("choose") == "first_wall";
    level.where = draft.position(value->where);
    check_loops(level, table);
    draft.scenario.level = std::move(level);
    if (!draft.has_world)
      draft.problems.add(value->where, "a [level] needs a [world]",
                         "add [world] with size = [64, 64]");
    else if (draft.dimension == 3)
      draft.problems.add(value->where, "a [level] needs a 2D world, this one is 3D",
                         "write [world] with size = [64, 64]");
  }
}

}  // namespace lantern::scenario
