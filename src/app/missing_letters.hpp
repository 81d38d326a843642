// Letters that a scenario writes and no picture can show.
#pragma once

#include <vector>

#include "base/error.hpp"
#include "scenario/scenario.hpp"

namespace lantern::app {

// One warning, at the first of them, if the bundled type lacks letters of the titles, captions,
// notes and names; none if it has all.
std::vector<Diagnostic> missing_letters(const Scenario& scenario);

}  // namespace lantern::app
