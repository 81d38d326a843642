// `compare`: what each kind of structure does for the same bodies.
#include <algorithm>

#include <fmt/format.h>

#include "scenario/key.hpp"
#include "scenario/script_reading.hpp"
#include "scenario/script_run.hpp"
#include "spatial/structure_work.hpp"

namespace lantern::scenario {
namespace {

constexpr std::size_t kMostRows = 6;  // that have room in one table

// Empty if it can be compared here; otherwise why not.
std::string why_not_compared(StructureKind kind, const ScriptReading& script) {
  if (!counts_its_work(kind))
    return fmt::format("what a '{}' does is not counted", to_string(kind));
  if (!is_possible(kind, script.draft.dimension))
    return "an octree needs a 3D world, this one is 2D";
  if (traits_of(kind).has(Setting::planes) && script.state.structure.planes.empty())
    return "a bsp needs the planes of a [structure] of kind \"bsp\", there are none";
  return {};
}

}  // namespace

TableDoc Compare::table() {
  using namespace keys;
  return {
      .doc =
          "Bodies stand alone in a world of their own, whether they are in this one or not, and "
          "go through one world step; each kind of structure is built for them, then made ready "
          "for where they are after the step, and finds their pairs. Counted are comparisons. "
          "What never moves has a structure of its own, built once. The panel `comparison` gets "
          "a row for it.",
      .keys =
          {
              bodies_key(),
              key(&Compare::row, "row", "What this world is called in the table.", must(),
                  range(1, 24)),
              key(&Compare::kinds, "kinds",
                  "Kinds of structures, with the settings of the [structure] that stands; a `bsp` "
                  "with its planes.",
                  or_else("all of Lantern's own that are possible here and whose work is counted")),
              key(&Compare::verdict, "verdict",
                  "What the row says in words. It may quote counts, as a caption does.",
                  range(0, 56)),
          },
      .example = R"([[step]]
do = "compare"
bodies = ["red", "pink", "blue"]
row = "three ghosts"
kinds = ["brute_force", "quadtree", "grid"]
verdict = "Of {compared_pairs:pair} at best {least_work} compared."
expect = { compared_bodies = 3, step_work = { brute_force = 3 } }
)"};
}

void Compare::read(const TableReader& table, ScriptReading& script) {
  std::vector<bool> named(script.state.in_world.size());
  bodies = script.bodies.take(table.names("bodies"), named, true, "is named twice");
  if (!script.draft.sides.empty())
    table.bad_value("do", "a scenario with sides has no 'compare'",
                    "it sets every kind beside the others by itself: leave out the sides");
  if (script.state.rows_compared++ == kMostRows)
    table.bad_value("do", fmt::format("more than {} worlds are compared", kMostRows));
  if (!table.has("kinds"))
    for (const StructureKind kind : kStructureKinds)
      if (why_not_compared(kind, script).empty()) kinds.push_back(kind);
  for (const StructureKind kind : kinds) {
    const std::string why = why_not_compared(kind, script);
    if (!why.empty()) table.bad_value("kinds", why);
  }
  if (table.is_good("kinds") && kinds.size() < 2)
    table.bad_value("kinds", "one kind alone has nothing beside it", "name two or more");
  check_quotes(table, "verdict", script.draft, script.state);
}

void Compare::act(ScriptRun& run) const {
  FrameComparison::Row found = run.engine().compare(bodies, kinds);
  found.name = row;
  run.frames.add_row(std::move(found), verdict);
  run.frames.settle("compare");
}

}  // namespace lantern::scenario
