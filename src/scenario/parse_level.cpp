// A level's walls.

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

}  // namespace lantern
