// Coverage of pixels by polygons and their outlines.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/instances.hpp"

namespace lantern {

// A directed edge in pixels: x and y of its first point, x and y of its last.
using Edge = std::array<double, 4>;

// The share of each pixel of `rect` to the right of the edges, those going down counting +1, those
// going up -1; exact up to rounding, with 0 ... 1 as 0 ... 255. `winding` is added: edges to the
// left of all of `rect` may be left out for it, those to the right may be left out altogether.
// Self- intersections are filled by the non-zero rule, but not exactly. `mask` holds the rows of
// `rect`.
void fill_coverage(std::span<const Edge> edges, int winding, const PixelRect& rect,
                   std::uint8_t* mask);

// The coverage by a line along the edges, round at the corners, half_line to each side. False if
// none of the pixels is touched; then `mask` is left as it was.
bool line_coverage(std::span<const Edge> edges, double half_line, const PixelRect& rect,
                   std::uint8_t* mask);

}  // namespace lantern
