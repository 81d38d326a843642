// Convex polygons: the regions into which lines cut the plane.
#pragma once

#include <vector>

#include "geometry/plane.hpp"

namespace lantern::geometry {

// Corners in counter-clockwise order; fewer than three corners mean an empty region.
using Polygon = std::vector<Vec<2>>;

// The corners of a box, from its lower left.
inline Polygon polygon_of(const Box<2>& box) {
  return {box.lo, {box.hi.x, box.lo.y}, box.hi, {box.lo.x, box.hi.y}};
}

// The part of a convex polygon on one side of a line (Sutherland and Hodgman 1974).
inline Polygon clipped(const Polygon& polygon, const Plane<2>& line, bool keep_front) {
  const auto height_within = [&](const Vec<2>& p) {
    return keep_front ? height(p, line) : -height(p, line);
  };
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec<2>& from = polygon[i];
    const Vec<2>& to = polygon[(i + 1) % polygon.size()];
    const double a = height_within(from);
    const double b = height_within(to);
    if (a >= 0) kept.push_back(from);
    if ((a > 0 && b < 0) || (a < 0 && b > 0)) kept.push_back(from + (to - from) * (a / (a - b)));
  }
  if (kept.size() < 3) kept.clear();
  return kept;
}

}  // namespace lantern::geometry
