// The lines under a tree diagram: what the tree was told, and what it counts.
#pragma once

#include "draw/labels.hpp"
#include "scenario/frame.hpp"

namespace lantern {

// Draws them at the foot of the panel; gives the height they take.
double draw_tree_facts(const Frame& frame, const Box<2>& panel, Labels& labels);

}  // namespace lantern
