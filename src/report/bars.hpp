// The bars: promises about accuracy and strength, each measured by a stress case.
#pragma once

#include <functional>
#include <vector>

#include "report/overview.hpp"

namespace lantern {

// Runs the stress cases that are bars and not slow. `stop` is asked before each.
std::vector<Bar> measured_bars();

}  // namespace lantern
