// The quadtree and the octree.
#include "spatial/trees/orthtree.hpp"

#include "spatial/trees/lecture_quadtree.hpp"

namespace lantern::spatial {
namespace {

template <int D>
constexpr StructureTraits kTraits{
    .words = D == 2 ? "quadtree" : "octree",
    .settings = bits_of(
        {Setting::capacity, Setting::max_depth, Setting::children, Setting::no_progress_stop}),
    .least_dimension = D,
    .shares_array = true,
    .ignores_height = D == 2};

}  // namespace

extern const StructureEntry quadtree_entry, octree_entry;
const StructureEntry quadtree_entry{kTraits<2>, made<Quadtree>, made<Upright<Quadtree>>};
const StructureEntry octree_entry{kTraits<3>, nullptr, made<Octree>};

extern const StructureEntry lecture_quadtree_entry;
const StructureEntry lecture_quadtree_entry{
    {.words = "lecture's quadtree",
     .settings = bits_of({Setting::capacity, Setting::max_depth}),
     .ignores_height = true,
     .is_plain = true},
    made<LectureQuadtree>,
    made<Upright<LectureQuadtree>>};

}  // namespace lantern::spatial
