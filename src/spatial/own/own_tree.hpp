// A structure of a user's own among ours: one type for all of them, since only the program that was
// given one knows what it is.
#pragma once

#include <memory>

#include "spatial/own_structure.hpp"
#include "spatial/structure.hpp"

namespace lantern::spatial {

// Null for one of ours.
const OwnKind* own_structure(StructureKind kind);

// An empty one. In three dimensions it looks at x and z only. Whatever goes wrong in the tree is
// thrown, as a StructureFault, by the next insert or look; the structure must be cleared then. Who
// watches is told what must have happened, when it has.
template <int D>
std::unique_ptr<Structure<D>> own_tree(const OwnKind& kind, const StructureConfig<D>& config);

}  // namespace lantern::spatial
