// Pixels in memory.
#pragma once

#include <cstdint>
#include <vector>

namespace lantern::render {

// The largest width and height of a picture, pixels.
inline constexpr int kMostSide = 8192;

// Rows from the top, 4 bytes a pixel: red, green, blue, alpha (not premultiplied).
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;
  bool operator==(const Image&) const = default;
};

}  // namespace lantern::render
