// Polygons as coverage masks, made on the CPU and kept from frame to frame. Filling by exact area
// and outlining by distance take every edge once; a fragment shader would look at all edges near
// each pixel, which took eight times as long and doubled the time to the first frame.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "geometry/box.hpp"
#include "render/canvas.hpp"
#include "render/instances.hpp"
#include "render/mask_store.hpp"

namespace lantern {

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

}  // namespace lantern
