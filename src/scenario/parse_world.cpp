// The world and its structure.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "base/hash.hpp"
#include "scenario/draft.hpp"

namespace lantern {
namespace {

constexpr double kLeastExtent = 1e-6;

// Where the file's own kind is bad: the mistakes in what follows are found as if it were this, and
// not one is told that only the bad kind brought about.
constexpr StructureKind kGuess = StructureKind::quadtree;

Box<2> read_bounds(const TableReader& world, Draft& draft) {
  Box<2> bounds{Vec<2>(0.0), world.point("size").value_or(Vec<2>(1.0))};
  if (const auto min = world.point("min"), max = world.point("max"); min && max)
    bounds = {*min, *max};
  const Vec<2> size = bounds.size();
  if (size.x >= kLeastExtent && size.y >= kLeastExtent) return bounds;
  draft.problems.add(world.place(world.has("max") ? "max" : "size"),
                     fmt::format("the world must extend at least {} on each axis", kLeastExtent),
                     "'max' lies to the upper right of 'min'");
  return {Vec<2>(0.0), Vec<2>(1.0)};
}

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
    const TableReader table(std::get<TomlTable>(value->data), value->where,
                            language_table("structure.planes"), draft.problems, "a plane");
    PlaneSpec plane;
    plane.name = table.text("name").value_or("");
    plane.point = table.point("point").value_or(Vec<2>(0.0));
    plane.normal = table.point("normal").value_or(Vec<2>(1.0, 0.0));
    plane.where = draft.position(value->where);
    plane.at = table.text("at").value_or(planes.empty() ? "root" : "");
    if (plane.normal == Vec<2>(0.0))
      draft.problems.add(table.place("normal"), "'normal' is zero: it points nowhere",
                         "for an upright line, normal = [1, 0]");
    if (!table.has("at") && !planes.empty())
      draft.problems.add(value->where, "only the first plane may leave out 'at'",
                         "say which region it divides, as at = \"front\"");
    else if (!plane.at.empty())
      tree.take(plane.at, table.place("at"), draft.problems);
    planes.push_back(std::move(plane));
  }
  return planes;
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
  if (table.has("planes")) s.planes = read_planes(table, draft);
  if (table.has("kind") && !table.choice("kind")) {
    s.kind = kGuess;
    return s;
  }
  if (table.has("planes") && s.kind != StructureKind::bsp && !s.planes.empty())
    draft.problems.add(table.key_place("planes"),
                       fmt::format("a structure of kind '{}' has no planes", to_string(s.kind)),
                       "only kind = \"bsp\" has");
  if (!table.has("planes") && s.kind == StructureKind::bsp && s.planes.empty())
    draft.problems.add(table.place("kind"), "a bsp needs the lines that divide it",
                       "as planes = [{ point = [32, 0], normal = [1, 0] }]");
  return s;
}

void read_world(const TableReader& file, Draft& draft) {
  draft.has_world = file.has("world");
  for (const TomlValue* value : file.tables("world")) {
    const TableReader world(std::get<TomlTable>(value->data), value->where, language_table("world"),
                            draft.problems);
    draft.scenario.bounds = read_bounds(world, draft);
    if (const auto h = world.number("time_step")) draft.scenario.time_step = *h;
  }
  for (const TomlValue* value : file.tables("structure")) {
    const TableReader table(std::get<TomlTable>(value->data), value->where,
                            language_table("structure"), draft.problems);
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

bool Names::add(const std::string& name, const NamedRange& range, bool declared,
                Problems& problems) {
  const auto [at, is_new] = ranges_.emplace(name, range);
  if (!is_new)
    problems.add(range.where, fmt::format("the name '{}' is taken", name),
                 fmt::format("line {} has it", at->second.where.line));
  else if (declared)
    declared_.push_back(name);
  return is_new;
}

const NamedRange* Names::find(const std::string& name) const {
  const auto found = ranges_.find(name);
  return found == ranges_.end() ? nullptr : &found->second;
}

int cycled_color(std::int64_t color, std::size_t index) {
  return color == 0 ? static_cast<int>(1 + index % 8) : static_cast<int>(color);
}

std::uint64_t derived_seed(const TableReader& table, const std::string& name, const Draft& draft) {
  if (const auto seed = table.whole("seed")) return static_cast<std::uint64_t>(*seed);
  return Hash().add(draft.scenario.seed).add(std::string_view(name)).value();
}

}  // namespace lantern
