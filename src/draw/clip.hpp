// Cutting shapes to a rectangle, for what would reach out of its panel.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "draw/draw_list.hpp"

namespace lantern {

// The part of a polygon that lies in the rectangle; empty if there is none. Of a polygon that is
// not convex, parts may stay joined along the rectangle's edge.
std::vector<Vec<2>> cut_to(std::vector<Vec<2>> polygon, const Box<2>& rect);

// Cuts the list's rectangles and polygons from index `first` on; what lies outside goes. Lines
// stay only when they lie inside, texts never.
void cut_shapes(DrawList& list, std::size_t first, const Box<2>& rect);

// The part of a line that lies in the rectangle; nothing if there is none, or an end is not finite.
std::optional<std::pair<Vec<2>, Vec<2>>> cut_line(const Vec<2>& from, const Vec<2>& to,
                                                  const Box<2>& rect);

}  // namespace lantern
