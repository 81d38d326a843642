// The problems that Lantern carries with it: scenarios whose answer is known.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "language/scenario.hpp"

namespace lantern::measure {

// Names of the files of scenarios/problems/ and of its crowds/, in alphabetical order.
std::vector<std::string_view> problem_names();

// One of them; it must be there.
Scenario known_problem(std::string_view name);

}  // namespace lantern::measure
