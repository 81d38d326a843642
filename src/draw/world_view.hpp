// The world panel: node cells, bodies as characters, candidate pairs.
#pragma once

#include "draw/labels.hpp"
#include "scenario/frame.hpp"

namespace lantern {

// Draws frame.bounds as large as it fits into the panel, y upwards.
void draw_world(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);

}  // namespace lantern
