// The caption, and the counters at its right.
#pragma once

#include "draw/labels.hpp"
#include "scenario/frame.hpp"

namespace lantern {

// Draws both at the foot of the page; gives the y of the hairline above them.
double draw_footer(const Frame& frame, double margin, DrawList& list, Labels& labels);

}  // namespace lantern
