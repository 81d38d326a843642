// Polygons as coverage masks, made on the CPU and kept from frame to frame. Filling by exact area
// and outlining by distance take every edge once; a fragment shader would look at all edges near
// each pixel, which took eight times as long and doubled the time to the first frame.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "geometry/box.hpp"
#include "render/canvas.hpp"
#include "render/instances.hpp"

namespace lantern::render {

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

// A part of a polygon's bounds: inside, or with masks in the store, row by row.
struct PolygonTile {
  PixelRect rect;
  std::int32_t fill = 0;    // index of the mask; 0 if all pixels are inside
  std::int32_t stroke = 0;  // index of the mask; 0 if the outline touches no pixel
};

class PolygonMasks {
 public:
  explicit PolygonMasks(MaskStore& store) : store_(store) {}
  void forget() { known_.clear(); }

  // Corners in pixels; half_line is half the width of the outline, 0 for none. Only tiles that the
  // polygon touches, in the image of `canvas`; that must be the same one until forget().
  const std::vector<PolygonTile>& tiles(const std::vector<Vec<2>>& corners, double half_line,
                                        const Canvas& canvas);

 private:
  MaskStore& store_;
  std::map<std::vector<double>, std::vector<PolygonTile>> known_;
};

}  // namespace lantern::render
