#include "report/reference_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.hpp"
#include "base/stop.hpp"
#include "render/canvas.hpp"
#include "render/renderer.hpp"
#include "report/settled.hpp"

namespace lantern::report {
namespace {

constexpr int kTimes = kReferenceTimes;
constexpr int kTileWidth = 160, kTileHeight = 90;  // pixels of the picture, not of the tile

struct SubPixel {
  int x, y;
};
constexpr std::array<SubPixel, 1> kOne{{{8, 8}}};
constexpr std::array<SubPixel, 4> kFour{{{6, 2}, {14, 6}, {2, 10}, {10, 14}}};
constexpr std::array<SubPixel, 8> kEight{
    {{9, 5}, {7, 11}, {13, 9}, {5, 3}, {3, 13}, {1, 7}, {11, 15}, {15, 1}}};

// The sub-pixels of one pixel of a tile.
class Block {
 public:
  Block(const Image& tile, int x, int y) : tile_(tile), x_(x * kTimes), y_(y * kTimes) {}

  const std::uint8_t* at(int x, int y) const {
    return &tile_.rgba[4 * (static_cast<std::size_t>(y_ + y) * tile_.width + x_ + x)];
  }

  // The mean of each channel; true if the sub-pixels differ.
  bool mean(float* rgb) const {
    std::array<int, 3> sum{};
    bool differ = false;
    const std::uint8_t* first = at(0, 0);
    for (int y = 0; y < kTimes; ++y) {
      const std::uint8_t* p = at(0, y);
      for (int x = 0; x < kTimes; ++x, p += 4)
        for (int c = 0; c < 3; ++c) {
          sum[c] += p[c];
          differ |= p[c] != first[c];
        }
    }
    for (int c = 0; c < 3; ++c) rgb[c] = static_cast<float>(sum[c]) / (kTimes * kTimes);
    return differ;
  }

  template <std::size_t N>
  void sample(const std::array<SubPixel, N>& places, std::uint8_t* rgba) const {
    constexpr int n = static_cast<int>(N);
    for (int c = 0; c < 3; ++c) {
      int sum = 0;
      for (const SubPixel& place : places) sum += at(place.x, place.y)[c];
      rgba[c] = static_cast<std::uint8_t>((sum + n / 2) / n);
    }
    rgba[3] = 255;
  }

 private:
  const Image& tile_;
  int x_, y_;
};

void take(const Image& tile, int left, int top, ReferencePicture& picture) {
  const int right = std::min(left + kTileWidth, picture.width);
  const int bottom = std::min(top + kTileHeight, picture.height);
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * picture.width + x;
      const Block block(tile, x - left, y - top);
      picture.edge[i] = block.mean(&picture.rgb[3 * i]) ? 1 : 0;
      block.sample(kOne, &picture.sampled[0].rgba[4 * i]);
      block.sample(kFour, &picture.sampled[1].rgba[4 * i]);
      block.sample(kEight, &picture.sampled[2].rgba[4 * i]);
    }
}

}  // namespace

ReferencePicture reference_picture(const DrawList& list, const Theme& theme, int width, int height,
                                   Backend backend) {
  ReferencePicture picture;
  picture.width = width;
  picture.height = height;
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  picture.rgb.resize(3 * pixels);
  picture.edge.resize(pixels);
  picture.sampled.assign(std::size(kSampleCounts),
                         {width, height, std::vector<std::uint8_t>(4 * pixels)});
  Renderer renderer(Context::create(backend), kTimes * kTileWidth, kTimes * kTileHeight);
  const Canvas canvas(list.page, width, height);
  const Vec<2> size = Vec<2>(kTileWidth, kTileHeight) / canvas.scale;
  Image tile;
  for (int top = 0; top < height; top += kTileHeight)
    for (int left = 0; left < width; left += kTileWidth) {
      stop_if_asked();
      const Vec<2> corner = (Vec<2>(left, top) - canvas.origin) / canvas.scale;
      renderer.draw(window_of(list, {corner, corner + size}), theme, false, tile);
      take(tile, left, top, picture);
    }
  return picture;
}

void box_filter(const Image& large, int times, Image& small) {
  LANTERN_CHECK(large.width % times + large.height % times, ==, 0);
  small.width = large.width / times;
  small.height = large.height / times;
  small.rgba.resize(std::size_t{4} * small.width * small.height);
  const int n = times * times;
  std::vector<int> sums(std::size_t{3} * small.width);
  const std::uint8_t* from = large.rgba.data();
  std::uint8_t* to = small.rgba.data();
  for (int y = 0; y < small.height; ++y) {
    stop_if_asked();
    std::fill(sums.begin(), sums.end(), 0);
    for (int row = 0; row < times; ++row) {
      int* sum = sums.data();
      for (int x = 0; x < small.width; ++x, sum += 3)
        for (int k = 0; k < times; ++k, from += 4)
          for (int c = 0; c < 3; ++c) sum[c] += from[c];
    }
    for (std::size_t x = 0; x < sums.size(); x += 3, to += 4) {
      for (std::size_t c = 0; c < 3; ++c)
        to[c] = static_cast<std::uint8_t>((sums[x + c] + n / 2) / n);
      to[3] = 255;
    }
  }
}

PictureError error_of(const Image& image, const ReferencePicture& reference) {
  LANTERN_CHECK(image.width == reference.width && image.height == reference.height, ==, true);
  PictureError error;
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < reference.edge.size(); ++i) {
    double worst = 0;
    for (std::size_t c = 0; c < 3; ++c)
      worst = std::max(
          worst, std::abs(double{image.rgba[4 * i + c] * 1.0} - double{reference.rgb[3 * i + c]}));
    error.worst = std::max(error.worst, worst);
    if (reference.edge[i] == 0) {
      error.strays += worst > 1 ? 1 : 0;
      continue;
    }
    ++error.edge_pixels;
    sum += worst;
    squares += worst * worst;
  }
  if (error.edge_pixels == 0) return error;
  const auto n = static_cast<double>(error.edge_pixels);
  error.mean = sum / n;
  error.rms = std::sqrt(squares / n);
  return error;
}

}  // namespace lantern::report
