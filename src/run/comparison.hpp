// `compare`: bodies alone in a world of their own, through one step, for several structures.
#pragma once

#include <vector>

#include "frame/parts/panels.hpp"
#include "language/scenario.hpp"

namespace lantern::run {

// What each of these kinds does for those bodies of the scenario, placed as they enter, in one
// world step. `settings` are those of all kinds: capacity, depth limit, cells and planes. Throws
// Refused as world and structures do, and beyond kMostPairs pairs.
template <int D>
FrameComparison::Row compare_kinds(const Scenario& scenario, const StructureSpec& settings,
                                   const std::vector<std::size_t>& bodies,
                                   const std::vector<StructureKind>& kinds);

// Before anything was compared: the columns and rows that the script will fill.
FrameComparison empty_comparison(const Scenario& scenario);

}  // namespace lantern::run
