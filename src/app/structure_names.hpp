// Structures by their names, as words of the command line.
#pragma once

#include <string>
#include <vector>

#include "app/commands/command.hpp"
#include "rooms.hpp"
#include "spatial/structure_kind.hpp"

namespace lantern::app {

// Those that any flat world may have: not an octree, and no bsp, whose planes belong to one level.
// All of them if no name is given. Throws UsageError for a name that is none of theirs.
std::vector<StructureKind> structures_called(const std::vector<std::string>& names);

Command structure_bench_command();

}  // namespace lantern::app
