// Convex polygons: the regions into which lines cut the plane.
#pragma once

#include <vector>

#include "geometry/plane.hpp"

namespace lantern::geometry {

// Corners in counter-clockwise order; fewer than three corners mean an empty region.
using Polygon = std::vector<Vec<2>>;

// The corners of a box, from its lower left.
Polygon polygon_of(const Box<2>& box);

// The part of a convex polygon on one side of a line (Sutherland and Hodgman 1974).
Polygon clipped(const Polygon& polygon, const Plane<2>& line, bool keep_front);

}  // namespace lantern::geometry
