// Rotations, and what little segments, planes, boxes and random directions compute by themselves.
#include "geometry/rotation.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "geometry/flat.hpp"
#include "geometry/not_finite.hpp"
#include "geometry/plane.hpp"
#include "geometry/random_vec.hpp"

namespace lantern::geometry {
namespace {

TEST(Rotation, IsCounterClockwiseInThePlane) {
  const double angle = 0.3, c = std::cos(angle), s = std::sin(angle);
  EXPECT_EQ(matrix(Rotation<2>{}), Mat<2>(1.0));
  EXPECT_EQ(matrix(Rotation<2>{angle}) * Vec<2>(1, 0), Vec<2>(c, s));
  EXPECT_EQ(matrix(Rotation<2>{angle}) * Vec<2>(0, 1), Vec<2>(-s, c));
  EXPECT_EQ(turned(Rotation<2>{7}, -0.5).angle, 6.5) << "it may pass a full turn";
}

// Rodrigues' formula, 1840: v cos a + (n x v) sin a + n (n . v)(1 - cos a).
Vec<3> rodrigues(const Vec<3>& v, const Vec<3>& by) {
  const double a = glm::length(by);
  if (a == 0) return v;
  const Vec<3> n = by / a;
  return v * std::cos(a) + glm::cross(n, v) * std::sin(a) +
         n * (glm::dot(n, v) * (1 - std::cos(a)));
}

TEST(Rotation, TurnsAsRodriguesSays) {
  EXPECT_EQ(matrix(Rotation<3>{}), Mat<3>(1.0));
  Random random(1);
  for (const double size : {0.0, 1e-12, 1e-8, 1e-3, 1.0, 3.0}) {
    for (int round = 0; round < 50; ++round) {
      const Vec<3> first = random_point<3>(random, -3, 3);
      const Vec<3> second = random_direction<3>(random) * size;
      const Vec<3> v = random_point<3>(random, -1, 1);
      const Rotation<3> once = turned(Rotation<3>{}, first);
      const Rotation<3> twice = turned(once, second);
      EXPECT_NEAR(glm::distance(matrix(once) * v, rodrigues(v, first)), 0, 1e-14);
      EXPECT_NEAR(glm::distance(matrix(twice) * v, rodrigues(rodrigues(v, first), second)), 0,
                  1e-14);
      // Of a small turn nearly nothing is left of v's change but its first order.
      const Vec<3> change = matrix(turned(Rotation<3>{}, second)) * v - v;
      if (size > 0 && size < 1e-6) {
        EXPECT_NEAR(glm::distance(change, glm::cross(second, v)) / size, 0, 2e-16 / size + size);
      }
    }
  }
  const Rotation<3> quarter = turned(Rotation<3>{}, {0, 0, 1e-10});
  EXPECT_NEAR(quarter.q.z, 5e-11, 1e-25) << "half the angle, however small";
}

TEST(Rotation, CrossProductsAgreeBetweenTwoAndThreeDimensions) {
  Random random(2);
  for (int round = 0; round < 100; ++round) {
    const Vec<2> a = random_point<2>(random, -3, 3), b = random_point<2>(random, -3, 3);
    const double spin = random.between(-2, 2);
    EXPECT_EQ(cross(a, b), cross(solid(a), solid(b)).z);
    EXPECT_EQ(dot(spin, a.x), dot(Vec<3>(0, 0, spin), Vec<3>(a, a.x))) << "of spins";
    EXPECT_EQ(cross(spin, a), flat(cross(Vec<3>(0, 0, spin), solid(a))));
  }
}

TEST(Segment, HasALengthAndALine) {
  const Segment<2> s{{1, 2}, {4, 6}};
  EXPECT_EQ(length(s), 5);
  EXPECT_EQ(s.middle(), Vec<2>(2.5, 4));
  const Plane<2> line = line_of(s);
  EXPECT_NEAR(glm::length(line.normal), 1, 1e-15);
  EXPECT_NEAR(height(s.a, line), 0, 1e-15);
  EXPECT_NEAR(height(s.b, line), 0, 1e-15);
  EXPECT_NEAR(height(Vec<2>(0, 10), line), 5.6, 1e-14) << "in front is to the left";
}

TEST(Plane, ScalingMovesNoPoint) {
  Random random(3);
  for (const double scale : {1e-300, 1e-5, 0.5, 1.0, 3.0, 1e200}) {
    const Vec<3> normal = random_point<3>(random, -1, 1);
    const Plane<3> plane{normal * scale, random.between(-5, 5) * scale};
    const Plane<3> found = scaled(plane);
    double largest = 0;
    for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(found.normal[i]));
    EXPECT_GE(largest, 0.5);
    EXPECT_LT(largest, 1);
    EXPECT_EQ(found.normal * plane.offset, plane.normal * found.offset) << "by a power of two";
    EXPECT_EQ(plane.offset > 0, found.offset > 0);
  }
  EXPECT_EQ(scaled(Plane<2>{{0.5, -2}, 6}).normal, Vec<2>(0.125, -0.5));
  EXPECT_EQ(scaled(Plane<2>{{0.5, -2}, 6}).offset, 1.5);
}

TEST(Box, HasACentreAndASize) {
  const Box<2> box{{1, 2}, {4, 8}};
  EXPECT_EQ(box.center(), Vec<2>(2.5, 5));
  EXPECT_EQ(box.size(), Vec<2>(3, 6));
  EXPECT_EQ(Box<2>::around(box.center(), box.size() / 2.0), box);
}

TEST(Shape, WhatIsNotGivenIsZero) {
  EXPECT_EQ(Box<2>{}, (Box<2>{{0, 0}, {0, 0}}));
  EXPECT_EQ(Plane<3>{}.normal, Vec<3>(0, 0, 0));
  EXPECT_EQ(Plane<3>{}.offset, 0);
  EXPECT_EQ(Sphere{}.radius, 0);
  EXPECT_EQ(Capsule{}.radius, 0);
  EXPECT_EQ(Capsule{}.half_length, 0);
}

TEST(Flat, LiesInThePlaneZIsZero) {
  EXPECT_EQ(solid(Vec<2>(3, 4)), Vec<3>(3, 4, 0));
  EXPECT_EQ(solid(Box<2>{{1, 2}, {3, 4}}), (Box<3>{{1, 2, 0}, {3, 4, 0}}));
  EXPECT_EQ(solid(Plane<2>{{1, 2}, 5}).normal, Vec<3>(1, 2, 0));
  EXPECT_EQ(flat(Box<3>{{1, 2, 3}, {4, 5, 6}}), (Box<2>{{1, 2}, {4, 5}}));
  EXPECT_EQ(flat(Plane<3>{{1, 2, 3}, 5}).offset, 5);
}

TEST(NotFinite, IsFoundInAnyCoordinate) {
  EXPECT_TRUE(is_finite(1e308));
  EXPECT_FALSE(is_finite(kNan));
  EXPECT_FALSE(is_finite(-kInfinity));
  EXPECT_TRUE(is_finite(Vec<3>(1, 2, 3)));
  for (int i = 0; i < 3; ++i)
    for (const double value : {kNan, kInfinity}) {
      Vec<3> v(0.0);
      v[i] = value;
      EXPECT_FALSE(is_finite(v)) << "coordinate " << i;
    }
}

// As many point along the axes as along the diagonals: those of a cube would prefer its corners.
template <int D>
void expect_even_directions(double share_near_axis) {
  Random random(4);
  constexpr int kDraws = 20'000;
  Vec<D> sum(0.0);
  double near_axis = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Vec<D> v = random_direction<D>(random);
    ASSERT_NEAR(glm::length(v), 1, 1e-15);
    sum += v;
    for (int k = 0; k < D; ++k) near_axis += std::abs(v[k]) > std::cos(std::numbers::pi / 8);
  }
  EXPECT_LT(glm::length(sum) / kDraws, 0.02);
  EXPECT_NEAR(near_axis / kDraws, share_near_axis, 0.015);
}

TEST(RandomDirection, PrefersNone) {
  expect_even_directions<2>(0.5);
  expect_even_directions<3>(3 * (1 - std::cos(std::numbers::pi / 8)));  // six caps of the sphere
}

}  // namespace
}  // namespace lantern::geometry
