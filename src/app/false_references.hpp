// What a scenario says of things beyond its own file that is not so.
#pragma once

#include <vector>

#include "base/error.hpp"
#include "scenario/scenario.hpp"

namespace lantern::app {

// A warning for each scenario that it needs and that is neither beside its file nor one of
// Lantern's (a scenario from standard input has no file, and is not asked), and one if its bodies
// are not those of its [problem], which `lantern measure` would refuse; where that can be told at
// once. Those that are meant are left out.
std::vector<Diagnostic> false_references(const Scenario& scenario);

}  // namespace lantern::app
