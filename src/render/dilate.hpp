// Halos: what lies within some distance of a shape given by its coverage.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lantern {

// The coverage of all points within `radius` pixels of `coverage` (width x height, rows from the
// top), in an image that is larger by `margin` on each side. By the exact distance transform of
// Felzenszwalb and Huttenlocher (2012), in time that does not depend on the radius.
std::vector<std::uint8_t> dilated(std::span<const std::uint8_t> coverage, int width, int height,
                                  int margin, double radius);

}  // namespace lantern
