// The course: scenarios in the order in which one would teach them, as Markdown.
#pragma once

#include <string>
#include <vector>

namespace lantern::app {

// Runs the scenarios of these files and prints of each its idea, those to be seen before, and its
// questions, with the answers and what proves them. Gives the exit code; what cannot be read, or
// does not hold, is said on standard error.
int print_course(const std::vector<std::string>& files);

}  // namespace lantern::app
