// What of a text's words are those of the lesson that it was made from: they were written for
// another world, and need not be true of this one.
#pragma once

#include <vector>

#include "language/scenario.hpp"
#include "rooms.hpp"

namespace lantern::live {

class Play;

// Which step of the lesson each step is; -1: none, somebody has added it.
std::vector<int> steps_in(const language::Scenario& lesson, const language::Scenario& scenario);

// Leaves out captions, answers, notes and what else is said word for word as somewhere in the
// lesson, and what such a caption lights; a bar has the number of its step for a name.
void keep_own_words(language::Scenario& scenario, const language::Scenario& lesson);

// Whether frame for frame the same is there and is counted: then all that is said of the one is
// true of the other.
bool is_same_world(const Play& a, const Play& b);

}  // namespace lantern::live
