// Spatial structures: the scenario's own, and those that steps rebuild.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "scenario/draft.hpp"

namespace lantern {
namespace {

// Where the file's own kind is bad: the mistakes in what follows are found as if it were this, and
// not one is told that only the bad kind brought about.
constexpr StructureKind kGuess = StructureKind::quadtree;

// Places that a plane may still take: below each plane, behind it and in front.
class PlaneTree {
 public:
  // Adds a problem if the place does not exist or is taken.
  void take(const std::string& at, Place where, Problems& problems) {
    if (free_.erase(at) > 0) {
      const std::string below = at == "root" ? "" : at + ".";
      free_.insert(below + "back");
      free_.insert(below + "front");
      taken_.insert(at);
      return;
    }
    const bool is_taken = taken_.contains(at);
    problems.add(where,
                 is_taken ? fmt::format("another line divides {} already", in_quotes(at))
                          : fmt::format("there is no region {} yet", in_quotes(at)),
                 nearest(at, {free_.begin(), free_.end()}));
  }

 private:
  std::set<std::string> free_{"root"};
  std::set<std::string> taken_;
};

std::vector<PlaneSpec> read_planes(const TableReader& structure, Draft& draft) {
  std::vector<PlaneSpec> planes;
  PlaneTree tree;
  for (const TomlValue* value : structure.tables("planes")) {
    const TableReader table = open(*value, language_table("structure.planes"), draft, "a plane");
    PlaneSpec plane;
    plane.name = table.text("name").value_or("");
    plane.point = table.point("point").value_or(Vec<3>(0.0));
    plane.normal = table.point("normal").value_or(Vec<3>(1, 0, 0));
    plane.where = draft.position(value->where);
    plane.at = table.text("at").value_or(planes.empty() ? "root" : "");
    if (plane.normal == Vec<3>(0.0))
      draft.problems.add(table.place("normal"), "'normal' is zero: it points nowhere",
                         draft.dimension == 3 ? "for an upright plane, normal = [1, 0, 0]"
                                              : "for an upright line, normal = [1, 0]");
    if (!table.has("at") && !planes.empty())
      draft.problems.add(value->where, "only the first plane may leave out 'at'",
                         "say which region it divides, as at = \"front\"");
    else if (!plane.at.empty())
      tree.take(plane.at, table.place("at"), draft.problems);
    planes.push_back(std::move(plane));
  }
  return planes;
}

void check_kind(const TableReader& table, const StructureSpec& s, Draft& draft) {
  if (table.has("planes") && s.kind != StructureKind::bsp && !s.planes.empty())
    draft.problems.add(table.key_place("planes"),
                       fmt::format("a structure of kind '{}' has no planes", to_string(s.kind)),
                       "only kind = \"bsp\" has");
  if (!table.has("planes") && s.kind == StructureKind::bsp && s.planes.empty())
    draft.problems.add(table.place("kind"), "a bsp needs the lines that divide it",
                       draft.dimension == 3
                           ? "as planes = [{ point = [32, 0, 0], normal = [1, 0, 0] }]"
                           : "as planes = [{ point = [32, 0], normal = [1, 0] }]");
  if (table.has("kind") && s.kind == StructureKind::octree && draft.dimension == 2)
    draft.problems.add(table.place("kind"), "an octree needs a solid world, this one is flat",
                       "take kind = \"quadtree\", or a world of three dimensions");
}

}  // namespace

StructureSpec read_structure(const TableReader& table, const StructureSpec& base, Draft& draft) {
  StructureSpec s = base;
  s.where = draft.position(table.where());
  if (const auto kind = table.choice("kind")) s.kind = static_cast<StructureKind>(*kind);
  if (const auto n = table.whole("capacity")) s.capacity = static_cast<std::uint32_t>(*n);
  if (const auto n = table.whole("max_depth")) s.max_depth = static_cast<std::uint32_t>(*n);
  if (const auto children = table.text("children"))
    s.children = *children == "eager" ? Children::eager : Children::lazy;
  if (table.has("no_progress_stop")) s.no_progress_stop = table.truth("no_progress_stop");
  if (table.has("split_static")) s.split_static = table.truth("split_static");
  if (table.has("planes")) s.planes = read_planes(table, draft);
  if (table.has("kind") && !table.choice("kind"))
    s.kind = kGuess;
  else
    check_kind(table, s, draft);
  return s;
}

void read_structures(const TableReader& file, Draft& draft) {
  for (const TomlValue* value : file.tables("structure")) {
    const TableReader table = open(*value, language_table("structure"), draft);
    draft.scenario.structure = read_structure(table, {}, draft);
    if (!table.has("kind")) draft.scenario.structure.kind = kGuess;
    if (!file.has("world"))
      draft.problems.add(value->where, "a [structure] needs a [world] to partition",
                         "add [world] with size = [64, 64]");
    else if (!file.has("body") && !file.has("pattern"))
      draft.problems.add(value->where, "a [structure] needs bodies to hold",
                         "add a [[body]] or a [[pattern]]");
  }
}

}  // namespace lantern
