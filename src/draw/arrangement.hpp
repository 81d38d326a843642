// Where the panels of a group stand on the page.
#pragma once

#include <vector>

#include "draw/staging.hpp"
#include "frame/frame.hpp"
#include "geometry/box.hpp"

namespace lantern::draw {

// One box for each of the frame's panels, in their order, inside `area`; the same for all frames of
// the group. A world and a tree stand side by side or one above the other, and in the parts, in
// which both are drawn largest; a world alone fills the area. On a `tall` page all stand one above
// the other.
std::vector<Box<2>> arranged(const Frame& frame, const Staging& staging, const Box<2>& area,
                             bool tall);

}  // namespace lantern::draw
