// Brightness and colour apart: beside the formulas of BT.709 in real numbers.
#include "render/planes.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.hpp"

namespace lantern::render {
namespace {

int whole(Random& random, int lo, int hi) { return static_cast<int>(random.whole(lo, hi)); }

Image noise(Random& random, int width, int height) {
  Image image{width, height, {}};
  for (int i = 0; i < 4 * width * height; ++i)
    image.rgba.push_back(static_cast<std::uint8_t>(whole(random, 0, 255)));
  return image;
}

std::vector<std::uint8_t> planes_of(const Image& image) {
  std::vector<std::uint8_t> planes(planes_bytes(image.width, image.height));
  put_planes(image, {0, 0, image.width, image.height}, planes);
  return planes;
}

// Items 3.2 to 3.4 of ITU-R BT.709-6, of values 0 ... 255.
struct Sample {
  double y, cb, cr;
};
Sample bt709(double red, double green, double blue) {
  const double y = (0.2126 * red + 0.7152 * green + 0.0722 * blue) / 255;
  return {16 + 219 * y, 128 + 224 * (blue / 255 - y) / 1.8556,
          128 + 224 * (red / 255 - y) / 1.5748};
}

TEST(Planes, AreTheNumbersOfBt709) {
  Random random(7);
  for (const auto& [width, height] : {std::pair{16, 8}, {17, 9}, {1, 1}, {2, 5}, {31, 2}}) {
    const Image image = noise(random, width, height);
    const std::vector<std::uint8_t> planes = planes_of(image);
    const auto at = [&, w = width, h = height](int x, int y, int channel) {
      const int i = std::clamp(y, 0, h - 1) * w + std::clamp(x, 0, w - 1);
      return static_cast<double>(image.rgba[static_cast<std::size_t>(4 * i + channel)]);
    };
    constexpr double kNearest = 0.52;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        ASSERT_NEAR(planes[static_cast<std::size_t>(y * width + x)],
                    bt709(at(x, y, 0), at(x, y, 1), at(x, y, 2)).y, kNearest);
    const int columns = (width + 1) / 2, rows = (height + 1) / 2;
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x) {
        double mean[3] = {};
        for (int channel = 0; channel < 3; ++channel)
          for (int row = 0; row < 2; ++row)
            for (int column = -1; column <= 1; ++column)
              mean[channel] += (column == 0 ? 2 : 1) * at(2 * x + column, 2 * y + row, channel) / 8;
        const Sample wanted = bt709(mean[0], mean[1], mean[2]);
        const int i = width * height + y * columns + x;
        ASSERT_NEAR(planes[static_cast<std::size_t>(i)], wanted.cb, kNearest);
        ASSERT_NEAR(planes[static_cast<std::size_t>(i + columns * rows)], wanted.cr, kNearest);
      }
  }
}

TEST(Planes, OfGreyHaveNoColour) {
  for (int grey = 0; grey < 256; ++grey) {
    const auto value = static_cast<std::uint8_t>(grey);
    const std::vector<std::uint8_t> planes = planes_of({1, 1, {value, value, value, 255}});
    EXPECT_EQ(planes[0], std::lround(16 + 219 * grey / 255.0));
    EXPECT_EQ(planes[1], 128);
    EXPECT_EQ(planes[2], 128);
  }
}

// What is taken over of a picture, beside what all of it would give.
TEST(Planes, ArePutInPart) {
  Random random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const int width = whole(random, 1, 40), height = whole(random, 1, 20);
    Image image = noise(random, width, height);
    std::vector<std::uint8_t> planes = planes_of(image);
    const Image other = noise(random, width, height);
    PixelRect rect;
    rect.x0 = whole(random, 0, width - 1);
    rect.y0 = whole(random, 0, height - 1);
    rect.x1 = whole(random, rect.x0 + 1, width);
    rect.y1 = whole(random, rect.y0 + 1, height);
    for (int y = rect.y0; y < rect.y1; ++y)
      std::copy_n(other.rgba.begin() + 4 * (y * width + rect.x0), 4 * (rect.x1 - rect.x0),
                  image.rgba.begin() + 4 * (y * width + rect.x0));
    put_planes(image, rect, planes);
    ASSERT_EQ(planes, planes_of(image)) << width << " x " << height;
  }
}

}  // namespace
}  // namespace lantern::render
