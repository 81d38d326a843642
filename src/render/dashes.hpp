// Outlines as polylines, and their dashes.
#pragma once

#include <vector>

#include "geometry/box.hpp"

namespace lantern::render {

// A straight piece of a dash. Its ends are square; where the dash goes on round a corner, the end
// reaches beyond it so that the two pieces meet without a notch.
struct DashPiece {
  Vec<2> from{0.0};
  Vec<2> to{0.0};
};

// Dashes of length `dash` with gaps as long, from the first point on, of lines `width` wide. Only
// pieces that may touch `visible` are made. `closed` joins the last point to the first.
std::vector<DashPiece> cut_dashes(const std::vector<Vec<2>>& points, bool closed, double dash,
                                  double width, const Box<2>& visible);

// The outline of a box with round corners, clockwise from the upper left corner's right end, where
// SVG starts too. No corner of the polyline is farther from the arc than a tenth of a unit.
std::vector<Vec<2>> outline_of(const Box<2>& box, double radius);

}  // namespace lantern::render
