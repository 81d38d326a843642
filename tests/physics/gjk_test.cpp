// The distance by support points, the difference that it searches, and the axes that the narrow
// phase tells of, against the narrow phase and the oracle's support functions.
#include "physics/gjk.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "physics/collide_oracle.hpp"

namespace lantern::physics {
namespace {

constexpr int kHalfSpace = kShapes - 1;

void for_flat_pairs(int rounds, const auto& test) {
  for (int kind_a = 0; kind_a < kHalfSpace; ++kind_a)
    for (int kind_b = 0; kind_b < kHalfSpace; ++kind_b) {
      Random random(static_cast<std::uint64_t>(700 + kind_a * kShapes + kind_b));
      for (int round = 0; round < rounds; ++round) {
        const auto [a, b] = random_pair<2>(random, kind_a, kind_b);
        SCOPED_TRACE(
            fmt::format("{} against {}, round {}", name_of(kind_a), name_of(kind_b), round));
        test(a, b, random);
        if (testing::Test::HasFailure()) return;
      }
    }
}

TEST(Gjk, FindsTheDistanceThatTheNarrowPhaseFinds) {
  int apart = 0, together = 0;
  for_flat_pairs(400, [&](const Thing<2>& a, const Thing<2>& b, Random&) {
    const double separation = least_separation(*contact(a, b, 1e3));
    const double rounding = 1e-9 * size_of(a, b);
    std::vector<GjkStep> steps;
    const auto found = gjk(a.placed(), b.placed(), &steps);
    ASSERT_TRUE(found);
    EXPECT_EQ(std::ssize(steps), found->steps);
    EXPECT_LE(found->steps, 12);
    EXPECT_NEAR(found->distance, std::max(0.0, separation), rounding);
    if (separation > rounding) {
      ++apart;
      EXPECT_FALSE(found->overlaps);
      EXPECT_NEAR(glm::length(found->closest.difference()), separation, rounding);
      EXPECT_LE(distance_to(a, found->closest.a), rounding);
      EXPECT_LE(distance_to(b, found->closest.b), rounding);
    } else if (separation < -rounding) {
      ++together;
      EXPECT_TRUE(found->overlaps);
    }
    // Each search but the last comes nearer.
    for (std::size_t i = 1; i < steps.size(); ++i)
      EXPECT_LE(glm::length(steps[i].nearest), glm::length(steps[i - 1].nearest) + rounding);
  });
  EXPECT_GT(apart, 1000);
  EXPECT_GT(together, 1000);
}

TEST(Gjk, HasNoDistanceToAHalfSpace) {
  const Thing<2> ground{HalfSpace<2>{{0, 1}}, {0, 0}, {}}, ball{Sphere{1}, {0, 3}, {}};
  EXPECT_FALSE(gjk(ground.placed(), ball.placed()));
  EXPECT_FALSE(minkowski_difference(ball.placed(), ground.placed()));
  EXPECT_FALSE(farthest_points(ground.placed(), {0, 1}));
}

// In every direction it reaches as far as both shapes together, and it is convex.
TEST(Gjk, DifferenceReachesAsFarAsBothShapes) {
  for_flat_pairs(60, [&](const Thing<2>& a, const Thing<2>& b, Random& random) {
    const auto found = minkowski_difference(a.placed(), b.placed());
    ASSERT_TRUE(found);
    const std::vector<Vec<2>>& corners = found->corners;
    ASSERT_GE(corners.size(), 1u);
    ASSERT_LE(corners.size(), 8u);
    const double rounding = 1e-12 * size_of(a, b);
    for (int i = 0; i < 20; ++i) {
      const Vec<2> n = random_direction<2>(random);
      double reach = -1e300;
      for (const Vec<2>& p : corners) reach = std::max(reach, glm::dot(p, n));
      ASSERT_NEAR(reach + found->radius, -gap_along(a, b, n), rounding);
      const auto farthest = farthest_points(a.placed(), n);
      ASSERT_NEAR(glm::dot(farthest->first - a.position, n), support(a, n), 1e-8 * size_of(a));
    }
    for (std::size_t i = 0; i < corners.size() && corners.size() > 2; ++i) {
      const Vec<2> here = corners[i], next = corners[(i + 1) % corners.size()],
                   after = corners[(i + 2) % corners.size()];
      ASSERT_GE(cross(next - here, after - next), -rounding * size_of(a, b));
    }
  });
}

// The first gap ends the test; without one, the contact is on the axis of the least overlap.
TEST(NarrowTrace, TellsEachAxisUntilOneParts) {
  int parted = 0, late = 0;
  for_flat_pairs(200, [&](const Thing<2>& a, const Thing<2>& b, Random&) {
    std::vector<MeasuredAxis<2>> axes;
    NarrowTrace<2> trace;
    trace.axes = &axes;
    const auto found = collide(a.placed(), b.placed(), 0, trace);
    ASSERT_FALSE(axes.empty());
    EXPECT_GE(trace.lengths, axes.size());
    const double rounding = 1e-11 * size_of(a, b) + 1e-14;
    double best = -1e300;
    for (const MeasuredAxis<2>& axis : axes) {
      EXPECT_NEAR(axis.separation, gap_along(a, b, axis.normal), rounding + 1e-12);
      if (&axis != &axes.back()) {
        EXPECT_LE(axis.separation, 0);
      }
      best = std::max(best, axis.separation);
    }
    EXPECT_EQ(found.has_value(), axes.back().separation <= 0);
    parted += !found;
    late += !found && axes.size() > 2;
    if (found) {
      EXPECT_NEAR(least_separation(*found), best, allowed_bias(a, b) + rounding);
    }
  });
  EXPECT_GT(parted, 400);
  EXPECT_GT(late, 20);
}

TEST(NarrowTrace, BoxesThatLieTheSameWayHaveTwoAxes) {
  const Thing<2> a{AxisBox<2>{{2, 1}}, {0, 0}, {}}, b{OrientedBox<2>{{1, 1}}, {1, 0.5}, {}};
  const Thing<2> turned{OrientedBox<2>{{1, 1}}, {1, 0.5}, {0.3}};
  const auto lengths = [](const Thing<2>& one, const Thing<2>& other) {
    NarrowTrace<2> trace;
    EXPECT_TRUE(collide(one.placed(), other.placed(), 0, trace));
    return trace.lengths;
  };
  EXPECT_EQ(lengths(a, b), 6u);
  EXPECT_EQ(lengths(a, turned), 12u);
}

}  // namespace
}  // namespace lantern::physics
