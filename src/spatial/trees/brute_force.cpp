#include "spatial/trees/brute_force.hpp"

namespace lantern::spatial {

extern const StructureEntry brute_force_entry;
const StructureEntry brute_force_entry{{.words = "brute force", .is_tree = false, .splits = false},
                                       made<BruteForce<2>>,
                                       made<BruteForce<3>>};

}  // namespace lantern::spatial
