#include "render/compare.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace lantern {
namespace {

using Pixel = std::array<std::uint8_t, 4>;

bool has(const Image& image, int x, int y) { return x < image.width && y < image.height; }

// Transparent black where the image has no pixel.
Pixel pixel(const Image& image, int x, int y) {
  Pixel p{};
  if (has(image, x, y))
    std::copy_n(image.rgba.begin() + 4 * (std::ptrdiff_t{y} * image.width + x), 4, p.begin());
  return p;
}

int difference(const Pixel& a, const Pixel& b) {
  int largest = 0;
  for (std::size_t c = 0; c < 4; ++c) largest = std::max(largest, std::abs(a[c] - b[c]));
  return largest;
}

// Marked in a strong red where the images differ, else the expected pixel, washed out.
Pixel marked(const Pixel& expected, bool differs) {
  if (differs) return {214, 0, 0, 255};
  Pixel paled{0, 0, 0, 255};
  for (std::size_t c = 0; c < 3; ++c) {
    // On white, as a viewer would show it.
    const int shown = (expected[c] * expected[3] + 255 * (255 - expected[3])) / 255;
    paled[c] = static_cast<std::uint8_t>(255 - (255 - shown) / 4);
  }
  return paled;
}

void put(Image& image, int x, int y, const Pixel& p) {
  std::copy(p.begin(), p.end(), image.rgba.begin() + 4 * (std::ptrdiff_t{y} * image.width + x));
}

}  // namespace

Comparison compare(const Image& expected, const Image& actual, int tolerance) {
  Comparison result;
  result.same_size = expected.width == actual.width && expected.height == actual.height;
  if (result.same_size && expected.rgba == actual.rgba) return result;
  for (int y = 0; y < std::max(expected.height, actual.height); ++y)
    for (int x = 0; x < std::max(expected.width, actual.width); ++x) {
      if (!has(expected, x, y) && !has(actual, x, y)) continue;
      // A pixel that only one of them has differs as much as can be.
      const bool both = has(expected, x, y) && has(actual, x, y);
      const int d = both ? difference(pixel(expected, x, y), pixel(actual, x, y)) : 255;
      result.largest = std::max(result.largest, d);
      if (d > tolerance) ++result.differing;
    }
  return result;
}

Image difference_picture(const Image& expected, const Image& actual, int tolerance) {
  const int width = std::max(expected.width, actual.width);
  Image picture{3 * width, std::max(expected.height, actual.height), {}};
  picture.rgba.assign(std::size_t{4} * picture.width * picture.height, 0);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < width; ++x) {
      const Pixel e = pixel(expected, x, y), a = pixel(actual, x, y);
      const bool none = !has(expected, x, y) && !has(actual, x, y);
      const bool one = has(expected, x, y) != has(actual, x, y);
      put(picture, x, y, e);
      put(picture, width + x, y, a);
      if (!none) put(picture, 2 * width + x, y, marked(e, one || difference(e, a) > tolerance));
    }
  return picture;
}

}  // namespace lantern
