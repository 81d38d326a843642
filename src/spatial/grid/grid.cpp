#include "spatial/grid/grid.hpp"

namespace lantern::spatial {

extern const StructureEntry grid_entry;
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
