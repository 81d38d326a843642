#include "spatial/trees/sort_and_sweep.hpp"

namespace lantern::spatial {

extern const StructureEntry sort_and_sweep_entry;
const StructureEntry sort_and_sweep_entry{{.words = "sort and sweep",
                                           .settings = bits_of({Setting::axis}),
                                           .is_tree = false,
                                           .meets_in_leaves = false,
                                           .splits = false},
                                          made<SortAndSweep<2>>,
                                          made<SortAndSweep<3>>};

}  // namespace lantern::spatial
