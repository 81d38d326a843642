// Quads may change places, but never with one that they overlap.
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "render/instances.hpp"

namespace lantern::render {
namespace {

constexpr int kSide = 300;

PixelRect random_rect(Random& random) {
  const int x = static_cast<int>(random.whole(0, kSide - 2));
  const int y = static_cast<int>(random.whole(0, kSide - 2));
  return {x, y, std::min(kSide, x + static_cast<int>(random.whole(1, 60))),
          std::min(kSide, y + static_cast<int>(random.whole(1, 60)))};
}

void paint(std::vector<int>& canvas, const PixelRect& r, int color) {
  for (int y = r.y0; y < r.y1; ++y)
    for (int x = r.x0; x < r.x1; ++x) canvas[static_cast<std::size_t>(y * kSide + x)] = color;
}

TEST(Batches, PaintTheSamePictureAsInOrder) {
  Random random(12);
  BatchList list;
  for (int round = 0; round < 30; ++round) {
    list.start(kSide, kSide);
    std::vector<PixelRect> rects;
    std::vector<int> expected(kSide * kSide, -1), actual(kSide * kSide, -1);
    for (int i = 0; i < 150; ++i) {
      rects.push_back(random_rect(random));
      Instance instance;
      instance.data[0] = i;
      list.add(static_cast<Program>(random.whole(0, 2)), instance, rects.back());
      paint(expected, rects.back(), i);
    }
    std::size_t count = 0;
    for (std::size_t b = 0; b < list.size(); ++b)
      for (const Instance& instance : list.batches()[b].instances) {
        paint(actual, rects[static_cast<std::size_t>(instance.data[0])], instance.data[0]);
        ++count;
      }
    EXPECT_EQ(count, 150u);
    ASSERT_TRUE(actual == expected) << "a quad was painted before one that it covers";
  }
}

TEST(Batches, ApartTheyNeedOneOfEachProgram) {
  BatchList list;
  list.start(1920, 1080);
  for (int i = 0; i < 100; ++i)
    list.add(static_cast<Program>(i % 3), {},
             {60 * (i % 30), 100 * (i / 30), 60 * (i % 30) + 20, 100 * (i / 30) + 20});
  EXPECT_EQ(list.size(), 3u) << "every change of program costs the time of many quads";
}

}  // namespace
}  // namespace lantern::render
