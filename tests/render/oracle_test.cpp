// Shapes against an oracle that samples each pixel many times.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "render/masks.hpp"
#include "render/sample_scene.hpp"
#include "render/support.hpp"

namespace lantern::render {
namespace {

using Inside = std::function<bool(const Vec<2>&)>;
// The share of a pixel that is inside, 0 ... 255, from n x n samples.
double sampled(const Inside& inside, int x, int y, int n) {
  int hits = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) hits += inside({x + (i + 0.5) / n, y + (j + 0.5) / n});
  return 255.0 * hits / (n * n);
}

// A few samples tell the pixels that no edge touches; the others get many.
double sampled(const Inside& inside, int x, int y) {
  const double rough = sampled(inside, x, y, 12);
  return rough == 0 || rough == 255 ? rough : sampled(inside, x, y, 24);
}

struct Error {
  double worst = 0;
  double mean = 0;  // over the pixels that the edge touches
};

Error error_of(const Image& image, const Inside& inside) {
  Error error;
  int touched = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double expected = sampled(inside, x, y), d = std::abs(expected - ink(image, x, y));
      if (expected == 0 || expected == 255) {
        error.worst = std::max(error.worst, d);
        continue;
      }
      error.worst = std::max(error.worst, d);
      error.mean += d;
      ++touched;
    }
  error.mean /= std::max(1, touched);
  return error;
}

bool crosses(const std::vector<Vec<2>>& corners, const Vec<2>& p) {
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec<2>& a = corners[i];
    const Vec<2>& b = corners[(i + 1) % corners.size()];
    if ((a.y <= p.y) == (b.y <= p.y)) continue;
    if (a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x) inside = !inside;
  }
  return inside;
}

double distance(const Vec<2>& a, const Vec<2>& b, const Vec<2>& p) {
  const Vec<2> way = b - a;
  const double square = glm::dot(way, way);
  const double t = square > 0 ? std::clamp(glm::dot(p - a, way) / square, 0.0, 1.0) : 0;
  return glm::length(p - a - way * t);
}

// Corners at random radii round a centre: simple, rarely convex.
std::vector<Vec<2>> random_star(Random& random, const Vec<2>& center, double least, double most) {
  std::vector<Vec<2>> corners;
  const auto count = random.whole(3, 12);
  for (std::int64_t i = 0; i < count; ++i) {
    const double angle =
        6.283185307 * (static_cast<double>(i) + 0.8 * random.unit()) / static_cast<double>(count);
    corners.push_back(center +
                      Vec<2>(std::cos(angle), std::sin(angle)) * random.between(least, most));
  }
  return corners;
}

TEST(Oracle, FilledPolygons) {
  Random random(1);
  for (int i = 0; i < 25; ++i) {
    // Sizes from less than a tile to several, half of them partly outside the image.
    const double most = random.between(6, 120);
    PolygonShape shape;
    shape.points = random_star(random, {random.between(0, 160), random.between(0, 120)}, 5, most);
    shape.fill = Role::ink;
    const Error error = error_of(drawn(page_of(160, 120, {shape}), 160, 120),
                                 [&](const Vec<2>& p) { return crosses(shape.points, p); });
    EXPECT_LE(error.worst, 14) << "polygon " << i;
    EXPECT_LE(error.mean, 2.5) << "polygon " << i;
  }
}

TEST(Oracle, OutlinedPolygons) {
  Random random(2);
  for (int i = 0; i < 10; ++i) {
    PolygonShape shape;
    shape.points = random_star(random, {80, 60}, 15, 55);
    shape.stroke = {Role::ink, random.between(1, 5), 0};
    const Error error = error_of(drawn(page_of(160, 120, {shape}), 160, 120), [&](const Vec<2>& p) {
      for (std::size_t k = 0; k < shape.points.size(); ++k)
        if (distance(shape.points[k], shape.points[(k + 1) % shape.points.size()], p) <=
            shape.stroke.width / 2)
          return true;
      return false;
    });
    // Where two sides meet at a sharp angle their coverages are not added.
    EXPECT_LE(error.worst, 100) << "polygon " << i;
    EXPECT_LE(error.mean, 8) << "polygon " << i;
  }
}

TEST(Oracle, RoundRectsAndDiscs) {
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    // Some are large enough to be cut into an inside and four strips.
    const Vec<2> size(random.between(8, 150), random.between(8, 110));
    const Vec<2> lo(random.between(-5, 8), random.between(-5, 8));
    const double radius = random.between(1, 0.5 * std::min(size.x, size.y));
    const double line_width = i % 2 == 0 ? 0 : random.between(1, 6);
    RectShape shape = rect(lo.x, lo.y, size.x, size.y, i % 2 == 0 ? Role::ink : Role::none,
                           {Role::ink, line_width, 0}, radius);
    const Vec<2> center = lo + size * 0.5;
    const auto beyond = [&](const Vec<2>& p) {  // signed distance to the outline
      const Vec<2> q = glm::abs(p - center) - size * 0.5 + Vec<2>(radius);
      return glm::length(glm::max(q, Vec<2>(0.0))) + std::min(std::max(q.x, q.y), 0.0) - radius;
    };
    const Error error = error_of(drawn(page_of(160, 120, {shape}), 160, 120), [&](const Vec<2>& p) {
      return line_width > 0 ? std::abs(beyond(p)) <= line_width / 2 : beyond(p) <= 0;
    });
    EXPECT_LE(error.worst, 40) << "rect " << i;
    EXPECT_LE(error.mean, 6) << "rect " << i;
  }
}

TEST(Oracle, Lines) {
  Random random(4);
  for (int i = 0; i < 20; ++i) {
    const Vec<2> a(random.between(-40, 200), random.between(-40, 160));
    const Vec<2> b(random.between(-40, 200), random.between(-40, 160));
    const double width = random.between(1, 9);
    const Image image =
        drawn(page_of(160, 120, {line(a.x, a.y, b.x, b.y, {Role::ink, width, 0})}), 160, 120);
    const Error error =
        error_of(image, [&](const Vec<2>& p) { return distance(a, b, p) <= width / 2; });
    EXPECT_LE(error.worst, 30) << "line " << i;
    EXPECT_LE(error.mean, 8) << "line " << i;
  }
}

TEST(Oracle, FarAwayEndsOfLinesDoNotMoveTheLine) {
  const DrawList list = page_of(160, 120, {line(-9e5, -9e5 + 3, 9e5, 9e5 + 3, {Role::ink, 3, 0})});
  const Error error = error_of(drawn(list, 160, 120), [](const Vec<2>& p) {
    return std::abs(p.y - p.x - 3) / std::sqrt(2.0) <= 1.5;
  });
  EXPECT_LE(error.worst, 30);
}

TEST(Coverage, SumIsThePolygonsArea) {
  Random random(5);
  const PixelRect rect{10, 20, 110, 120};
  for (int i = 0; i < 50; ++i) {
    const auto corners = random_star(random, {60, 70}, 1, 49);
    std::vector<Edge> edges;
    double area = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec<2>& a = corners[k];
      const Vec<2>& b = corners[(k + 1) % corners.size()];
      edges.push_back({a.x, a.y, b.x, b.y});
      area += 0.5 * (a.x * b.y - a.y * b.x);
    }
    std::vector<std::uint8_t> mask(100 * 100);
    fill_coverage(edges, 0, rect, mask.data());
    double sum = 0;
    int partly = 0;
    for (const std::uint8_t c : mask) {
      sum += c / 255.0;
      partly += c != 0 && c != 255;
    }
    // Each pixel is rounded by up to half of 1/255, to either side.
    EXPECT_NEAR(sum, std::abs(area), 0.002 * partly + 1e-6) << "polygon " << i;
  }
}

TEST(Dashes, CoverHalfTheWayAndStartWithADash) {
  const Box<2> everywhere{Vec<2>(-1e4), Vec<2>(1e4)};
  const auto pieces = cut_dashes({{0, 0}, {100, 0}}, false, 10, 2, everywhere);
  ASSERT_EQ(pieces.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_DOUBLE_EQ(pieces[i].from.x, 20.0 * static_cast<double>(i));
    EXPECT_DOUBLE_EQ(pieces[i].to.x, 20.0 * static_cast<double>(i) + 10);
  }
}

TEST(Dashes, GoOnRoundCorners) {
  // A square of side 25 and dashes of 10: the second dash goes round the first corner.
  const Box<2> everywhere{Vec<2>(-1e4), Vec<2>(1e4)};
  const auto pieces = cut_dashes({{0, 0}, {25, 0}, {25, 25}, {0, 25}}, true, 10, 2, everywhere);
  ASSERT_GE(pieces.size(), 3u);
  EXPECT_EQ(pieces[1].to, Vec<2>(26, 0)) << "half the width beyond the corner: no notch";
  EXPECT_EQ(pieces[2].from, Vec<2>(25, -1));
  EXPECT_EQ(pieces[2].to, Vec<2>(25, 5));
}

TEST(Dashes, OnlyWhatIsSeenIsCut) {
  const Box<2> seen{Vec<2>(0.0), Vec<2>(100.0)};
  const auto all = cut_dashes({{-1e6, 50}, {1e6, 50}}, false, 1, 2, seen);
  EXPECT_LE(all.size(), 55u) << "a long line would cost millions of dashes";
  EXPECT_GE(all.size(), 50u);
  EXPECT_TRUE(cut_dashes({{-10, 500}, {200, 500}}, false, 1, 2, seen).empty());
}

TEST(Dilate, IsTheUnionOfDiscs) {
  Random random(6);
  constexpr int kWidth = 23, kHeight = 17, kMargin = 6;
  for (const double radius : {1.0, 2.5, 5.0}) {
    std::vector<std::uint8_t> shape(kWidth * kHeight);
    for (int i = 0; i < 12; ++i) shape[static_cast<std::size_t>(random.whole(0, 390))] = 255;
    const auto wide = dilated(shape, kWidth, kHeight, kMargin, radius);
    for (int y = 0; y < kHeight + 2 * kMargin; ++y)
      for (int x = 0; x < kWidth + 2 * kMargin; ++x) {
        double nearest = 1e9;
        for (int v = 0; v < kHeight; ++v)
          for (int u = 0; u < kWidth; ++u)
            if (shape[static_cast<std::size_t>(v * kWidth + u)] != 0)
              nearest = std::min(nearest, std::hypot(x - kMargin - u, y - kMargin - v));
        const double expected = 255 * std::clamp(radius + 0.5 - nearest, 0.0, 1.0);
        ASSERT_NEAR(wide[static_cast<std::size_t>(y * (kWidth + 2 * kMargin) + x)], expected, 1)
            << x << ' ' << y << " radius " << radius;
      }
  }
}

}  // namespace
}  // namespace lantern::render
