// What the tree panel shows of sort and sweep: the bodies' intervals along the sorted axis.
#pragma once

#include "draw/labels.hpp"
#include "scenario/frame.hpp"

namespace lantern {

// One row a body, in the order in which the sweep meets them; the rows of bodies that the step is
// about are lit. Which axis is said in frame.settings ("along y"); x if it is not. Of many bodies
// as many are drawn as have room, and the rest is counted.
void draw_sweep(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);

}  // namespace lantern
