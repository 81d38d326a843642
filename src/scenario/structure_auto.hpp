// `kind = "auto"`: which structure suits the bodies of a scenario.
#pragma once

#include "scenario/draft.hpp"

namespace lantern::scenario {

// In place of each structure that leaves its kind to the bodies, the one that
// spatial::choose_structure takes for all bodies as the file places them, and why. Without a world
// nothing happens.
void choose_structures(Draft& draft);

}  // namespace lantern::scenario
