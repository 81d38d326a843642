// The outlines of collision volumes on the page.
#pragma once

#include <vector>

#include "geometry/plane.hpp"
#include "scenario/frame.hpp"

namespace lantern {

inline bool is_half_space(const FrameBody& body) {
  return std::holds_alternative<HalfSpace<3>>(body.shape);
}

// The outline of a box or capsule that turns, when the body's box fills `place`; convex. Empty for
// any other shape.
std::vector<Vec<2>> turned_outline(const FrameBody& body, const Box<2>& place);

// The surface of a half-space through this point of the page; the solid is behind it.
Plane<2> page_surface(const FrameBody& body, const Vec<2>& through);

}  // namespace lantern
