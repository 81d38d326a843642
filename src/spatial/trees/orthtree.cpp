// The quadtree and the octree.
#include "spatial/trees/orthtree.hpp"

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

}  // namespace lantern::spatial
