#include "spatial/trees/bsp.hpp"

namespace lantern::spatial {

extern const StructureEntry bsp_entry;
const StructureEntry bsp_entry{{.words = "BSP",
                                .settings = bits_of({Setting::planes}),
                                .splits = false,
                                .names = NodeNames::sides},
                               made<Bsp<2>>,
                               made<Bsp<3>>};

}  // namespace lantern::spatial
