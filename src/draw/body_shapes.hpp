// Bodies by their ids, and the outlines of their collision volumes on the page.
#pragma once

#include <unordered_map>
#include <vector>

#include "draw/role.hpp"
#include "geometry/plane.hpp"
#include "scenario/frame.hpp"

namespace lantern {

inline bool is_half_space(const FrameBody& body) {
  return std::holds_alternative<HalfSpace<3>>(body.shape);
}

// The ground of a node that the step is about, or has passed.
inline Role ground_of(Mark mark) {
  if (mark == Mark::lit) return Role::lit_fill;
  return mark == Mark::passed ? Role::passed_fill : Role::panel;
}

std::unordered_map<BodyId, const FrameBody*> by_id(const std::vector<FrameBody>& bodies);

// The point of a half-space's surface that is nearest to a point.
Vec<3> foot_on(const FrameBody& ground, const Vec<3>& point);

// The outline of a box or capsule that turns, when the body's box fills `place`; convex. Empty for
// any other shape.
std::vector<Vec<2>> turned_outline(const FrameBody& body, const Box<2>& place);

// The surface of a half-space through this point of the page; the solid is behind it.
Plane<2> page_surface(const FrameBody& body, const Vec<2>& through);

}  // namespace lantern
