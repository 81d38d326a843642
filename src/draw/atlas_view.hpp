// The atlas panel: the packed image, and beside it the textures that wait or were refused.
#pragma once

#include "draw/labels.hpp"
#include "scenario/frame.hpp"

namespace lantern {

void draw_atlas(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);

// Width that the panel wants at this height, page units.
double atlas_width(const Frame& frame, double height);

}  // namespace lantern
