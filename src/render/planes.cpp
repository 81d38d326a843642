#include "render/planes.hpp"

#include <algorithm>
#include <cstring>

#include "base/check.hpp"

namespace lantern::render {
namespace {

// What a value of each channel adds, in parts of 2^kBits. Grey adds `grey` exactly.
constexpr int kBits = 15;
struct Weights {
  std::int32_t red, green, blue;
};
constexpr Weights weights(double red, double blue, double grey) {
  const auto parts = [](double share) {
    return static_cast<std::int32_t>(share * (1 << kBits) + (share < 0 ? -0.5 : 0.5));
  };
  return {parts(red), parts(grey) - parts(red) - parts(blue), parts(blue)};
}

constexpr double kRed = 0.2126, kBlue = 0.0722;  // their shares of brightness
constexpr double kLumaRange = 219.0 / 255, kHalfRange = 112.0 / 255;
constexpr Weights kY = weights(kRed * kLumaRange, kBlue* kLumaRange, kLumaRange);
constexpr Weights kCb = weights(-kRed / (1 - kBlue) * kHalfRange, kHalfRange, 0);
constexpr Weights kCr = weights(kHalfRange, -kBlue / (1 - kRed) * kHalfRange, 0);

// `sums` of 2^more pixels, channel by channel.
constexpr std::uint8_t sample(const Weights& w, int red, int green, int blue, int zero, int more) {
  const int bits = kBits + more;
  return static_cast<std::uint8_t>(
      (w.red * red + w.green * green + w.blue * blue + (zero << bits) + (1 << (bits - 1))) >> bits);
}

std::uint32_t pixel(const std::uint8_t* row, int x) {
  std::uint32_t rgba = 0;
  std::memcpy(&rgba, row + std::ptrdiff_t{4} * x, 4);
  return rgba;
}

// Two pixels, one below the other, added.
struct Sums {
  std::uint32_t red_blue = 0, green = 0;  // blue in the upper half
  Sums(std::uint32_t a, std::uint32_t b)
      : red_blue((a & 0xff00ff) + (b & 0xff00ff)), green((a >> 8 & 255) + (b >> 8 & 255)) {}
};

}  // namespace

std::size_t planes_bytes(int width, int height) {
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  return w * h + 2 * ((w + 1) / 2) * ((h + 1) / 2);
}

void put_planes(const Image& image, const PixelRect& rect, std::vector<std::uint8_t>& planes) {
  const int width = image.width, height = image.height, half = (width + 1) / 2;
  LANTERN_CHECK(planes.size(), ==, planes_bytes(width, height));
  const auto row = [&](int y) { return &image.rgba[std::size_t{4} * y * width]; };
  for (int y = rect.y0; y < rect.y1; ++y) {
    const std::uint8_t* const from = row(y);
    std::uint8_t* const to = &planes[static_cast<std::size_t>(y) * width];
    for (int x = rect.x0; x < rect.x1; ++x) {
      const auto p = static_cast<int>(pixel(from, x));
      to[x] = sample(kY, p & 255, p >> 8 & 255, p >> 16 & 255, 16, 0);
    }
  }
  std::uint8_t* const blues = &planes[static_cast<std::size_t>(width) * height];
  std::uint8_t* const reds = blues + static_cast<std::ptrdiff_t>(half) * ((height + 1) / 2);
  // The column beside the rectangle shares its colours.
  const int first = rect.x0 / 2, end = std::min(rect.x1 / 2 + 1, half);
  for (int y = rect.y0 / 2; y < (rect.y1 + 1) / 2; ++y) {
    const std::uint8_t *const upper = row(2 * y), *const lower =
                                                      row(std::min(2 * y + 1, height - 1));
    const auto column = [&](int x) { return Sums(pixel(upper, x), pixel(lower, x)); };
    Sums left = column(std::max(2 * first - 1, 0));
    for (int x = first; x < end; ++x) {
      const Sums middle = column(2 * x), right = column(std::min(2 * x + 1, width - 1));
      const std::uint32_t both = left.red_blue + 2 * middle.red_blue + right.red_blue;
      const auto red = static_cast<int>(both & 0xffff), blue = static_cast<int>(both >> 16);
      const auto green = static_cast<int>(left.green + 2 * middle.green + right.green);
      const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(half) * y + x;
      blues[at] = sample(kCb, red, green, blue, 128, 3);
      reds[at] = sample(kCr, red, green, blue, 128, 3);
      left = right;
    }
  }
}

}  // namespace lantern::render
