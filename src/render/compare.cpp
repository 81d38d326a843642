#include "render/compare.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>

namespace lantern::render {
namespace {

using Pixel = std::array<std::uint8_t, 4>;

// Nothing where the image has none.
std::optional<Pixel> pixel(const Image& image, int x, int y) {
  if (x >= image.width || y >= image.height) return std::nullopt;
  Pixel p{};
  std::copy_n(image.rgba.begin() + 4 * (std::ptrdiff_t{y} * image.width + x), 4, p.begin());
  return p;
}

// A pixel that only one of them has differs as much as can be.
int difference(const std::optional<Pixel>& a, const std::optional<Pixel>& b) {
  if (!a || !b) return a || b ? 255 : 0;
  int largest = 0;
  for (std::size_t c = 0; c < 4; ++c) largest = std::max(largest, std::abs((*a)[c] - (*b)[c]));
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
  std::ranges::copy(p, image.rgba.begin() + 4 * (std::ptrdiff_t{y} * image.width + x));
}

}  // namespace

Comparison compare(const Image& expected, const Image& actual, int tolerance) {
  Comparison result;
  result.same_size = expected.width == actual.width && expected.height == actual.height;
  if (result.same_size && expected.rgba == actual.rgba) return result;
  for (int y = 0; y < std::max(expected.height, actual.height); ++y)
    for (int x = 0; x < std::max(expected.width, actual.width); ++x) {
      const int d = difference(pixel(expected, x, y), pixel(actual, x, y));
      result.largest = std::max(result.largest, d);
      result.differing += d > tolerance;
    }
  return result;
}

Image difference_picture(const Image& expected, const Image& actual, int tolerance) {
  const int width = std::max(expected.width, actual.width);
  Image picture{3 * width, std::max(expected.height, actual.height), {}};
  picture.rgba.assign(std::size_t{4} * picture.width * picture.height, 0);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto e = pixel(expected, x, y), a = pixel(actual, x, y);
      if (e) put(picture, x, y, *e);
      if (a) put(picture, width + x, y, *a);
      const bool differs = !e || !a || difference(e, a) > tolerance;
      if (e || a) put(picture, 2 * width + x, y, marked(e.value_or(Pixel{}), differs));
    }
  return picture;
}

}  // namespace lantern::render
