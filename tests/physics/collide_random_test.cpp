// Random pairs of all shapes against the oracle.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "physics/collide_oracle.hpp"

namespace lantern::physics {
namespace {

constexpr double kFar = 1e3;  // a margin that every random pair is within

// The release build runs all rounds; the sanitizers see every way through the code in a few.
#ifdef __SANITIZE_ADDRESS__
constexpr int kShare = 4;
#else
constexpr int kShare = 1;
#endif

template <int D>
void for_random_pairs(std::uint64_t seed, int rounds, const auto& test) {
  for_each_pair_of_kinds([&](int kind_a, int kind_b) {
    Random random(seed + static_cast<std::uint64_t>(kind_a * kShapes + kind_b));
    for (int round = 0; round < rounds / kShare; ++round) {
      const auto [a, b] = random_pair<D>(random, kind_a, kind_b);
      SCOPED_TRACE(
          fmt::format("{}D {} against {}, round {}", D, name_of(kind_a), name_of(kind_b), round));
      test(a, b, random);
      if (testing::Test::HasFailure()) return;
    }
  });
}

// No direction separates the two by more than the contact says, and its normal by no less. So the
// separation is exact, but for the bias between nearly equal axes of overlapping boxes.
template <int D>
void expect_true_separation(const Thing<D>& a, const Thing<D>& b, Random& random,
                            double precision = 4e-12) {
  const auto found = contact(a, b, kFar);
  ASSERT_TRUE(found) << "nothing within a margin of 1000";
  const Vec<D> n = found->normal;
  ASSERT_NEAR(glm::length(n), 1, 1e-14) << "the normal is not of unit length";
  const double separation = least_separation(*found);
  // The direction between the cores is the less certain the closer they are to each other.
  const double size = size_of(a, b), between = std::max(separation + radii(a, b), 1e-9 * size);
  const double rounding = precision * size + 4e-15 * size * size / (between + 1e-300);
  ASSERT_NEAR(gap_along(a, b, n), separation, rounding)
      << "the normal does not separate by what the contact says";
  const double allowed = rounding + (separation > 0 ? 0 : allowed_bias(a, b));
  for (int i = 0; i < 100; ++i) {
    const double spread = 1.0 / static_cast<double>(1 << random.whole(0, 20));
    for (const Vec<D>& m :
         {random_direction<D>(random), glm::normalize(n + spread * random_direction<D>(random))})
      ASSERT_LE(gap_along(a, b, m), separation + allowed) << "another direction separates further";
  }
}

TEST(CollideRandom, NoDirectionSeparatesFurther) {
  for_random_pairs<2>(100, 250, [](const auto& a, const auto& b, Random& random) {
    expect_true_separation<2>(a, b, random);
  });
  for_random_pairs<3>(200, 250, [](const auto& a, const auto& b, Random& random) {
    expect_true_separation<3>(a, b, random);
  });
}

template <int D>
void expect_points_between_the_surfaces(const Thing<D>& a, const Thing<D>& b) {
  const auto found = contact(a, b, kFar);
  ASSERT_TRUE(found);
  ASSERT_GE(found->count, 1);
  ASSERT_LE(found->count, Manifold<D>::kMostPoints);
  for (const auto& point : found->points()) {
    // Corners that lie outside the other face by 1e-4 of the smallest half size count as inside;
    // the normal of a long contact may lean by a tenth against its faces.
    const double allowed = std::abs(point.separation) * 0.55 + 0.12 * allowed_bias(a, b) +
                           0.035 * radii(a, b) + 1e-11 * size_of(a, b);
    ASSERT_LE(distance_to(a, point.position), allowed) << "a contact point is off the first shape";
    ASSERT_LE(distance_to(b, point.position), allowed) << "a contact point is off the second shape";
  }
  for (int i = 0; i < found->count; ++i)
    for (int k = 0; k < i; ++k)
      ASSERT_NE(found->points()[static_cast<std::size_t>(i)].feature,
                found->points()[static_cast<std::size_t>(k)].feature)
          << "two contacts with one name";
}

TEST(CollideRandom, PointsLieBetweenTheSurfaces) {
  const auto test = [](const auto& a, const auto& b, Random&) {
    expect_points_between_the_surfaces(a, b);
  };
  for_random_pairs<2>(300, 1000, test);
  for_random_pairs<3>(400, 1000, test);
}

template <int D>
void expect_margin_and_verdict(const Thing<D>& a, const Thing<D>& b, Random& random) {
  const auto all = contact(a, b, kFar);
  ASSERT_TRUE(all);
  const double least = least_separation(*all);
  const double rounding = 4e-12 * size_of(a, b);
  if (std::abs(least) > rounding + allowed_bias(a, b)) {
    ASSERT_EQ(contact(a, b, 0).has_value(), least <= 0) << "wrong verdict at " << least;
  }
  const double margin = random.between(0, 2);
  const auto some = contact(a, b, margin);
  if (std::abs(least - margin) > rounding + allowed_bias(a, b)) {
    ASSERT_EQ(some.has_value(), least <= margin) << least << " apart, margin " << margin;
  }
  if (!some) return;
  ASSERT_NEAR(least_separation(*some), least, rounding + (least > 0 ? 0 : allowed_bias(a, b)))
      << "the margin changes the separation";
  for (const auto& point : some->points()) ASSERT_LE(point.separation, margin + rounding);
}

TEST(CollideRandom, MarginKeepsWhatIsNoFurtherApart) {
  for_random_pairs<2>(500, 1000, [](const auto& a, const auto& b, Random& random) {
    expect_margin_and_verdict<2>(a, b, random);
  });
  for_random_pairs<3>(600, 1000, [](const auto& a, const auto& b, Random& random) {
    expect_margin_and_verdict<3>(a, b, random);
  });
}

template <int D>
void expect_touching_once_moved(const Thing<D>& a, Thing<D> b) {
  const auto before = contact(a, b, kFar);
  ASSERT_TRUE(before);
  b.position -= before->normal * least_separation(*before);
  const auto after = contact(a, b, kFar);
  ASSERT_TRUE(after);
  ASSERT_NEAR(least_separation(*after), 0, 1e-11 * size_of(a, b) + 2 * allowed_bias(a, b))
      << "moved by its separation of " << least_separation(*before) << " it does not touch";
}

TEST(CollideRandom, MovingByTheSeparationMakesThemTouch) {
  const auto test = [](const auto& a, const auto& b, Random&) { expect_touching_once_moved(a, b); };
  for_random_pairs<2>(700, 1000, test);
  for_random_pairs<3>(800, 1000, test);
}

template <int D>
void expect_mirrored(const Thing<D>& a, const Thing<D>& b) {
  // Equal shapes with a common centre have the same fixed normal both ways.
  if (a.position == b.position && a.shape.index() == b.shape.index()) return;
  const auto one = contact(a, b, kFar), other = contact(b, a, kFar);
  ASSERT_TRUE(one && other);
  ASSERT_EQ(one->normal, -other->normal);
  ASSERT_EQ(one->count, other->count);
  for (int i = 0; i < one->count; ++i) {
    const auto &p = one->points()[static_cast<std::size_t>(i)],
               &q = other->points()[static_cast<std::size_t>(i)];
    ASSERT_EQ(p.position, q.position);
    ASSERT_EQ(p.separation, q.separation);
    ASSERT_EQ(p.feature, q.feature);
  }
}

// Equal shapes too, where nothing but the place tells one from the other.
TEST(CollideRandom, TheOtherSideSeesTheSameContact) {
  const auto test = [](const auto& a, const auto& b, Random&) {
    expect_mirrored(a, b);
    auto equal = b;
    equal.shape = a.shape;
    if (!half_space(a)) expect_mirrored(a, equal);
  };
  for_random_pairs<2>(900, 500, test);
  for_random_pairs<3>(1000, 500, test);
}

// Positions are rounded to a grid that the offset keeps, so that nothing at all may change.
template <int D>
void expect_same_far_away(Thing<D> a, Thing<D> b, double offset) {
  for (int i = 0; i < D; ++i) {
    a.position[i] = std::ldexp(std::round(std::ldexp(a.position[i], 20)), -20);
    b.position[i] = std::ldexp(std::round(std::ldexp(b.position[i], 20)), -20);
  }
  const auto near = contact(a, b, kFar);
  Thing<D> far_a = a, far_b = b;
  far_a.position += Vec<D>(offset);
  far_b.position += Vec<D>(offset);
  const auto far = contact(far_a, far_b, kFar);
  ASSERT_TRUE(near && far);
  ASSERT_EQ(near->normal, far->normal);
  ASSERT_EQ(near->count, far->count);
  for (std::size_t i = 0; i < near->points().size(); ++i) {
    ASSERT_EQ(near->points()[i].separation, far->points()[i].separation);
    ASSERT_EQ(near->points()[i].feature, far->points()[i].feature);
    const Vec<D> moved = far->points()[i].position - near->points()[i].position - Vec<D>(offset);
    ASSERT_LE(glm::length(moved), 4e-16 * offset) << "the point lost more than its own rounding";
  }
}

TEST(CollideRandom, FarFromTheOriginNothingIsLost) {
  for (const double offset : {1e6, 1e7, 1e9}) {
    const auto test = [&](const auto& a, const auto& b, Random&) {
      expect_same_far_away(a, b, offset);
    };
    for_random_pairs<2>(1100, 200, test);
    for_random_pairs<3>(1200, 200, test);
  }
}

// Two boxes nearly flat on each other, over a rim or a corner or not, a little apart or deep: here
// face, edge and corner contacts are nearly equal, and the wrong one is wrong by little.
template <int D>
void expect_true_separation_when_nearly_flat() {
  Random random(1300 + D);
  for (int round = 0; round < 1500 / kShare; ++round) {
    SCOPED_TRACE(fmt::format("{}D, round {}", D, round));
    const auto small = [&](double most) {
      return random.between(-most, most) / static_cast<double>(1ll << random.whole(0, 40));
    };
    Thing<D> a = random_thing<D>(random, 2), b = random_thing<D>(random, round % 4 == 0 ? 3 : 2);
    a.orientation = b.orientation = {};
    Vec<D> reach = core_of(a).half + core_of(b).half;
    for (int i = 0; i < D; ++i) b.position[i] = random.between(-1, 1) * reach[i];
    const int up = static_cast<int>(random.whole(0, D - 1));
    b.position[up] = reach[up] + radii(a, b) + small(0.1);
    if (const int side = static_cast<int>(random.whole(0, D - 1)); side != up)
      b.position[side] = reach[side] + small(0.1);  // over an edge, or just not
    const double turn = small(0.1);
    if constexpr (D == 2)
      b.orientation = turned(b.orientation, turn);
    else
      b.orientation = turned(b.orientation, random_direction<3>(random) * turn);
    // Which of two nearly equal points of an edge is the closest, the square root of a rounding
    // says.
    expect_true_separation<D>(a, b, random, 1e-9);
    expect_mirrored<D>(a, b);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(CollideRandom, NearlyFlatContactsAreExactToo) {
  expect_true_separation_when_nearly_flat<2>();
  expect_true_separation_when_nearly_flat<3>();
}

// The fifteen axes of two boxes, without any care.
double naive_separation(const Thing<3>& a, const Thing<3>& b) {
  const Mat<3> axes_a = core_of(a).axes, axes_b = core_of(b).axes;
  double best = -std::numeric_limits<double>::infinity();
  const auto consider = [&](const Vec<3>& n) {
    if (glm::length(n) > 1e-3)
      best =
          std::max({best, gap_along(a, b, glm::normalize(n)), gap_along(a, b, -glm::normalize(n))});
  };
  for (int i = 0; i < 3; ++i) {
    consider(axes_a[i]);
    consider(axes_b[i]);
    for (int j = 0; j < 3; ++j) consider(glm::cross(axes_a[i], axes_b[j]));
  }
  return best;
}

TEST(CollideRandom, OverlapOfBoxesIsThatOfFifteenAxes) {
  for (const int kind : {1, 2}) {
    Random random(static_cast<std::uint64_t>(kind));
    for (int round = 0; round < 5000 / kShare; ++round) {
      const auto [a, b] = random_pair<3>(random, kind, 2);
      const double expected = naive_separation(a, b);
      const auto found = contact(a, b, kFar);
      ASSERT_TRUE(found);
      const double least = least_separation(*found);
      if (expected > 0)
        ASSERT_GE(least, expected - 1e-11) << "closer than a separating axis says";
      else
        ASSERT_NEAR(least, expected, allowed_bias(a, b) + 1e-11) << "not the least depth";
    }
  }
}

}  // namespace
}  // namespace lantern::physics
