// Where in a 2D world a view of a part of it is: a small picture of the whole, in a corner.
#pragma once

#include "draw/draw_list.hpp"
#include "draw/projection.hpp"
#include "frame/frame.hpp"

namespace lantern::draw {

// The corner of the picture where it hides least of the bodies; the frame must have a view.
Box<2> place_of_locator(const Frame& frame, const View2D& map);

// The bounds with their largest cells, bodies as dots, and the part that is shown.
void draw_locator(const Frame& frame, const Box<2>& place, DrawList& list);

}  // namespace lantern::draw
