#include "spatial/trees/sort_and_sweep.hpp"

#include "spatial/trees/brute_force.hpp"

namespace lantern::spatial {

extern const StructureEntry sort_and_sweep_entry;
const StructureEntry sort_and_sweep_entry{{.words = "sort and sweep",
                                           .settings = bits_of({Setting::axis}),
                                           .is_tree = false,
                                           .meets_in_leaves = false,
                                           .splits = false},
                                          made<SortAndSweep<2>>,
                                          made<SortAndSweep<3>>};

extern const StructureEntry brute_force_entry;
const StructureEntry brute_force_entry{{.words = "brute force", .is_tree = false, .splits = false},
                                       made<BruteForce<2>>,
                                       made<BruteForce<3>>};

}  // namespace lantern::spatial
