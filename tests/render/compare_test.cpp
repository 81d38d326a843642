#include "render/compare.hpp"

#include <gtest/gtest.h>

#include "render/support.hpp"

namespace lantern::render {
namespace {

Image filled(int width, int height, std::uint8_t value) {
  return {width, height, std::vector<std::uint8_t>(std::size_t{4} * width * height, value)};
}

TEST(Compare, CountsPixelsBeyondTheTolerance) {
  const Image a = filled(10, 10, 100);
  Image b = a;
  b.rgba[0] = 103;
  b.rgba[4 * 17 + 3] = 90;
  const Comparison exact = compare(a, b, 0);
  EXPECT_TRUE(exact.same_size);
  EXPECT_EQ(exact.differing, 2u);
  EXPECT_EQ(exact.largest, 10) << "alpha counts like any channel";
  EXPECT_EQ(compare(a, b, 3).differing, 1u) << "a difference of the tolerance is none";
  EXPECT_EQ(compare(a, b, 10).differing, 0u);
  EXPECT_EQ(compare(a, b, 10).largest, 10) << "the largest is told whatever the tolerance";
  EXPECT_EQ(compare(a, a, 0).differing, 0u);
}

TEST(Compare, PixelsThatOnlyOneHasDiffer) {
  const Comparison c = compare(filled(10, 4, 0), filled(7, 6, 0), 254);
  EXPECT_FALSE(c.same_size);
  EXPECT_EQ(c.differing, 3u * 4 + 7u * 2);
  EXPECT_EQ(c.largest, 255);
}

TEST(Compare, PictureShowsBothAndMarksTheDifference) {
  const Image a = filled(8, 5, 255);
  Image b = a;
  b.rgba[4 * (3 * 8 + 2)] = 0;
  const Image picture = difference_picture(a, b, 0);
  ASSERT_EQ(picture.width, 24);
  ASSERT_EQ(picture.height, 5);
  EXPECT_EQ(at(picture, 2, 3), (Rgba{255, 255, 255, 255}));
  EXPECT_EQ(at(picture, 8 + 2, 3), (Rgba{0, 255, 255, 255}));
  EXPECT_EQ(at(picture, 16 + 2, 3), (Rgba{214, 0, 0, 255}));
  EXPECT_EQ(at(picture, 16 + 3, 3), (Rgba{255, 255, 255, 255}));
}

TEST(Compare, PictureOfDifferentSizes) {
  const Image picture = difference_picture(filled(4, 4, 255), filled(2, 6, 255), 0);
  EXPECT_EQ(picture.width, 12);
  EXPECT_EQ(picture.height, 6);
  EXPECT_EQ(at(picture, 0, 5), (Rgba{0, 0, 0, 0})) << "expected has no such row";
  EXPECT_EQ(at(picture, 8 + 3, 0), (Rgba{214, 0, 0, 255})) << "only expected has it";
  EXPECT_EQ(at(picture, 8 + 3, 5), (Rgba{0, 0, 0, 0})) << "neither has it";
}

}  // namespace
}  // namespace lantern::render
