#include "spatial/trees/kd_tree.hpp"

namespace lantern::spatial {

extern const StructureEntry kd_tree_entry;
const StructureEntry kd_tree_entry{{.words = "kD-tree",
                                    .settings = bits_of({Setting::capacity, Setting::max_depth}),
                                    .is_fitted = true,
                                    .hugs = true,
                                    .tells = 0},
                                   made<KdTree<2>>,
                                   made<KdTree<3>>};

}  // namespace lantern::spatial
