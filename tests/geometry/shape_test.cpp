// Boxes around turned shapes, and closest points.
#include "geometry/shape.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "geometry/closest.hpp"
#include "geometry/random_vec.hpp"

namespace lantern::geometry {
namespace {

template <int D>
Rotation<D> random_rotation(Random& random) {
  if constexpr (D == 2)
    return {random.between(-4, 4)};
  else
    return turned(Rotation<3>{}, random_point<3>(random, -2, 2));
}

// Every corner lies within the box, and each of the box's faces is touched by one: no box is
// smaller.
template <int D>
void expect_tight_box() {
  Random random(D);
  for (int round = 0; round < 2000; ++round) {
    const Vec<D> half = random_point<D>(random, 0, 3), position = random_point<D>(random, -5, 5);
    const Rotation<D> turn = random_rotation<D>(random);
    const Box<D> box = bounding_box<D>(OrientedBox<D>{half}, position, turn);
    Vec<D> most(0.0);  // of |R| * half
    Box<D> corners{position, position};
    for (unsigned signs = 0; signs < (1u << D); ++signs) {
      Vec<D> corner = half;
      for (int i = 0; i < D; ++i)
        if ((signs >> i & 1u) == 0) corner[i] = -corner[i];
      corner = position + matrix(turn) * corner;
      corners = united(corners, Box<D>{corner, corner});
    }
    for (int i = 0; i < D; ++i) {
      for (int k = 0; k < D; ++k) most[i] += std::abs(matrix(turn)[k][i]) * half[k];
      ASSERT_NEAR(box.hi[i] - position[i], most[i], 1e-14) << "half sizes are not |R| * half";
      ASSERT_NEAR(box.lo[i], corners.lo[i], 1e-14) << "no corner touches the lower face " << i;
      ASSERT_NEAR(box.hi[i], corners.hi[i], 1e-14) << "no corner touches the upper face " << i;
    }
  }
}

TEST(Shape, ATurnedBoxHasTheSmallestBoxAroundItsCorners) {
  expect_tight_box<2>();
  expect_tight_box<3>();
}

TEST(Shape, AnAxisBoxDoesNotTurn) {
  EXPECT_EQ((bounding_box<2>(AxisBox<2>{{1, 2}}, {3, 4}, Rotation<2>{0.7})),
            (bounding_box<2>(AxisBox<2>{{1, 2}}, {3, 4})));
}

TEST(Shape, ThicknessIsHalfOfTheSmallestWidth) {
  for (const double least : {0.0, 1.0, 2.0}) {
    EXPECT_EQ(thickness<2>(OrientedBox<2>{{least, 3}}), least);
    EXPECT_EQ(thickness<2>(AxisBox<2>{{3, least}}), least);
    for (int i = 0; i < 3; ++i) {
      Vec<3> half(3, 4, 5);
      half[i] = least;
      EXPECT_EQ(thickness<3>(OrientedBox<3>{half}), least);
      EXPECT_EQ(thickness<3>(AxisBox<3>{half}), least);
    }
  }
  EXPECT_EQ(thickness<2>(Sphere{7}), 7);
  EXPECT_EQ(thickness<3>(Sphere{7}), 7);
  EXPECT_EQ(thickness<2>(Capsule{2, 1}), 2);
  EXPECT_EQ(thickness<3>(Capsule{2, 5}), 2);
  EXPECT_GE(thickness<2>(HalfSpace<2>{{0, 1}}), kEndless);
}

// By corners: 3, 4, 5 and 2, 3, 6, 7.
TEST(Shape, TurningReachesAsFarAsItsFarthestCorner) {
  EXPECT_EQ(turning_reach<2>(OrientedBox<2>{{3, 4}}), 5);
  EXPECT_EQ(turning_reach<3>(OrientedBox<3>{{6, 2, 3}}), 7);
  EXPECT_EQ(turning_reach<2>(Capsule{2, 5}), 5) << "its ball turns within itself";
  EXPECT_EQ(turning_reach<3>(Capsule{2, 1e-200}), 1e-200) << "whose square is no number";
  EXPECT_EQ(turning_reach<2>(AxisBox<2>{{3, 4}}), 0) << "it does not turn";
  EXPECT_EQ(turning_reach<3>(Sphere{7}), 0);
  EXPECT_EQ(turning_reach<3>(HalfSpace<3>{{0, 1, 0}}), 0);
}

// The farthest point of a capsule along an axis is that of one of its end balls.
template <int D>
void expect_box_of_end_balls() {
  Random random(10 + D);
  for (int round = 0; round < 2000; ++round) {
    const Capsule capsule{random.between(0, 2), random.between(0, 3)};
    const Rotation<D> turn = random_rotation<D>(random);
    const Vec<D> position = random_point<D>(random, -5, 5);
    const Vec<D> end = matrix(turn)[1] * capsule.half_length;
    const Box<D> expected = united(Box<D>::around(position + end, Vec<D>(capsule.radius)),
                                   Box<D>::around(position - end, Vec<D>(capsule.radius)));
    const Box<D> found = bounding_box<D>(capsule, position, turn);
    for (int i = 0; i < D; ++i) {
      ASSERT_NEAR(found.lo[i], expected.lo[i], 1e-14);
      ASSERT_NEAR(found.hi[i], expected.hi[i], 1e-14);
    }
  }
}

TEST(Shape, ACapsuleHasTheBoxOfItsEnds) {
  expect_box_of_end_balls<2>();
  expect_box_of_end_balls<3>();
}

TEST(Shape, AHalfSpaceEndsOnlyAlongAnAxis) {
  const Box<2> floor = bounding_box<2>(HalfSpace<2>{{0, 1}}, {3, 4});
  EXPECT_EQ(floor.hi.y, 4);
  EXPECT_EQ(floor.lo.y, -kEndless);
  EXPECT_EQ(floor.hi.x, kEndless);
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) {
      Vec<3> normal(0.0);
      normal[axis] = sign;
      Box<3> expected = Box<3>::around(Vec<3>(0.0), Vec<3>(kEndless));
      (sign > 0 ? expected.hi : expected.lo)[axis] = 5.0 + axis;
      EXPECT_EQ(bounding_box<3>(HalfSpace<3>{normal}, {5, 6, 7}), expected) << axis << sign;
    }
  EXPECT_EQ(bounding_box<2>(HalfSpace<2>{{0.6, 0.8}}, {3, 4}),
            Box<2>::around(Vec<2>(0.0), Vec<2>(kEndless)));
}

TEST(Direction, HasUnitLengthAtEveryScale) {
  const Vec<3> up(0, 1, 0);
  for (const double scale : {5e-324, 1e-300, 1e-160, 1e-20, 1.0, 1e20, 1e160, 1e307}) {
    const Direction<3> found = direction_of(Vec<3>(0, -scale, 0), up);
    EXPECT_EQ(found.unit, -up) << scale;
    EXPECT_EQ(found.length, scale);
  }
  for (int axis = 0; axis < 3; ++axis) {
    Vec<3> v(0.0);
    v[axis] = 1e-300;
    EXPECT_EQ(direction_of(v, -up).unit[axis], 1);
  }
  EXPECT_EQ(direction_of(Vec<3>(0.0), up).unit, up);
  EXPECT_EQ(direction_of(Vec<3>(0.0), up).length, 0);
  for (const double scale : {1e-300, 1e-200, 1.0, 1e200})
    for (int axis = 0; axis < 3; ++axis) {
      Vec<3> v(0.0);
      v[axis] = 4 * scale;
      v[(axis + 1) % 3] = -3 * scale;
      const Direction<3> found = direction_of(v, up);
      EXPECT_DOUBLE_EQ(found.length, 5 * scale);
      EXPECT_DOUBLE_EQ(found.unit[axis], 0.8) << scale;
      EXPECT_DOUBLE_EQ(found.unit[(axis + 1) % 3], -0.6) << scale;
    }
}

// No pair of points of the segments is closer, on a fine grid around the ones found and all along.
template <int D>
void expect_closest(const Segment<D>& a, const Segment<D>& b) {
  const PointPair<D> found = closest_points(a, b);
  const double distance = glm::length(found.b - found.a);
  const double size = glm::length(a.b - a.a) + glm::length(b.b - b.a) + glm::length(b.a - a.a);
  ASSERT_LE(glm::length(found.a - closest_point(a, found.a)), 1e-14 * size) << "not on the segment";
  ASSERT_LE(glm::length(found.b - closest_point(b, found.b)), 1e-14 * size) << "not on the segment";
  for (int i = 0; i <= 200; ++i) {
    const Vec<D> p = a.at(i / 200.0), q = b.at(i / 200.0);
    ASSERT_LE(distance, glm::length(closest_point(b, p) - p) + 1e-13 * size);
    ASSERT_LE(distance, glm::length(closest_point(a, q) - q) + 1e-13 * size);
  }
}

template <int D>
void expect_closest_of_random_segments() {
  Random random(20 + D);
  for (int round = 0; round < 2000; ++round) {
    Segment<D> a{random_point<D>(random, -3, 3), random_point<D>(random, -3, 3)};
    Segment<D> b{random_point<D>(random, -3, 3), random_point<D>(random, -3, 3)};
    const double tilt = std::ldexp(1, -static_cast<int>(random.whole(10, 60)));
    if (round % 4 == 1) b.b = b.a;  // a point
    if (round % 4 == 2) b.b = b.a + (a.b - a.a) * 0.7 + random_point<D>(random, -tilt, tilt);
    if (round % 8 == 3) a.b = a.a;
    expect_closest<D>(a, b);
  }
}

TEST(Segment, ClosestPointsAreCloserThanAllOthers) {
  expect_closest_of_random_segments<2>();
  expect_closest_of_random_segments<3>();
}

TEST(Segment, ParallelOnesMeetSomewhereOnBoth) {
  const Segment<2> a{{0, 0}, {4, 0}}, b{{1, 1}, {3, 1}};
  const PointPair<2> found = crossing_points(a, b);
  EXPECT_EQ(found.a.y, 0);
  EXPECT_EQ(found.b.y, 1);
  EXPECT_EQ(found.a.x, found.b.x);
  EXPECT_EQ(found.square(), 1);
}

}  // namespace
}  // namespace lantern::geometry
