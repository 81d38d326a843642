#include <cmath>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "geometry/not_finite.hpp"
#include "geometry/plane.hpp"
#include "geometry/shape.hpp"

namespace lantern::geometry {
namespace {

template <int D>
Box<D> random_box(Random& random) {
  Box<D> box;
  for (int i = 0; i < D; ++i) {
    box.lo[i] = static_cast<double>(random.whole(-4, 4));
    box.hi[i] = box.lo[i] + static_cast<double>(random.whole(0, 3));
  }
  return box;
}

TEST(Box, TouchingIsOverlapping) {
  const Box<2> box{{0, 0}, {2, 2}};
  EXPECT_TRUE(overlap(box, Box<2>{{2, 0}, {3, 2}})) << "a common edge";
  EXPECT_TRUE(overlap(box, Box<2>{{2, 2}, {3, 3}})) << "a common corner";
  EXPECT_TRUE(overlap(box, Box<2>{{1, 1}, {1, 1}})) << "a point inside";
  EXPECT_TRUE(overlap(box, Box<2>{{-1, -1}, {9, 9}})) << "one inside the other";
  EXPECT_FALSE(overlap(box, Box<2>{{std::nextafter(2.0, 3.0), 0}, {3, 2}}));
  EXPECT_FALSE(overlap(box, Box<2>{{0, 3}, {2, 4}})) << "apart on y alone";
}

// Small whole numbers: two boxes overlap exactly when they have a whole point in common.
template <int D>
void expect_overlap_is_a_common_point() {
  Random random(D);
  for (int round = 0; round < 3000; ++round) {
    const Box<D> a = random_box<D>(random), b = random_box<D>(random);
    bool common = false;
    for (int x = -4; x <= 7; ++x)
      for (int y = -4; y <= 7; ++y)
        for (int z = D == 3 ? -4 : 0; z <= (D == 3 ? 7 : 0); ++z) {
          Vec<D> p(0.0);
          p[0] = x, p[1] = y;
          if constexpr (D == 3) p[2] = z;
          common |= contains(a, p) && contains(b, p);
        }
    ASSERT_EQ(overlap(a, b), common);
    ASSERT_EQ(overlap(b, a), common);
    const Box<D> both = united(a, b);
    ASSERT_TRUE(contains(both, a.lo) && contains(both, a.hi) && contains(both, b.lo) &&
                contains(both, b.hi));
  }
}

TEST(Box, OverlapIsACommonPoint) {
  expect_overlap_is_a_common_point<2>();
  expect_overlap_is_a_common_point<3>();
}

TEST(Box, ItsExtentIsTheLargestOnAnyAxis) {
  EXPECT_EQ(extent_of(Box<2>{{1, 2}, {4, 3}}), 3);
  EXPECT_EQ(extent_of(Box<2>{{1, 2}, {2, 9}}), 7);
  EXPECT_EQ(extent_of(Box<3>{{0, 0, -5}, {1, 2, 5}}), 10);
  EXPECT_EQ(extent_of(Box<3>{{0, 4, 0}, {0, 4, 0}}), 0);
}

TEST(NotFinite, ZeroIsNotNegative) {
  EXPECT_NO_THROW(require_not_negative(0.0, "ball", "radius"));
  EXPECT_NO_THROW(require_not_negative(-0.0, "ball", "radius"));
  EXPECT_NO_THROW(require_not_negative(3.0, "ball", "radius"));
  for (const double bad : {-1e-300, kNan, kInfinity})
    EXPECT_THROW(require_not_negative(bad, "ball", "radius"), Refused);
}

TEST(Box, IsValidOnlyWhenFiniteAndInOrder) {
  EXPECT_TRUE(is_valid(Box<2>{{1, 1}, {1, 1}})) << "a box may have no size";
  EXPECT_FALSE(is_valid(Box<2>{{1, 2}, {3, 1}}));
  EXPECT_FALSE(is_valid(Box<2>{{kNan, 0}, {1, 1}}));
  EXPECT_FALSE(is_valid(Box<2>{{0, 0}, {1, kNan}}));
  EXPECT_FALSE(is_valid(Box<3>{{0, 0, -kInfinity}, {1, 1, 1}}));
  EXPECT_FALSE(is_valid(Box<3>{{0, 0, 0}, {1, 1, kInfinity}}));
}

TEST(Shape, ItsBoxEnvelopsIt) {
  EXPECT_EQ(bounding_box<2>(Sphere{1.5}, {1, 2}), (Box<2>{{-0.5, 0.5}, {2.5, 3.5}}));
  EXPECT_EQ(bounding_box<3>(Sphere{2}, {0, 0, 1}), (Box<3>{{-2, -2, -1}, {2, 2, 3}}));
  EXPECT_EQ(bounding_box<2>(AxisBox<2>{{1, 4}}, {1, 2}), (Box<2>{{0, -2}, {2, 6}}));
}

// The least and greatest height of a box over a plane lie at corners: all of them are tried.
template <int D>
void expect_reach_is_what_the_corners_say() {
  Random random(D);
  for (int round = 0; round < 3000; ++round) {
    const Box<D> box = random_box<D>(random);
    Plane<D> plane;
    for (int i = 0; i < D; ++i) plane.normal[i] = static_cast<double>(random.whole(-2, 2));
    plane.offset = static_cast<double>(random.whole(-8, 8));
    Reach expected;
    for (unsigned corner = 0; corner < (1u << D); ++corner) {
      double height = 0;
      for (int i = 0; i < D; ++i)
        height += plane.normal[i] * ((corner >> i & 1u) != 0 ? box.hi[i] : box.lo[i]);
      expected.back |= height <= plane.offset;
      expected.front |= height >= plane.offset;
    }
    const Reach found = reach(box, plane);
    ASSERT_EQ(found.back, expected.back);
    ASSERT_EQ(found.front, expected.front);
  }
}

TEST(Plane, ABoxReachesTheSidesOfItsCorners) {
  expect_reach_is_what_the_corners_say<2>();
  expect_reach_is_what_the_corners_say<3>();
}

TEST(Plane, TouchingItReachesBothSides) {
  const auto net = Plane<2>::through({32, 5}, {1, 0});
  const auto sides = [&](double lo, double hi) {
    const Reach r = reach(Box<2>{{lo, 0}, {hi, 1}}, net);
    return std::pair{r.back, r.front};
  };
  EXPECT_EQ(sides(30, 31), std::pair(true, false));
  EXPECT_EQ(sides(30, 32), std::pair(true, true));
  EXPECT_EQ(sides(32, 34), std::pair(true, true));
  EXPECT_EQ(sides(33, 34), std::pair(false, true));
}

double area(const Polygon& p) {
  double twice = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec<2>& a = p[i];
    const Vec<2>& b = p[(i + 1) % p.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return twice / 2;
}

// Cut by line after line, both halves kept: together they are always the whole.
TEST(Polygon, ClippingKeepsTheArea) {
  Random random(1);
  for (int round = 0; round < 300; ++round) {
    std::vector<Polygon> pieces = {polygon_of({{-3, -2}, {5, 4}})};
    for (int cut = 0; cut < 5; ++cut) {
      const auto line = Plane<2>::through({random.between(-3, 5), random.between(-2, 4)},
                                          {random.between(-1, 1), random.between(-1, 1)});
      std::vector<Polygon> halves;
      for (const Polygon& piece : pieces)
        for (const bool front : {false, true}) {
          halves.push_back(clipped(piece, line, front));
          for (const Vec<2>& corner : halves.back()) {
            const double height = glm::dot(line.normal, corner) - line.offset;
            EXPECT_GE(front ? height : -height, -1e-12) << "a corner lies on the wrong side";
          }
        }
      pieces = halves;
    }
    double sum = 0;
    for (const Polygon& piece : pieces) {
      EXPECT_GE(area(piece), -1e-12) << "a piece turned over";
      sum += area(piece);
    }
    EXPECT_NEAR(sum, 48.0, 1e-11);
  }
}

TEST(Polygon, CutThroughItsCornersEachHalfHasThemOnce) {
  const Polygon square = polygon_of({{0, 0}, {2, 2}});
  const Plane<2> diagonal{{-1, 1}, 0};
  EXPECT_EQ(clipped(square, diagonal, true), (Polygon{{0, 0}, {2, 2}, {0, 2}}));
  EXPECT_EQ(clipped(square, diagonal, false), (Polygon{{0, 0}, {2, 0}, {2, 2}}));
  const Plane<2> slanted{{-2, 1}, 0};  // through a corner and the middle of a side
  EXPECT_EQ(clipped(square, slanted, true), (Polygon{{0, 0}, {1, 2}, {0, 2}}));
  EXPECT_EQ(clipped(square, slanted, false), (Polygon{{0, 0}, {2, 0}, {2, 2}, {1, 2}}));
  const Plane<2> edge{{0, 1}, 0};  // along a side
  EXPECT_EQ(clipped(square, edge, true), square);
  EXPECT_TRUE(clipped(square, edge, false).empty());
}

TEST(Polygon, ClippingOutsideGivesAllOrNothing) {
  const Polygon square = polygon_of({{0, 0}, {1, 1}});
  EXPECT_EQ(area(square), 1.0) << "corners are not counter-clockwise";
  const auto line = Plane<2>::through({5, 0}, {1, 0});
  EXPECT_EQ(clipped(square, line, false), square);
  EXPECT_TRUE(clipped(square, line, true).empty());
  EXPECT_TRUE(clipped(square, Plane<2>::through({1, 0}, {1, 0}), true).empty())
      << "an edge alone is no region";
  EXPECT_TRUE(clipped({}, line, true).empty());
}

}  // namespace
}  // namespace lantern::geometry
