// How far two images are apart.
#pragma once

#include <cstdint>

#include "render/image.hpp"

namespace lantern::render {

struct Comparison {
  bool same_size = false;
  std::uint64_t differing = 0;  // pixels that differ by more than the tolerance
  int largest = 0;              // greatest difference of one channel, 0 ... 255
};

// `tolerance` is the greatest difference of a channel that still counts as equal.
Comparison compare(const Image& expected, const Image& actual, int tolerance);

// Expected, actual and the difference side by side; the differing pixels are marked on the paled
// expected image. Images of different sizes are laid over each other from the upper left corner.
Image difference_picture(const Image& expected, const Image& actual, int tolerance);

}  // namespace lantern::render
