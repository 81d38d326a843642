// The list of structures: a new kind is its own file, one line here, and its picture. A program may
// be given more of them (own_structure.hpp): they come behind ours.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "spatial/aabb_tree.hpp"
#include "spatial/brute_force.hpp"
#include "spatial/bsp.hpp"
#include "spatial/flat_quadtree.hpp"
#include "spatial/grid.hpp"
#include "spatial/kd_tree.hpp"
#include "spatial/lecture_quadtree.hpp"
#include "spatial/orthtree.hpp"
#include "spatial/own_kind.hpp"
#include "spatial/sort_and_sweep.hpp"

namespace lantern::spatial {

// In three dimensions a quadtree looks at x and z only.
template <int D>
using QuadtreeIn = std::conditional_t<D == 2, Quadtree, FlatQuadtree>;

// In two dimensions there is none.
struct NoOctree : BruteForce<2> {
  static NoOctree made(const StructureConfig<2>&) {
    throw Refused("broad phase: octree needs three dimensions");
  }
};
template <int D>
using OctreeIn = std::conditional_t<D == 3, Octree, NoOctree>;

// Name, as users write it, and class template.
#define LANTERN_STRUCTURES(KIND)          \
  KIND(brute_force, BruteForce)           \
  KIND(sort_and_sweep, SortAndSweep)      \
  KIND(quadtree, QuadtreeIn)              \
  KIND(octree, OctreeIn)                  \
  KIND(bsp, Bsp)                          \
  KIND(kd_tree, KdTree)                   \
  KIND(lecture_quadtree, LectureQuadtree) \
  KIND(grid, Grid)                        \
  KIND(aabb_tree, AabbTree)

enum class StructureKind {
  none,       // nobody asks for one
  automatic,  // "auto": whichever suits the bodies, see structure_choice.hpp
#define LANTERN_KIND(name, Type) name,
  // The last is the first that this program was given; the others are the numbers behind.
  LANTERN_STRUCTURES(LANTERN_KIND) own
#undef LANTERN_KIND
};

// All of ours.
inline constexpr std::array kStructureKinds = {
#define LANTERN_KIND(name, Type) StructureKind::name,
    LANTERN_STRUCTURES(LANTERN_KIND)
#undef LANTERN_KIND
};

constexpr bool is_possible(StructureKind kind, int dimension) {
  return kind != StructureKind::octree || dimension == 3;
}

namespace structure_list {
template <int D, class... Types>
struct Of {
  using Any = std::variant<Types...>;
};
template <int D, class First, class... Rest>
struct Of<D, First, Rest...> {
  using Any = std::variant<Rest..., OwnStructure<D>>;
};
#define LANTERN_KIND(name, Type) , Type<D>
template <int D>
using Any = typename Of<D, void LANTERN_STRUCTURES(LANTERN_KIND)>::Any;
#undef LANTERN_KIND
}  // namespace structure_list

template <int D>
using AnyStructure = structure_list::Any<D>;

// Ours, and those that this program was given.
std::vector<StructureKind> known_structures();

// Null for one of ours.
const OwnKind* own_structure(StructureKind kind);

// "none", "auto", "brute_force", "sort_and_sweep", ...
std::string_view to_string(StructureKind kind);
std::optional<StructureKind> structure_named(std::string_view name);

StructureTraits traits_of(StructureKind kind);

// An empty structure. Throws Refused for settings that it does not allow, for an octree in two
// dimensions, and for `none` and `automatic`.
template <int D>
AnyStructure<D> make_structure(StructureKind kind, const StructureConfig<D>& config);

// The tree of these items, instead of what was there; memory is used again. A structure that can do
// only one of these does it that way. Ids ascend.
enum class Build {
  one_by_one,  // as the lecture inserts them
  at_once,     // the same tree, sooner; its nodes may be numbered otherwise
};
template <int D>
void build_structure(AnyStructure<D>& structure, std::span<const Item<D>> items,
                     Build way = Build::one_by_one);

}  // namespace lantern::spatial
