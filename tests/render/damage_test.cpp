// A picture drawn over another, where they differ, has the pixels of one that is drawn alone.
#include "render/damage.hpp"

#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "render/renderer.hpp"
#include "render/sample_scene.hpp"
#include "render/support.hpp"

namespace lantern::render {
namespace {

constexpr int kWidth = 400, kHeight = 225;

DrawShape random_shape(Random& random) {
  const auto in = [&](double from, double to) { return from + (to - from) * random.unit(); };
  const double x = in(-100, 1600), y = in(-100, 900);
  const auto role = static_cast<Role>(random.whole(1, 12));
  const Stroke stroke{static_cast<Role>(random.whole(0, 12)), in(0.5, 12),
                      random.whole(0, 3) == 0 ? in(4, 20) : 0};
  switch (random.whole(0, 4)) {
    case 0:
      return rect(x, y, in(1, 700), in(1, 500), role, stroke, in(0, 40));
    case 1:
      return rect(x, y, in(1, 300), in(1, 300), role, stroke, 0, true);
    case 2:
      return line(x, y, in(-100, 1700), in(-100, 1000), {role, in(0.5, 20)});
    case 3:
      return text("Quadtree", x, y, in(10, 90), role, 0.5, Weight::semibold, stroke.role);
    default:
      break;
  }
  PolygonShape polygon{{}, role, stroke};
  for (int i = 0; i < 5; ++i) {
    const double angle = 2 * std::numbers::pi * i / 5;
    polygon.points.push_back(Vec<2>(x, y) + in(5, 200) * Vec<2>(std::cos(angle), std::sin(angle)));
  }
  return polygon;
}

// One after another, each much as the one before: shapes change, come, go and change their order.
std::vector<DrawList> sequence(std::uint64_t seed) {
  Random random(seed);
  DrawList list;
  for (int i = 0; i < 30; ++i) list.shapes.push_back(random_shape(random));
  std::vector<DrawList> lists;
  const auto any = [&] {
    return static_cast<std::size_t>(random.whole(0, std::int64_t(list.shapes.size()) - 1));
  };
  for (int step = 0; step < 16; ++step) {
    lists.push_back(list);
    const auto what = random.whole(0, 4);
    if (what == 0) list.shapes.push_back(random_shape(random));
    if (what == 1) list.shapes.erase(list.shapes.begin() + static_cast<std::ptrdiff_t>(any()));
    if (what == 2) std::swap(list.shapes[any()], list.shapes[any()]);
    if (what == 3) list.shapes[any()] = random_shape(random);
  }
  return lists;
}

TEST(Damage, DrawnOverEachOtherIsAsDrawnAlone) {
  Renderer renderer(Context::create(Backend::automatic), kWidth, kHeight);
  std::int64_t pixels = 0, most = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const std::vector<DrawList> lists = sequence(seed);
    const bool transparent = seed % 2 == 0;
    std::vector<Image> over;
    for (const DrawList& list : lists) {
      const Drawn drawn = renderer.draw(list, *theme_named("light"), transparent);
      pixels += drawn.pixels;
      most += std::int64_t{kWidth} * kHeight;
      over.push_back(drawn.image);
    }
    Image alone;
    for (std::size_t i = 0; i < lists.size(); ++i) {
      // Another theme between two pictures: nothing of the one can stand for the other.
      renderer.draw(lists[0], *theme_named("dark"), transparent, alone);
      renderer.draw(lists[i], *theme_named("light"), transparent, alone);
      ASSERT_EQ(over[i], alone) << "picture " << i << " of sequence " << seed;
    }
  }
  EXPECT_LT(pixels, most / 2) << "all was drawn anew";
}

TEST(Damage, TellsWhichRowsAndPartsChanged) {
  Renderer renderer(Context::create(Backend::automatic), kWidth, kHeight);
  Image before;
  int changed = 0;
  std::uint64_t number = 0;
  for (const DrawList& list : sequence(5)) {
    const Drawn drawn = renderer.draw(list, *theme_named("light"), false);
    ASSERT_EQ(drawn.before, std::exchange(number, drawn.number));
    ASSERT_GT(drawn.number, drawn.before);
    std::int64_t pixels = 0;
    for (const PixelRect& part : drawn.parts) pixels += part.area();
    ASSERT_EQ(drawn.pixels, pixels);
    for (int y = 0; y < kHeight && !before.rgba.empty(); ++y) {
      const auto row = std::ptrdiff_t{4} * kWidth * y;
      const bool differs =
          !std::equal(before.rgba.begin() + row, before.rgba.begin() + row + 4 * kWidth,
                      drawn.image.rgba.begin() + row);
      ASSERT_EQ(drawn.changed[static_cast<std::size_t>(y)], differs) << y;
      changed += differs;
    }
    if (before.rgba.empty()) before = drawn.image;
    for (const PixelRect& part : drawn.parts)
      for (int y = part.y0; y < part.y1; ++y) {
        const auto first = std::ptrdiff_t{4} * (kWidth * y + part.x0);
        std::copy_n(drawn.image.rgba.begin() + first, 4 * (part.x1 - part.x0),
                    before.rgba.begin() + first);
      }
    ASSERT_EQ(before, drawn.image) << "outside of the parts";
  }
  EXPECT_GT(changed, 0);
}

Quad quad(PixelRect rect, std::uint8_t red) {
  Quad q;
  q.instance.fill = {red, 0, 0, 255};
  q.bounds = rect;
  return q;
}

TEST(Damage, FindsWhatDiffersAndNothingElse) {
  Damage damage(640, 320);
  const PixelRect all{0, 0, 640, 320};
  std::vector<Quad> quads{quad({0, 0, 10, 10}, 1), quad({100, 100, 110, 110}, 2)};
  EXPECT_EQ(damage.find(quads, 7), std::vector{all}) << "the first picture";
  EXPECT_TRUE(damage.is_all());
  EXPECT_TRUE(damage.find(quads, 7).empty());
  quads[1].instance.fill[0] = 3;
  EXPECT_EQ(damage.find(quads, 7), (std::vector<PixelRect>{{96, 96, 128, 112}})) << "its tile";
  EXPECT_EQ(damage.find(quads, 8), std::vector{all}) << "another ground";
  damage.forget();
  EXPECT_EQ(damage.find(quads, 8), std::vector{all});
  quads.push_back(quad({5, 5, 15, 15}, 4));
  EXPECT_EQ(damage.find(quads, 8), (std::vector<PixelRect>{{0, 0, 32, 16}}));
  std::swap(quads[0], quads[2]);
  EXPECT_EQ(damage.find(quads, 8).size(), 1u) << "what lies upon what";
  std::swap(quads[1], quads[2]);
  EXPECT_TRUE(damage.find(quads, 8).empty()) << "their order is not seen: they lie apart";
}

}  // namespace
}  // namespace lantern::render
