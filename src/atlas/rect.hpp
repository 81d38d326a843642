// A rectangle of pixels.
#pragma once

namespace lantern::atlas {

// In pixels; the origin is the upper left corner, y points down, as in an image file.
struct Rect {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  bool operator==(const Rect&) const = default;
};

}  // namespace lantern::atlas
