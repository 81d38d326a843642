// Contacts whose answer is known.
#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "physics/collide_oracle.hpp"

namespace lantern::physics {
namespace {

const double kQuarterTurn = 2 * std::atan(1.0);

template <int D>
std::vector<std::uint32_t> features(const Manifold<D>& manifold) {
  std::vector<std::uint32_t> names;
  for (const auto& point : manifold.points()) names.push_back(point.feature);
  return names;
}

Rotation<3> turned_about(const Vec<3>& axis, double angle) {
  return turned(Rotation<3>{}, glm::normalize(axis) * angle);
}

TEST(Collide, SpheresMeetOnTheLineOfTheirCentres) {
  const auto found =
      contact<2>({Sphere{2}, {1, 1}, {}}, {Sphere{4}, {4, 5}, {}}, 0);  // 3-4-5, overlap 1
  ASSERT_TRUE(found);
  EXPECT_EQ(found->normal, Vec<2>(0.6, 0.8));
  EXPECT_EQ(found->count, 1);
  EXPECT_DOUBLE_EQ(found->room[0].separation, -1);
  EXPECT_LE(glm::length(found->room[0].position - Vec<2>(1 + 1.5 * 0.6, 1 + 1.5 * 0.8)), 1e-15);
}

TEST(Collide, TouchingExactlyCountsAtMarginZero) {
  const double beyond = std::nextafter(2.0, 3.0);
  const Shape<3> shapes[] = {Sphere{1}, AxisBox<3>{{1, 1, 1}}, OrientedBox<3>{{1, 1, 1}},
                             Capsule{1, 0.5}, HalfSpace<3>{{1, 0, 0}}};
  for (const Shape<3>& a : shapes)
    for (const Shape<3>& b : shapes) {
      if (std::holds_alternative<HalfSpace<3>>(b)) continue;
      const bool wall = std::holds_alternative<HalfSpace<3>>(a);
      const Thing<3> fixed{a, Vec<3>(0.0), {}};
      SCOPED_TRACE(fmt::format("{} {}", a.index(), b.index()));
      const auto touching = contact<3>(fixed, {b, {wall ? 1.0 : 2.0, 0, 0}, {}}, 0);
      ASSERT_TRUE(touching) << "surfaces that touch are no contact";
      EXPECT_EQ(least_separation(*touching), 0);
      EXPECT_EQ(touching->normal, Vec<3>(1, 0, 0));
      EXPECT_FALSE(contact<3>(fixed, {b, {wall ? std::nextafter(1.0, 2.0) : beyond, 0, 0}, {}}, 0))
          << "one rounding apart is still a contact";
    }
}

template <int D>
void expect_coincident_centres_part() {
  Random random(D);
  for_each_pair_of_kinds([&](int kind_a, int kind_b) {
    for (int round = 0; round < 50; ++round) {
      const Thing<D> a = random_thing<D>(random, kind_a), b = random_thing<D>(random, kind_b);
      const auto found = contact(a, b, 0), again = contact(a, b, 0);
      ASSERT_TRUE(found) << name_of(kind_a) << " in " << name_of(kind_b);
      EXPECT_NEAR(glm::length(found->normal), 1, 1e-14);
      EXPECT_EQ(found->normal, again->normal);
      EXPECT_LE(least_separation(*found), 1e-14);
    }
  });
}

TEST(Collide, CoincidentCentresHaveAFixedNormal) {
  expect_coincident_centres_part<2>();
  expect_coincident_centres_part<3>();
  const auto spheres = contact<3>({Sphere{1}, {5, 5, 5}, {}}, {Sphere{1}, {5, 5, 5}, {}}, 0);
  ASSERT_TRUE(spheres);
  EXPECT_EQ(spheres->normal, Vec<3>(0, 1, 0));
  EXPECT_EQ(spheres->room[0].separation, -2);
}

TEST(Collide, ASphereInsideABoxLeavesByTheClosestFace) {
  const auto found = contact<2>({AxisBox<2>{{4, 2}}, {0, 0}, {}}, {Sphere{0.5}, {1, -1.5}, {}}, 0);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->normal, Vec<2>(0, -1));
  EXPECT_DOUBLE_EQ(found->room[0].separation, -1);
}

// A small box on a large one has its own four corners, 1 cm deep, halfway between both faces.
TEST(Collide, ABoxOnABoxRestsOnFourCorners) {
  const Thing<3> floor{AxisBox<3>{{5, 1, 5}}, {0, -1, 0}, {}};
  for (const Rotation<3>& turn : {Rotation<3>{}, turned_about({0, 1, 0}, 0.3)}) {
    const auto found = contact<3>(floor, {OrientedBox<3>{{0.5, 0.5, 0.5}}, {1, 0.49, 2}, turn}, 0);
    ASSERT_TRUE(found);
    EXPECT_LE(glm::length(found->normal - Vec<3>(0, 1, 0)), 1e-15);
    ASSERT_EQ(found->count, 4) << "a box on one, two or three corners would rock";
    for (const auto& point : found->points()) {
      EXPECT_NEAR(point.separation, -0.01, 1e-15);
      EXPECT_NEAR(point.position.y, -0.005, 1e-15);
      EXPECT_NEAR(glm::length(point.position - Vec<3>(1, -0.005, 2)), std::sqrt(0.5), 1e-12);
    }
  }
}

TEST(Collide, ATiltedBoxHasItsDepthsCornerByCorner) {
  const double angle = 0.01;
  const auto found = contact<2>({AxisBox<2>{{5, 1}}, {0, -1}, {}},
                                {OrientedBox<2>{{0.5, 0.5}}, {0, 0.49}, {angle}}, 1);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->count, 2);
  const double middle = 0.49 - 0.5 * std::cos(angle), lean = 0.5 * std::sin(angle);
  std::vector<double> depths{found->room[0].separation, found->room[1].separation};
  std::sort(depths.begin(), depths.end());
  EXPECT_NEAR(depths[0], middle - lean, 1e-15);
  EXPECT_NEAR(depths[1], middle + lean, 1e-15);
}

// Octagon: two equal squares turned by 45 degrees. Four of its eight corners stay.
TEST(Collide, EightCornersAreReducedToFourWideOnes) {
  const auto found = contact<3>(
      {OrientedBox<3>{{1, 1, 1}}, {0, 0, 0}, {}},
      {OrientedBox<3>{{1, 1, 1}}, {0, 1.99, 0}, turned_about({0, 1, 0}, kQuarterTurn / 2)}, 0);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->count, 4);
  double area = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < i; ++k)
      area = std::max(area, glm::length(found->room[i].position - found->room[k].position));
  const double octagon = 2 * std::sqrt(1 + std::pow(std::sqrt(2.0) - 1, 2));  // across corners
  EXPECT_NEAR(area, octagon, 1e-12) << "the points do not span the octagon";
}

// x' is a box turned by 45 degrees about z, resting with an edge across the edge of the other one.
TEST(Collide, CrossedEdgesMeetInOnePoint) {
  const double root = std::sqrt(2.0);
  const Thing<3> lower{
      OrientedBox<3>{{1, 1, 1}}, {0, 0, 0}, turned_about({0, 0, 1}, kQuarterTurn / 2)};
  const Thing<3> upper{OrientedBox<3>{{1, 1, 1}},
                       {0.1, 2 * root - 0.01, 0.2},
                       turned_about({1, 0, 0}, kQuarterTurn / 2)};
  const auto found = contact(lower, upper, 0);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->count, 1);
  EXPECT_LE(glm::length(found->normal - Vec<3>(0, 1, 0)), 1e-14);
  EXPECT_NEAR(found->room[0].separation, -0.01, 1e-14);
  EXPECT_LE(glm::length(found->room[0].position - Vec<3>(0, root - 0.005, 0.2)), 0.21)
      << "not near the crossing";
  EXPECT_NEAR(found->room[0].position.x, 0, 1e-14);
  EXPECT_NEAR(found->room[0].position.z, 0.2, 1e-14);
}

TEST(Collide, CornersApartHaveTheirTrueDistance) {
  const auto flat =
      contact<2>({AxisBox<2>{{1, 1}}, {0, 0}, {}}, {AxisBox<2>{{1, 1}}, {5, 6}, {}}, 9);
  ASSERT_TRUE(flat);
  EXPECT_DOUBLE_EQ(least_separation(*flat), 5);
  EXPECT_LE(glm::length(flat->normal - Vec<2>(0.6, 0.8)), 1e-15);
  const auto solid =
      contact<3>({AxisBox<3>{{1, 1, 1}}, {0, 0, 0}, {}}, {AxisBox<3>{{1, 1, 1}}, {4, 5, 8}, {}}, 9);
  ASSERT_TRUE(solid);
  EXPECT_DOUBLE_EQ(least_separation(*solid), 7);  // 2, 3, 6
}

// Clipping counts a corner just beside a face as above it; the distance must not.
TEST(Collide, CornersThatJustMissEachOtherHaveTheirTrueDistance) {
  const auto found = contact<2>({AxisBox<2>{{1, 1}}, {0, 0}, {}},
                                {AxisBox<2>{{1, 1}}, {2 + 4e-5, 2 + 3e-5}, {}}, 1);
  ASSERT_TRUE(found);
  EXPECT_NEAR(least_separation(*found), 5e-5, 1e-15);
  EXPECT_LE(glm::length(found->normal - Vec<2>(0.8, 0.6)), 1e-10);
}

TEST(Collide, ParallelCapsulesMeetInTwoPoints) {
  const Thing<3> a{Capsule{0.5, 1}, {0, 0, 0}, {}};
  for (const double tilt : {0.0, 1e-16, 1e-12, 1e-8, 1e-6, 1e-4}) {
    const auto found =
        contact<3>(a, {Capsule{0.5, 2}, {0.99, 1, 0}, turned_about({0, 0, 1}, tilt)}, 0.1);
    ASSERT_TRUE(found);
    ASSERT_EQ(found->count, 2) << "tilted by " << tilt;
    EXPECT_LE(glm::length(found->normal - Vec<3>(1, 0, 0)), 2 * tilt + 1e-15);
    for (const auto& point : found->points())
      EXPECT_NEAR(point.separation, -0.01, 4 * tilt + 1e-15);
    EXPECT_NEAR(std::abs(found->room[0].position.y - found->room[1].position.y), 2,
                4 * tilt + 1e-12);
  }
}

TEST(Collide, ACapsuleLiesOnABoxAndAcrossItsRimOnTwoPoints) {
  const Thing<3> box{AxisBox<3>{{2, 1, 2}}, {0, -1, 0}, {}};
  for (const double x : {0.0, 1.5})
    for (const double tilt : {0.0, 1e-9, 1e-6, 1e-4, 1e-3, -1e-9, -1e-6, -1e-4, -1e-3}) {
      const auto found = contact<3>(
          box, {Capsule{0.5, 1}, {x, 0.49, 0}, turned_about({0, 0, 1}, kQuarterTurn + tilt)}, 0.1);
      ASSERT_TRUE(found);
      ASSERT_EQ(found->count, 2) << "at " << x << ", tilted by " << tilt;
      EXPECT_LE(glm::length(found->normal - Vec<3>(0, 1, 0)), std::abs(tilt) + 1e-15);
    }
}

TEST(Collide, OnAHalfSpaceABoxHasFourCornersAndACapsuleTwoEnds) {
  const Thing<3> floor{HalfSpace<3>{{0, 1, 0}}, {7, 0, 7}, {}};
  const auto box = contact<3>({AxisBox<3>{{1, 2, 3}}, {0, 1.9, 0}, {}}, floor, 100);
  ASSERT_TRUE(box);
  EXPECT_EQ(box->normal, Vec<3>(0, -1, 0));
  ASSERT_EQ(box->count, 4);
  for (const auto& point : box->points()) {
    EXPECT_NEAR(point.separation, -0.1, 1e-15);
    EXPECT_NEAR(point.position.y, -0.05, 1e-15);
  }
  const auto capsule =
      contact<3>({Capsule{0.5, 1}, {0, 0.4, 0}, turned_about({0, 0, 1}, kQuarterTurn)}, floor, 0);
  ASSERT_TRUE(capsule);
  EXPECT_EQ(capsule->count, 2);
}

TEST(Collide, TwoHalfSpacesHaveNoContact) {
  const Thing<2> wall{HalfSpace<2>{{0, 1}}, {0, 0}, {}};
  EXPECT_FALSE(contact(wall, wall, 1e9));
}

// Names are what warm starting is keyed by: while a box slides and rocks a little, they stay.
TEST(Collide, FeatureNamesStayWhileABoxSlides) {
  Random random(7);
  const Thing<3> floor{AxisBox<3>{{5, 1, 5}}, {0, -1, 0}, {}};
  Thing<3> box{OrientedBox<3>{{0.5, 0.5, 0.5}}, {0, 0.499, 0}, {}};
  const auto first = contact(floor, box, 0.01);
  ASSERT_TRUE(first);
  for (int step = 0; step < 200; ++step) {
    box.position += Vec<3>(1e-3, 0, 5e-4);
    box.position.y = 0.499 + random.between(-1e-4, 1e-4);
    box.orientation = turned_about({1, 0.5, -1}, random.between(-1e-4, 1e-4));
    const auto found = contact(floor, box, 0.01);
    ASSERT_TRUE(found);
    ASSERT_EQ(features(*found), features(*first)) << "step " << step;
  }
}

// A pile of equal boxes, edge to edge: the worst case for names, as every corner is on an edge.
TEST(Collide, FeatureNamesStayWhileAStackJitters) {
  Random random(8);
  const Thing<3> lower{OrientedBox<3>{{0.5, 0.5, 0.5}}, {3, 0.5, 3}, {}};
  Thing<3> upper{OrientedBox<3>{{0.5, 0.5, 0.5}}, {3, 1.499, 3}, {}};
  const auto first = contact(lower, upper, 0.01);
  ASSERT_TRUE(first);
  ASSERT_EQ(first->count, 4);
  for (int step = 0; step < 500; ++step) {
    for (int i = 0; i < 3; ++i)
      upper.position[i] = (i == 1 ? 1.499 : 3) + random.between(-2e-5, 2e-5);
    upper.orientation = turned(Rotation<3>{}, random_arrow<3>(random, 0, 2e-5));
    const auto found = contact(lower, upper, 0.01);
    ASSERT_TRUE(found);
    ASSERT_EQ(features(*found), features(*first)) << "step " << step;
    ASSERT_LE(glm::length(found->normal - first->normal), 1e-4);
  }
}

// A body that settles is a little apart in one step and a little deep in the next, and never quite
// flat. It must have all its points throughout, or it would rock.
TEST(Collide, AHoveringBoxKeepsItsPointsAndTheirNames) {
  Random random(9);
  const Thing<3> lower{OrientedBox<3>{{0.5, 0.5, 0.5}}, {3, 0.5, 3}, {}};
  Thing<3> upper{OrientedBox<3>{{0.5, 0.4, 0.5}}, {3, 1.4, 3}, {}};
  upper.position += Vec<3>(0.2, 0, -0.1);  // over two rims
  const auto first = contact(lower, upper, 0.01);
  ASSERT_TRUE(first);
  for (int step = 0; step < 2000; ++step) {
    upper.position.y = 1.4 + random.between(-1e-4, 1e-4);
    upper.orientation = turned(Rotation<3>{}, random_arrow<3>(random, 0, 1e-4));
    const auto found = contact(lower, upper, 0.01);
    ASSERT_TRUE(found);
    ASSERT_EQ(features(*found), features(*first)) << "step " << step;
    ASSERT_LE(glm::length(found->normal - Vec<3>(0, 1, 0)), 2e-4);
  }
}

}  // namespace
}  // namespace lantern::physics
