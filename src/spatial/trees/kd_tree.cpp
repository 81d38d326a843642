#include "spatial/trees/kd_tree.hpp"

#include "spatial/trees/bsp.hpp"

namespace lantern::spatial {

extern const StructureEntry kd_tree_entry;
const StructureEntry kd_tree_entry{{.words = "kD-tree",
                                    .settings = bits_of({Setting::capacity, Setting::max_depth}),
                                    .is_fitted = true,
                                    .hugs = true,
                                    .tells = 0},
                                   made<KdTree<2>>,
                                   made<KdTree<3>>};

extern const StructureEntry bsp_entry;
const StructureEntry bsp_entry{{.words = "BSP",
                                .settings = bits_of({Setting::planes}),
                                .splits = false,
                                .names = NodeNames::sides},
                               made<Bsp<2>>,
                               made<Bsp<3>>};

}  // namespace lantern::spatial
