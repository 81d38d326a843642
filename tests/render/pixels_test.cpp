// Facts about single pixels, at sizes where they can be told by hand.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "render/renderer.hpp"
#include "render/sample_scene.hpp"
#include "render/support.hpp"

namespace lantern::render {
namespace {

constexpr Stroke kInk2{Role::ink, 2, 0};
const Rgba kWhite{255, 255, 255, 255}, kBlack{0, 0, 0, 255};

TEST(Pixels, PaperIsExactlyThePapersColour) {
  const Theme theme = *theme_named("light");
  const Color& c = theme[Role::paper];
  const Image image = drawn(page_of(40, 30, {}), 40, 30, false, theme);
  EXPECT_EQ(at(image, 0, 0), (Rgba{c.r, c.g, c.b, 255}));
  EXPECT_EQ(at(image, 39, 29), (Rgba{c.r, c.g, c.b, 255}));
}

TEST(Pixels, RowsComeFromTheTop) {
  const Image image = drawn(page_of(40, 30, {rect(0, 0, 40, 5, Role::ink)}), 40, 30);
  EXPECT_EQ(at(image, 20, 0), kBlack);
  EXPECT_EQ(at(image, 20, 29), kWhite);
}

TEST(Pixels, InsideOfARectIsExactlyTheThemesColour) {
  for (const Theme& theme : themes())
    for (int r = 1; r < static_cast<int>(Role::count_); ++r) {
      const Role role = static_cast<Role>(r);
      const Color& c = theme[role];
      const Rgba wanted{c.r, c.g, c.b, 255};
      // The large one is drawn by the program for insides, the small one by the general one.
      const Image image = drawn(
          page_of(200, 150,
                  {rect(2, 2, 120, 120, role, {}, 8), rect(130.2, 10.4, 30, 30, role, {}, 4)}),
          200, 150, false, theme);
      ASSERT_EQ(at(image, 60, 60), wanted) << theme.name << ", role " << r;
      ASSERT_EQ(at(image, 145, 25), wanted) << theme.name << ", role " << r;
    }
}

TEST(Pixels, SnappedLineIsCrisp) {
  const Image image = drawn(page_of(40, 30, {line(5, 10.3, 35, 10.3, kInk2, true)}), 40, 30);
  for (int y = 0; y < 30; ++y)
    EXPECT_EQ(at(image, 20, y), y == 9 || y == 10 ? kBlack : kWhite) << "row " << y;
}

TEST(Pixels, SnappedEdgesAreCrispAndNeverVanishAtAnySize) {
  const DrawList list =
      page_of(160, 90,
              {rect(13.37, 11.1, 101.3, 50.9, Role::warning, {Role::ink, 0.4, 0}, 0, true),
               line(120, 7.77, 120, 80.1, {Role::ink, 0.3, 0}, true),
               rect(130, 20.3, 0.2, 40, Role::ink, {}, 0, true)});
  for (const auto& [width, height] : {std::pair{160, 90}, {333, 187}, {97, 55}, {640, 480}}) {
    const Image image = drawn(list, width, height);
    int black = 0;
    const int row = height / 2;
    for (int x = 0; x < width; ++x) {
      const Rgba p = at(image, x, row);
      EXPECT_TRUE(p == kBlack || p == kWhite || p == (Rgba{255, 0, 0, 255}))
          << p << " at " << x << " of " << width << ": a snapped edge is blurred";
      black += p == kBlack;
    }
    EXPECT_GE(black, 4) << "two borders, a line and a bar, a pixel each at least, at " << width;
  }
}

TEST(Pixels, NeighbouringCellsShareTheirBorder) {
  // Two cells side by side: at every size the common border is as wide as one border.
  const Stroke border{Role::ink, 1, 0};
  const DrawList list = page_of(160, 90,
                                {rect(10.3, 10, 50.4, 60, Role::none, border, 0, true),
                                 rect(60.7, 10, 50.4, 60, Role::none, border, 0, true)});
  for (const int width : {160, 211, 320, 401, 523}) {
    const Image image = drawn(list, width, width * 9 / 16);
    int black = 0;
    for (int x = 0; x < width; ++x) black += at(image, x, width / 4) == kBlack;
    const int one = std::max(1, static_cast<int>(std::floor(width / 160.0 + 0.5)));
    EXPECT_EQ(black, 3 * one) << "at width " << width;
  }
}

TEST(Pixels, HalfCoveredPixelIsHalfInk) {
  const Image image = drawn(page_of(40, 30, {rect(10.5, 5.25, 10, 10, Role::ink)}), 40, 30);
  EXPECT_NEAR(ink(image, 10, 10), 128, 1);
  EXPECT_NEAR(ink(image, 20, 10), 128, 1);
  EXPECT_NEAR(ink(image, 15, 5), 191, 1);
  EXPECT_NEAR(ink(image, 15, 15), 64, 1);
  EXPECT_NEAR(ink(image, 10, 5), 96, 1) << "at a corner the parts multiply";
}

TEST(Pixels, WhatIsThinnerThanAPixelIsLighterByThatMuch) {
  const Image image = drawn(
      page_of(60, 30,
              {rect(10.3, 5, 0.25, 20, Role::ink), line(20.5, 5, 20.5, 25, {Role::ink, 0.4, 0}),
               rect(30.5, 5, 20, 20, Role::none, {Role::ink, 0.5, 0})}),
      60, 30);
  EXPECT_NEAR(ink(image, 10, 15), 64, 1) << "a bar";
  EXPECT_NEAR(ink(image, 20, 15), 102, 1) << "a line";
  EXPECT_NEAR(ink(image, 30, 15), 128, 1) << "a border";
}

TEST(Pixels, PageIsCentredWhenTheAspectDiffers) {
  const DrawList list = page_of(100, 50, {rect(0, 0, 100, 50, Role::ink)});
  const Image image = drawn(list, 100, 100);
  EXPECT_EQ(at(image, 50, 24), kWhite);
  EXPECT_EQ(at(image, 50, 25), kBlack);
  EXPECT_EQ(at(image, 50, 74), kBlack);
  EXPECT_EQ(at(image, 50, 75), kWhite);
}

TEST(Pixels, LaterShapesCoverEarlierOnes) {
  // Far more kinds and overlaps than batches: a wrong order would show through somewhere.
  std::vector<DrawShape> shapes;
  for (int i = 0; i < 30; ++i) {
    shapes.push_back(rect(5, 5, 150, 100, Role::warning));
    shapes.push_back(text("Lantern", 20, 60, 30));
    shapes.push_back(ghost_body(100, 50, 30, Role::ink));
    shapes.push_back(line(10, 10, 150, 100, kInk2));
  }
  shapes.push_back(rect(5, 5, 150, 100, Role::warning));
  const Image image = drawn(page_of(160, 120, shapes), 160, 120);
  for (int y = 6; y < 104; ++y)
    for (int x = 6; x < 154; ++x) ASSERT_EQ(at(image, x, y), (Rgba{255, 0, 0, 255}));
}

TEST(Transparency, NothingIsTransparentBlackAndEdgesKeepTheirColour) {
  const DrawList list = page_of(40, 30, {rect(10.5, 5, 10, 10, Role::warning)});
  const Image image = drawn(list, 40, 30, true);
  EXPECT_EQ(at(image, 0, 0), (Rgba{0, 0, 0, 0}));
  EXPECT_EQ(at(image, 15, 10), (Rgba{255, 0, 0, 255}));
  const Rgba edge = at(image, 10, 10);
  EXPECT_NEAR(edge.a, 128, 1);
  EXPECT_EQ(edge.r, 255) << "premultiplied colour would be dark on every other ground";
  EXPECT_EQ(edge.g, 0);
}

TEST(Transparency, OnPaperItIsTheOpaquePicture) {
  const Theme theme = *theme_named("light");
  const Color& paper = theme[Role::paper];
  const Image opaque = drawn(sample_scene(), 800, 450, false, theme);
  const Image clear = drawn(sample_scene(), 800, 450, true, theme);
  int worst = 0;
  for (std::size_t i = 0; i < clear.rgba.size(); i += 4) {
    const int alpha = clear.rgba[i + 3];
    const int ground[] = {paper.r, paper.g, paper.b};
    for (std::size_t c = 0; c < 3; ++c) {
      const int shown = (clear.rgba[i + c] * alpha + ground[c] * (255 - alpha) + 127) / 255;
      worst = std::max(worst, std::abs(shown - opaque.rgba[i + c]));
    }
  }
  EXPECT_LE(worst, 3) << "rounding explains this much and no more";
}

TEST(Text, HaloClearsTheGroundAroundTheLetters) {
  const DrawList bare =
      page_of(120, 60, {rect(0, 0, 120, 60, Role::ink), text("lil", 20, 40, 30, Role::warning)});
  DrawList haloed = bare;
  std::get<TextShape>(haloed.shapes[1]).halo = Role::paper;
  const Image without = drawn(bare, 120, 60), with = drawn(haloed, 120, 60);
  const auto red = [](const Rgba& p) { return p.r > 100; };
  for (int y = 3; y < 57; ++y)
    for (int x = 3; x < 117; ++x) {
      if (!red(at(without, x, y))) continue;
      EXPECT_TRUE(red(at(with, x, y))) << "the letters stay on top of the halo";
      for (const auto& [dx, dy] : {std::pair{2, 0}, {-2, 0}, {0, 2}, {0, -2}})
        EXPECT_NE(at(with, x + dx, y + dy), kBlack)
            << "ground within the halo at " << x << ' ' << y;
    }
  EXPECT_EQ(at(with, 2, 2), kBlack) << "a halo ends";
}

TEST(Text, StaysTheSameWhenMovedByWholePixels) {
  const DrawList a = page_of(200, 60, {text("Wave AV", 20.3, 40.2, 25)});
  const DrawList b = page_of(200, 60, {text("Wave AV", 70.3, 40.2, 25)});
  const Image first = drawn(a, 200, 60), second = drawn(b, 200, 60);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 150; ++x) ASSERT_EQ(ink(first, x, y), ink(second, x + 50, y));
}

TEST(Renderer, RefusesBadSizesAndNumbers) {
  EXPECT_THROW(Renderer(Context::create(Backend::automatic), 0, 10), Refused);
  EXPECT_THROW(Renderer(Context::create(Backend::automatic), 10, kMostSide + 1), Refused);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(drawn(page_of(40, 30, {rect(nan, 0, 1, 1, Role::ink)}), 40, 30), Refused);
  EXPECT_THROW(drawn(page_of(40, 30, {line(0, 0, 1e300, 1, kInk2)}), 40, 30), Refused);
  EXPECT_THROW(drawn(page_of(40, 30, {text("a", 0, 0, nan)}), 40, 30), Refused);
  EXPECT_THROW(drawn(page_of(0, 30, {}), 40, 30), Refused);
}

TEST(Renderer, TakesDegenerateShapes) {
  PolygonShape two_points;
  two_points.points = {{5, 5}, {20, 20}};
  two_points.fill = Role::ink;
  two_points.stroke = kInk2;
  PolygonShape none;
  none.fill = Role::ink;
  const Image image = drawn(
      page_of(40, 30,
              {two_points, none, rect(10, 10, 0, 0, Role::ink, kInk2), rect(9, 9, -5, 3, Role::ink),
               line(30, 20, 30, 20, {Role::ink, 4, 0}), text("", 5, 5, 10), text(" ", 5, 5, 10),
               line(-1e5, 15, 1e5, 15.5, {Role::ink, 2, 0.5}), text("\xff\xfe", 1, 1, 10)}),
      40, 30);
  EXPECT_GT(ink(image, 30, 20), 200) << "a line without length is a dot";
  EXPECT_GT(ink(image, 12, 12), 200) << "the outline of two points is a line";
}

TEST(Renderer, DrawsTheLargestImage) {
  constexpr int kMost = kMostSide;
  const Image image = drawn(page_of(kMost, kMost,
                                    {rect(kMost - 3, kMost - 2, 2, 1, Role::ink),
                                     text("far", kMost - 300, kMost - 100, 100)}),
                            kMost, kMost);
  EXPECT_EQ(at(image, kMost - 2, kMost - 2), kBlack);
  EXPECT_EQ(at(image, kMost - 1, kMost - 1), kWhite);
  drawn(page_of(1, 1, {}), 1, 1);  // lets go of the large framebuffer
}

}  // namespace
}  // namespace lantern::render
