// Contacts at the limits of size, shape and angle.
#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "physics/collide_oracle.hpp"

namespace lantern::physics {
namespace {

template <int D>
void expect_sane(const Thing<D>& a, const Thing<D>& b, Random& random, double margin) {
  const auto found = contact(a, b, margin);
  ASSERT_TRUE(found);
  const double rounding = 4e-12 * size_of(a, b);
  const double separation = least_separation(*found);
  ASSERT_NEAR(glm::length(found->normal), 1, 1e-14);
  ASSERT_NEAR(gap_along(a, b, found->normal), separation, rounding);
  for (int i = 0; i < 50; ++i)
    ASSERT_LE(gap_along(a, b, random_direction<D>(random)),
              separation + rounding + (separation > 0 ? 0 : allowed_bias(a, b)));
  for (const auto& point : found->points())
    for (int i = 0; i < D; ++i) ASSERT_TRUE(std::isfinite(point.position[i]));
}

template <int D>
void expect_ratios_work() {
  for_each_pair_of_kinds([&](int kind_a, int kind_b) {
    Random random(static_cast<std::uint64_t>(kind_a * kShapes + kind_b));
    for (const double ratio : {1e-6, 1e-3, 1e3, 1e6})
      for (int round = 0; round < 60; ++round) {
        SCOPED_TRACE(fmt::format("{}D {} against {}, ratio {}, round {}", D, name_of(kind_a),
                                 name_of(kind_b), ratio, round));
        auto [a, b] = random_pair<D>(random, kind_a, kind_b);
        if (auto* sphere = std::get_if<Sphere>(&b.shape)) sphere->radius *= ratio;
        if (auto* box = std::get_if<AxisBox<D>>(&b.shape)) box->half_size *= ratio;
        if (auto* box = std::get_if<OrientedBox<D>>(&b.shape)) box->half_size *= ratio;
        if (auto* capsule = std::get_if<Capsule>(&b.shape)) {
          capsule->radius *= ratio;
          capsule->half_length *= ratio;
        }
        const double reach = size_of(a) + size_of(b);
        b.position = a.position + random_arrow<D>(random, 0, reach);
        expect_sane<D>(a, b, random, 1e9);
        if (testing::Test::HasFatalFailure()) return;
      }
  });
}

TEST(CollideExtreme, SizeRatiosFromAMillionthToAMillion) {
  expect_ratios_work<2>();
  expect_ratios_work<3>();
}

template <int D>
void expect_thin_things_work() {
  Random random(D);
  for (int round = 0; round < 500; ++round) {
    Vec<D> half_a(1.0), half_b(1.0);
    half_a[static_cast<int>(random.whole(0, D - 1))] = 1e4;
    half_b[static_cast<int>(random.whole(0, D - 1))] = random.whole(0, 1) == 0 ? 1e-4 : 1e4;
    const Thing<D> a{OrientedBox<D>{half_a}, Vec<D>(0.0), random_rotation(random, Rotation<D>{})};
    Thing<D> b{OrientedBox<D>{half_b}, Vec<D>(0.0), random_rotation(random, Rotation<D>{})};
    if (round % 3 == 0) b.shape = Capsule{1, 1e4};
    b.position = random_arrow<D>(random, 0, 2e4);
    expect_sane<D>(a, b, random, 1e9);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(CollideExtreme, AspectsOfOneToTenThousand) {
  expect_thin_things_work<2>();
  expect_thin_things_work<3>();
}

// Everything without size at all: points and lines that meet or miss each other.
TEST(CollideExtreme, ShapesWithoutSize) {
  const Shape<3> points[] = {Sphere{0}, AxisBox<3>{}, OrientedBox<3>{}, Capsule{}};
  for (const Shape<3>& a : points) {
    for (const Shape<3>& b : points) {
      SCOPED_TRACE(fmt::format("{} {}", a.index(), b.index()));
      const auto meet = contact<3>({a, {1, 2, 3}, {}}, {b, {1, 2, 3}, {}}, 0);
      ASSERT_TRUE(meet);
      EXPECT_EQ(meet->count, 1);
      EXPECT_EQ(meet->room[0].separation, 0);
      EXPECT_EQ(meet->room[0].position, Vec<3>(1, 2, 3));
      const auto miss = contact<3>({a, {1, 2, 3}, {}}, {b, {1, 2 + 3e-7, 3 + 4e-7}, {}}, 1);
      ASSERT_TRUE(miss);
      EXPECT_NEAR(miss->room[0].separation, 5e-7, 1e-15);
      EXPECT_FALSE(contact<3>({a, {1, 2, 3}, {}}, {b, {1, 2, 3 + 1e-9}, {}}, 0));
    }
    const auto wall = contact<3>({a, {1, 2, 3}, {}}, {HalfSpace<3>{{0, 1, 0}}, {0, 2, 0}, {}}, 0);
    ASSERT_TRUE(wall);
    EXPECT_EQ(wall->room[0].separation, 0);
  }
}

// Two boxes with a pair of edges that are parallel but for a tiny turn, in an edge-to-edge contact.
// The product of such edges has no length to speak of; dividing by it would give any normal.
TEST(CollideExtreme, NearlyParallelEdgesKeepTheirNormal) {
  const double root = std::sqrt(2.0), eighth = std::atan(1.0);
  const Vec<3> z(0, 0, 1);
  const Thing<3> a{OrientedBox<3>{{1, 1, 1}}, Vec<3>(0.0), turned(Rotation<3>{}, z * eighth)};
  for (const double gap : {-0.01, 0.0, 0.01}) {
    Vec<3> previous(0.0);
    for (const double turn :
         {0.0, 1e-16, 1e-14, 1e-12, 1e-10, 1e-9, 1e-8, 1e-7, 0.99e-6, 1e-6, 1.01e-6, 1e-5}) {
      for (const Vec<3>& about :
           {Vec<3>(1, 0, 0), Vec<3>(0, 1, 0), Vec<3>(1, 1, 0), Vec<3>(1, 2, 3)}) {
        SCOPED_TRACE(fmt::format("turned by {}, {} apart", turn, gap));
        const Thing<3> b{OrientedBox<3>{{1, 1, 1}},
                         {2 * root + gap, 0.1, 0.2},
                         turned(turned(Rotation<3>{}, z * eighth), glm::normalize(about) * turn)};
        const auto found = contact(a, b, 0.1);
        ASSERT_TRUE(found);
        ASSERT_NEAR(glm::length(found->normal), 1, 1e-14);
        if (previous != Vec<3>(0.0)) {
          ASSERT_LE(glm::length(found->normal - previous), 1e-3 + 100 * turn) << "the normal jumps";
        }
        previous = found->normal;
      }
    }
  }
}

TEST(CollideExtreme, NearlyParallelCapsulesKeepTheirNormal) {
  const Thing<3> a{Capsule{0.1, 1e4}, {0, 0, 0}, {}};
  for (const double turn : {0.0, 1e-16, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6}) {
    const Thing<3> b{Capsule{0.1, 1e4}, {0.2, 10, 0}, turned(Rotation<3>{}, Vec<3>(turn, 0, 0))};
    const auto found = contact(a, b, 1);
    ASSERT_TRUE(found);
    EXPECT_LE(glm::length(found->normal - Vec<3>(1, 0, 0)), 1e-9) << turn;
    EXPECT_NEAR(least_separation(*found), 0, 1e-12) << turn;
  }
}

// As a box turns and slides past another one, its separation may bend but never jump.
template <int D>
void expect_continuous(int kind_a, int kind_b) {
  Random random(static_cast<std::uint64_t>(kind_a * kShapes + kind_b));
  for (int round = 0; round < 20; ++round) {
    const auto [a, b] = random_pair<D>(random, kind_a, kind_b);
    const Vec<D> way = random_direction<D>(random);
    const double step = 1e-5;
    double before = 0;
    for (int i = 0; i < 200; ++i) {
      Thing<D> moved = b;
      moved.position += way * (step * i);
      const auto found = contact(a, moved, 1e9);
      ASSERT_TRUE(found);
      const double now = least_separation(*found);
      if (i > 0) {
        ASSERT_LE(std::abs(now - before), step + allowed_bias(a, b) + 1e-10)
            << name_of(kind_a) << " against " << name_of(kind_b) << " in " << D << "D";
      }
      before = now;
    }
  }
}

TEST(CollideExtreme, SeparationNeverJumps) {
  for_each_pair_of_kinds([](int a, int b) {
    expect_continuous<2>(a, b);
    expect_continuous<3>(a, b);
  });
}

TEST(CollideExtreme, TinyAndHugeNumbersStayFinite) {
  for (const double scale : {1e-150, 1e-100, 1e-30, 1e30, 1e70})
    for_each_pair_of_kinds([&](int kind_a, int kind_b) {
      Random random(static_cast<std::uint64_t>(kind_a * kShapes + kind_b));
      for (int round = 0; round < 20; ++round) {
        auto [a, b] = random_pair<3>(random, kind_a, kind_b);
        for (Thing<3>* thing : {&a, &b}) {
          thing->position *= scale;
          if (auto* sphere = std::get_if<Sphere>(&thing->shape)) sphere->radius *= scale;
          if (auto* box = std::get_if<AxisBox<3>>(&thing->shape)) box->half_size *= scale;
          if (auto* box = std::get_if<OrientedBox<3>>(&thing->shape)) box->half_size *= scale;
          if (auto* capsule = std::get_if<Capsule>(&thing->shape)) {
            capsule->radius *= scale;
            capsule->half_length *= scale;
          }
        }
        const auto found = contact(a, b, 1e300);
        ASSERT_TRUE(found) << name_of(kind_a) << " against " << name_of(kind_b) << " at " << scale;
        ASSERT_NEAR(glm::length(found->normal), 1, 1e-12);
        for (const auto& point : found->points()) {
          ASSERT_TRUE(std::isfinite(point.separation));
          for (int i = 0; i < 3; ++i) ASSERT_TRUE(std::isfinite(point.position[i]));
        }
      }
    });
}

}  // namespace
}  // namespace lantern::physics
