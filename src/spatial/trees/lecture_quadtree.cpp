#include "spatial/trees/lecture_quadtree.hpp"

namespace lantern::spatial {

extern const StructureEntry lecture_quadtree_entry;
const StructureEntry lecture_quadtree_entry{
    {.words = "lecture's quadtree",
     .settings = bits_of({Setting::capacity, Setting::max_depth}),
     .ignores_height = true,
     .is_plain = true},
    made<LectureQuadtree>,
    made<Upright<LectureQuadtree>>};

}  // namespace lantern::spatial
