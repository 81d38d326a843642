// What the list of structures knows of each; aabb_tree.cpp says it of its own.
#include "spatial/grid/grid.hpp"
#include "spatial/trees/brute_force.hpp"
#include "spatial/trees/bsp.hpp"
#include "spatial/trees/kd_tree.hpp"
#include "spatial/trees/lecture_quadtree.hpp"
#include "spatial/trees/orthtree.hpp"
#include "spatial/trees/sort_and_sweep.hpp"
#include "spatial/trees/wide_bvh.hpp"

namespace lantern::spatial {
namespace {

template <int D>
constexpr StructureTraits kTraits{
    .words = D == 2 ? "quadtree" : "octree",
    .settings = bits_of(
        {Setting::capacity, Setting::max_depth, Setting::children, Setting::no_progress_stop}),
    .least_dimension = D,
    .shares_array = true,
    .ignores_height = D == 2,
    .is_of_lecture = true};

}  // namespace

const StructureEntry quadtree_entry{kTraits<2>, made<Quadtree>, made<Upright<Quadtree>>};
const StructureEntry octree_entry{kTraits<3>, nullptr, made<Octree>};

const StructureEntry lecture_quadtree_entry{
    {.words = "lecture's quadtree",
     .settings =
         bits_of({Setting::capacity, Setting::max_depth, Setting::as_printed, Setting::root}),
     .ignores_height = true,
     .is_plain = true},
    made<LectureQuadtree>,
    made<Upright<LectureQuadtree>>};

const StructureEntry kd_tree_entry{{.words = "kD-tree",
                                    .settings = bits_of({Setting::capacity, Setting::max_depth}),
                                    .is_fitted = true,
                                    .hugs = true,
                                    .is_of_lecture = true,
                                    .tells = 0},
                                   made<KdTree<2>>,
                                   made<KdTree<3>>};

const StructureEntry bsp_entry{{.words = "BSP",
                                .settings = bits_of({Setting::planes}),
                                .splits = false,
                                .is_of_lecture = true,
                                .names = NodeNames::sides},
                               made<Bsp<2>>,
                               made<Bsp<3>>};

const StructureEntry sort_and_sweep_entry{{.words = "sort and sweep",
                                           .settings = bits_of({Setting::axis}),
                                           .is_tree = false,
                                           .meets_in_leaves = false,
                                           .splits = false},
                                          made<SortAndSweep<2>>,
                                          made<SortAndSweep<3>>};

const StructureEntry brute_force_entry{{.words = "brute force", .is_tree = false, .splits = false},
                                       made<BruteForce<2>>,
                                       made<BruteForce<3>>};

const StructureEntry wide_bvh_entry{{.words = "wide BVH",
                                     .meets_in_leaves = false,
                                     .splits = false,
                                     .is_fitted = true,
                                     .hugs = true,
                                     .tells = 0},
                                    made<WideBvh<2>>,
                                    made<WideBvh<3>>};

const StructureEntry grid_entry{
    {.words = "grid",
     .settings = bits_of({Setting::cell, Setting::levels, Setting::open}),
     .meets_in_leaves = false,
     .splits = false,
     .names = NodeNames::cells,
     .tells = bits_of({EventKind::make_child, EventKind::test, EventKind::store})},
    made<Grid<2>>,
    made<Grid<3>>};

}  // namespace lantern::spatial
