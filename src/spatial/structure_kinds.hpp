// All structures, as one type.
#pragma once

#include <span>
#include <type_traits>
#include <variant>

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
#include "spatial/structure_kind.hpp"

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

template <int D>
using AnyStructure =
    std::variant<BruteForce<D>, SortAndSweep<D>, QuadtreeIn<D>, OctreeIn<D>, Bsp<D>, KdTree<D>,
                 LectureQuadtree<D>, Grid<D>, AabbTree<D>, OwnStructure<D>>;

// Null for one of ours.
const OwnKind* own_structure(StructureKind kind);

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
