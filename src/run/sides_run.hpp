// The script under the settings of every side, on one clock.
#pragma once

#include <functional>

#include "run/director.hpp"

namespace lantern::run {

// As `direct`, of a scenario with sides: the k-th frame of a step has the k-th of each side. A side
// that has fewer holds its last. Throws ScenarioError, at the step's place, too, when the frames of
// one step need more memory than there is.
DirectorReport direct_sides(const Scenario& scenario, Pace pace, Work& work,
                            const std::function<bool(const Frame&)>& sink, RunWatch* watch);

}  // namespace lantern::run
