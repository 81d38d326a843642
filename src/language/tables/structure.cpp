// [structure]: the scenario's own, those that steps rebuild, and which one suits the bodies of a
// file that leaves it to them.
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "geometry/flat.hpp"
#include "language/keys/key.hpp"
#include "language/tables/draft.hpp"
#include "spatial/broad_phase.hpp"

namespace lantern::language {
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
  const auto read = [&](const TableReader& table, PlaneSpec& plane) {
    if (planes.empty() && plane.at.empty()) plane.at = "root";
    if (plane.normal == Vec<3>(0.0))
      table.bad_value("normal", "'normal' is zero: it points nowhere",
                      draft.dimension == 3 ? "for an upright plane, normal = [1, 0, 0]"
                                           : "for an upright line, normal = [1, 0]");
    if (!table.has("at") && !planes.empty())
      draft.problems.add(table.where(), "only the first plane may leave out 'at'",
                         "say which region it divides, as at = \"front\"");
    else if (!plane.at.empty())
      tree.take(plane.at, table.place("at"), draft.problems);
    planes.push_back(std::move(plane));
  };
  for_each<PlaneSpec>(structure, "planes", draft, read, "a plane");
  return planes;
}

// A setting that one kind alone has: whether something else is said than what others do anyway.
struct OwnSetting {
  Setting setting;
  bool (*is_said)(const StructureSpec& s);
  const char* lack;
  const char* verb = "has";
};
constexpr OwnSetting kOwnSettings[] = {
    {Setting::planes, [](const StructureSpec& s) { return !s.planes.empty(); }, "has no planes"},
    {Setting::margin, [](const StructureSpec& s) { return s.margin > 0; }, "has no margin"},
    {Setting::following, [](const StructureSpec& s) { return s.following != Following::automatic; },
     "follows no bodies", "does"},
    {Setting::axis, [](const StructureSpec& s) { return s.axis != SweepAxis::widest; },
     "has no axis"},
    {Setting::as_printed, [](const StructureSpec& s) { return s.as_printed; }, "is not printed",
     "is"},
    {Setting::root, [](const StructureSpec& s) { return s.root != Vec<3>(0.0); },
     "is as large as the world"},
};

void check_kind(const TableReader& table, const StructureSpec& s, const Draft& draft) {
  const StructureTraits& traits = traits_of(s.kind);
  for (const OwnSetting& own : kOwnSettings)
    if (const auto key = to_string(own.setting);
        table.has(key) && own.is_said(s) && !traits.has(own.setting))
      table.bad_key(key, fmt::format("a structure of kind '{}' {}", to_string(s.kind), own.lack),
                    fmt::format("only kind = \"{}\" {}", to_string(kinds_with(own.setting).front()),
                                own.verb));
  if (table.has("axis") && s.axis == SweepAxis::z && draft.dimension == 2)
    table.bad_value("axis", "a 2D world has no z axis", "take \"x\" or \"y\"");
  if (!table.has("planes") && traits.has(Setting::planes) && s.planes.empty())
    table.bad_value("kind", "a bsp needs the lines that divide it",
                    draft.dimension == 3
                        ? "as planes = [{ point = [32, 0, 0], normal = [1, 0, 0] }]"
                        : "as planes = [{ point = [32, 0], normal = [1, 0] }]");
  if (table.has("kind") && s.kind == StructureKind::octree && draft.dimension == 2)
    table.bad_value("kind", "an octree needs a 3D world, this one is 2D",
                    "take kind = \"quadtree\", or a world of three dimensions");
}

template <int D>
void choose(const ScenarioSpec& scenario, StructureSpec& structure) {
  std::vector<Box<D>> boxes;
  for (const BodySpec& body : scenario.bodies) {
    const Box<D> box =
        in_dimension<D>(bounding_box(body.shape, body.position, orientation_of(body)));
    if (is_valid(box)) boxes.push_back(box);
  }
  const StructureChoice<D> choice = choose_structure<D>(boxes, StructureConfig<D>());
  structure.kind = choice.kind;
  structure.cell = choice.config.cell;
  structure.levels = choice.config.levels;
  structure.open = choice.config.open;
  structure.why = choice.why;
}

}  // namespace

TableDoc structure_table() {
  using S = StructureSpec;
  TableDoc table = {"structure", "[structure]",
                    "The spatial structure that finds the candidate pairs. It may be rebuilt later "
                    "as another one."};
  table.keys = {
      key(&S::kind, "kind",
          "`brute_force` tests every pair; `sort_and_sweep` sorts boxes along an axis and "
          "compares those that overlap on it; `bsp` cuts along the lines in `planes`; a "
          "`quadtree` cuts a 3D world along x and z, an `octree` along all three; a `kd_tree` "
          "cuts at a body's face, with about half of the bodies on either side; "
          "`lecture_quadtree` is the lecture's own code, which makes all children at a split and "
          "has no stop but the depth limit; a `grid` has equal cells; an `aabb_tree` has a leaf "
          "for each body and the smallest box around what lies below each node, and goes on from "
          "where its bodies were; `auto` takes what suits the bodies as the file places them, and "
          "`explain` says why. A program may be given structures of a user's own, by their names "
          "(`lantern/spatial/own_structure.hpp`). At most 2000000 pairs may be met on one frame.",
          must(), advising("for a structure of your own see lantern/spatial/own_structure.hpp"),
          by_hand()),
      key(&S::capacity, "capacity", "A leaf that holds more splits, if depth is left.",
          range(1, 1000), in("bodies"), by_hand(1, 8)),
      key(&S::max_depth, "max_depth",
          "A leaf at this depth never splits; the root has depth 0. A tree may have 2000000 nodes "
          "and as many entries.",
          range(0, 32), by_hand(0, 8)),
      key(&S::eager_children, "children",
          "Made when something enters them (`lazy`), or all at a split (`eager`).",
          one_of({"lazy", "eager"}), by_hand()),
      key(&S::no_progress_stop, "no_progress_stop",
          "A leaf whose bodies all share one point does not split: that would separate none.",
          by_hand()),
      key(&S::split_static, "split_static",
          "One structure for what never moves, built once, and one for what does.", by_hand()),
      key(&S::cell, "cell",
          "Side of a grid's cells, of several levels the smallest. A closed grid may have 2000000 "
          "of them. `0`: half again as large as nearly all bodies are (19 of 20), but at most "
          "three times the median; anew whenever it is built.",
          range(0, kFar), in("units"), by_hand_in_world(0, 0.5)),
      key(&S::levels, "levels",
          "Of a grid: how many sizes of cells, each twice as large as the one before. A body is on "
          "the finest level whose cells are as large as it is.",
          range(1, 16), by_hand(1, 4)),
      key(&S::open, "open",
          "A grid without a rim, for a world without end: its cells are hashed into buckets. Else "
          "bodies outside of the world are in the cells at its rim.",
          by_hand()),
      key(&S::margin, "margin",
          "Of an `aabb_tree`: its leaves' boxes are larger than their bodies' by this on every "
          "side. A body that moves within its enlarged box changes nothing in the tree.",
          range(0, kFar), by_hand_in_world(0, 0.1)),
      key(&S::following, "following",
          "Of an `aabb_tree`: what is done with a body that has left its leaf's box. It is taken "
          "out and inserted again (`reinsert`), its box and those above it are made anew where "
          "they stand (`refit`), or whichever is quicker.",
          by_hand()),
      key(&S::axis, "axis",
          "Of `sort_and_sweep`: along which it sorts, `widest` for the one along which centres "
          "vary most.",
          by_hand()),
      key(&S::as_printed, "as_printed",
          "Of a `lecture_quadtree`: with two mistakes of the lecture's text. A pair's key is a + "
          "(b << 8), of the bodies' addresses, and of pairs with the same key one is kept; what "
          "lies outside of the root is in no leaf.",
          by_hand()),
      key(&S::root, "root",
          "Of a `lecture_quadtree`: how large its root is, from the world's lowest corner on.",
          range(1e-6, kFar), or_else("as large as the world")),
      key(KeyType::tables, "planes", "A BSP's dividing lines or planes.", at_most(255),
          holds("structure.planes")),
  };
  return table;
}

TableDoc planes_table() {
  using P = PlaneSpec;
  TableDoc table = {"structure.planes", "[[structure.planes]]",
                    "A line, or in a 3D world a plane, that divides a region of a BSP into what "
                    "lies behind it and what lies in front."};
  table.keys = {
      key(&P::name, "name", "Its label.", range(0, 24)),
      key(&P::point, "point", "A point on the line.", must(), range(-kFar, kFar)),
      key(&P::normal, "normal", "At a right angle to the line, towards its front; not zero.",
          must(), range(-kFar, kFar)),
      key(&P::at, "at",
          "The region it divides: `root`, or the path down to it, as `back` or `front.back`. The "
          "lines on that path come earlier.",
          range(1, 2000), or_else("`root` for the first")),
  };
  return table;
}

StructureSpec read_structure(const TableReader& table, const StructureSpec& base, Draft& draft) {
  StructureSpec s = base;
  table.fill(s);
  s.where = draft.position(table.where());
  constexpr double kLeastCell = 1e-9;
  if (table.is_good("cell") && s.cell > 0 && s.cell < kLeastCell)
    table.bad_value(
        "cell", "cells so small are no use",
        fmt::format("allowed is {:g} or more, or 0 for what suits the bodies", kLeastCell));
  if (table.has("planes")) s.planes = read_planes(table, draft);
  if (table.has("kind") && !table.is_good("kind"))
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
    else if (!file.has("body") && !file.has("pattern") && !file.has("map"))
      draft.problems.add(value->where, "a [structure] needs bodies to hold",
                         "add a [[body]] or a [[pattern]]");
  }
}

void check_structures(const TableReader& file, Draft& draft) {
  constexpr double kMostCells = 2e6;
  const ScenarioSpec& s = draft.scenario;
  // Of sides, its table is one with what all of them share.
  if (!s.side.empty() || s.structure.kind == StructureKind::none) return;
  const auto refuse = [&](std::initializer_list<Setting> settings, const std::string& hint) {
    for (const TomlValue* table : file.tables("structure"))
      for (const Setting setting : settings)
        if (const TomlEntry* e = entry_of(std::get<TomlTable>(table->data), to_string(setting)))
          draft.problems.add(
              e->where,
              fmt::format(
                  "a structure of kind '{}' has no '{}'",
                  to_string(s.structure.why.empty() ? s.structure.kind : StructureKind::automatic),
                  e->key),
              hint);
  };
  const auto splits = [](const StructureSpec* one) {
    return traits_of(one->kind).splits && one->kind != StructureKind::none && one->why.empty();
  };
  const auto has_cells = [](const StructureSpec* one) {
    return traits_of(one->kind).has(Setting::cell);
  };
  if (std::ranges::none_of(s.structures(), splits))
    refuse({Setting::capacity, Setting::max_depth, Setting::children, Setting::no_progress_stop},
           "only trees that split have; leave it out, or take kind = \"quadtree\"");
  if (std::ranges::none_of(s.structures(), has_cells))
    refuse({Setting::cell, Setting::levels, Setting::open}, "only kind = \"grid\" has");
  if (!has_cells(&s.structure) || s.structure.open || !(s.structure.cell > 0)) return;
  double cells = 1;
  for (int i = 0; i < draft.dimension; ++i)
    cells *= std::ceil(s.world.bounds.size()[i] / s.structure.cell);
  for (const TomlValue* table : file.tables("structure"))
    if (const TomlEntry* e = entry_of(std::get<TomlTable>(table->data), "cell");
        e && cells > kMostCells)
      draft.problems.add(
          e->where,
          fmt::format("the world has {:.3g} cells of this size, a grid may have 2000000", cells),
          "take larger ones, or open = true");
}

void choose_structures(Draft& draft) {
  ScenarioSpec& scenario = draft.scenario;
  const auto choose_if_asked = [&](StructureSpec& structure) {
    if (structure.kind != StructureKind::automatic) return;
    draft.dimension == 3 ? choose<3>(scenario, structure) : choose<2>(scenario, structure);
  };
  choose_if_asked(scenario.structure);
  for (Step& step : scenario.steps)
    if (auto* rebuild = std::get_if<Rebuild>(&step.verb)) choose_if_asked(rebuild->structure);
}

}  // namespace lantern::language
