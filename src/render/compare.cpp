#include "render/compare.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "base/hash.hpp"
#include "base/number.hpp"

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

std::string size_of(const Image& image) {
  return fmt::format("{} x {}", image.width, image.height);
}

// Transparent.
Image blank(int width, int height) {
  return {width, height, std::vector<std::uint8_t>(std::size_t{4} * width * height)};
}

}  // namespace

Comparison compare(const Image& expected, const Image& actual, int tolerance) {
  Comparison result;
  result.same_size = expected.width == actual.width && expected.height == actual.height;
  if (!result.same_size)
    result.sizes = fmt::format("{} pixels, found {}", size_of(expected), size_of(actual));
  if (result.same_size && expected.rgba == actual.rgba) return result;
  for (int y = 0; y < std::max(expected.height, actual.height); ++y)
    for (int x = 0; x < std::max(expected.width, actual.width); ++x) {
      const int d = difference(pixel(expected, x, y), pixel(actual, x, y));
      result.largest = std::max(result.largest, d);
      result.differing += d > tolerance;
    }
  return result;
}

bool passes(const Comparison& comparison, const Image& expected, const Allowance& allowance) {
  const double most = allowance.fraction * static_cast<double>(expected.width) * expected.height;
  return comparison.same_size && static_cast<double>(comparison.differing) <= most;
}

std::string finding(const Comparison& comparison) {
  if (!comparison.same_size) return fmt::format("expected {}", comparison.sizes);
  return fmt::format("{} {}, at most by {}", counted(comparison.differing, "pixel"),
                     comparison.differing == 1 ? "differs" : "differ",
                     counted(comparison.largest, "level"));
}

std::string pixel_hash(const Image& image) {
  Hash hash;
  hash.add(std::uint64_t(image.width)).add(std::uint64_t(image.height));
  hash.add(std::string_view(reinterpret_cast<const char*>(image.rgba.data()), image.rgba.size()));
  return fmt::format("{:016x}", hash.value());
}

Image marked_picture(const Image& expected, const Image& actual, int tolerance) {
  Image picture =
      blank(std::max(expected.width, actual.width), std::max(expected.height, actual.height));
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const auto e = pixel(expected, x, y), a = pixel(actual, x, y);
      const bool differs = !e || !a || difference(e, a) > tolerance;
      if (e || a) put(picture, x, y, marked(e.value_or(Pixel{}), differs));
    }
  return picture;
}

Image difference_picture(const Image& expected, const Image& actual, int tolerance) {
  const Image third = marked_picture(expected, actual, tolerance);
  const int width = third.width;
  Image picture = blank(3 * width, third.height);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < width; ++x) {
      int left = 0;
      for (const Image* image : {&expected, &actual, &third}) {
        if (const auto p = pixel(*image, x, y)) put(picture, left + x, y, *p);
        left += width;
      }
    }
  return picture;
}

}  // namespace lantern::render
