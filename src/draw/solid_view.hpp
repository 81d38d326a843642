// The world panel of a solid world: floor, node cells, bodies and marks under a perspective camera.
#pragma once

#include "draw/labels.hpp"
#include "scenario/frame.hpp"

namespace lantern {

// Draws the world as frame.camera sees it into the panel, and nothing outside of it. Expects
// frame.dimension to be 3.
void draw_solid_world(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);

}  // namespace lantern
