// Draws that are sorted by image paint the same picture, and bind less often.
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "atlas/atlas.hpp"
#include "base/random.hpp"

namespace lantern::atlas {
namespace {

using Elements = std::vector<ScreenElement>;

// Who is seen at each pixel when the elements are drawn in this order.
std::map<std::pair<int, int>, std::size_t> painted(const Elements& elements,
                                                   const std::vector<std::size_t>& order) {
  std::map<std::pair<int, int>, std::size_t> seen;
  for (const std::size_t i : order) {
    const Rect& r = elements[i].place;
    for (int y = r.y; y < r.y + r.height; ++y)
      for (int x = r.x; x < r.x + r.width; ++x) seen[{x, y}] = i;
  }
  return seen;
}

std::vector<std::size_t> as_listed(const Elements& elements) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < elements.size(); ++i) order.push_back(i);
  return order;
}

std::uint64_t bindings_of(const Elements& elements, const std::vector<std::size_t>& order) {
  Binder binder;
  for (const std::size_t i : order) {
    binder.bind(elements[i].image);
    binder.draw();
  }
  EXPECT_EQ(binder.draws, elements.size());
  return binder.bindings;
}

TEST(Binder, BindsWhenTheImageChangesAndNotBefore) {
  Binder binder;
  EXPECT_FALSE(binder.bound);
  EXPECT_TRUE(binder.bind(7));
  EXPECT_FALSE(binder.bind(7));
  EXPECT_TRUE(binder.bind(0));
  EXPECT_TRUE(binder.bind(7));
  EXPECT_EQ(binder.bindings, 3u);
  EXPECT_EQ(binder.draws, 0u);
}

TEST(Binder, SortedDrawsPaintTheSamePicture) {
  Random random(5);
  std::uint64_t listed = 0, sorted = 0;
  for (int round = 0; round < 60; ++round) {
    Elements elements;
    const auto n = static_cast<std::size_t>(random.whole(0, 14));
    for (std::size_t i = 0; i < n; ++i) {
      const auto number = [&](int least, int most) {
        return static_cast<int>(random.whole(least, most));
      };
      elements.push_back({static_cast<std::uint32_t>(number(0, 3)),
                          {number(0, 30), number(0, 30), number(1, 9), number(1, 9)}});
    }
    const std::vector<std::size_t> order = sorted_by_image(elements);
    EXPECT_EQ(std::set(order.begin(), order.end()).size(), n) << "each once";
    EXPECT_EQ(painted(elements, order), painted(elements, as_listed(elements)));
    listed += bindings_of(elements, as_listed(elements));
    sorted += bindings_of(elements, order);
  }
  EXPECT_LT(2 * sorted, 3 * listed / 2) << "it pays";
}

TEST(Binder, ElementsThatOnlyTouchAreOfOneLayer) {
  const Elements row{{0, {0, 0, 4, 4}}, {1, {4, 0, 4, 4}}, {0, {8, 0, 4, 4}}, {1, {0, 4, 4, 4}}};
  EXPECT_EQ(sorted_by_image(row), (std::vector<std::size_t>{0, 2, 1, 3}));
  EXPECT_EQ(bindings_of(row, sorted_by_image(row)), 2u);
  // Of one layer the one with the smaller image comes first, however it was listed.
  const Rect middle{10, 20, 4, 5};
  for (const auto& [x, y] : {std::pair{4, 0}, {-4, 0}, {0, 5}, {0, -5}}) {
    const Rect beside{10 + x, 20 + y, 4, 5};
    const Rect over{beside.x - x / 4, beside.y - y / 5, 4, 5};  // by one pixel
    EXPECT_EQ(sorted_by_image({{1, middle}, {0, beside}}), (std::vector<std::size_t>{1, 0}));
    EXPECT_EQ(sorted_by_image({{1, middle}, {0, over}}), (std::vector<std::size_t>{0, 1}));
  }
}

}  // namespace
}  // namespace lantern::atlas
