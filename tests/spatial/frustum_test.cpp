#include "geometry/frustum.hpp"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/random.hpp"
#include "geometry/random_vec.hpp"

namespace lantern {
namespace {

using std::numbers::pi;

template <int D>
Frustum<D> random_view(Random& random) {
  const double near = random.between(0, 2), far = near + random.between(0.5, 8);
  const double angle = random.between(0.1, 2.8);
  if constexpr (D == 2)
    return view_wedge(random_point<2>(random, -3, 3), random_point<2>(random, -1, 1), angle, near,
                      far);
  else
    return view_frustum(random_point<3>(random, -3, 3), random_point<3>(random, -3, 3), {0, 1, 0},
                        angle, random.between(0.4, 2), near, far);
}

template <int D>
bool holds(const Frustum<D>& f, const Vec<D>& p, double slack) {
  for (const Plane<D>& plane : f.planes)
    if (height(p, plane) < -slack) return false;
  return true;
}

TEST(Frustum, AViewToTheRight) {
  const Frustum<2> f = view_wedge({1, 0}, {5, 0}, pi / 2, 1, 3);
  const std::array<Vec<2>, 4> corners = {Vec<2>{2, 1}, {4, 3}, {2, -1}, {4, -3}};
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(glm::distance(f.corners[i], corners[i]), 0, 1e-15) << "corner " << i;
  const auto sees = [&](double x, double y) {
    return overlap(f, Box<2>::around({x, y}, Vec<2>(0.1)));
  };
  EXPECT_TRUE(sees(3, 0));
  EXPECT_FALSE(sees(1.5, 0)) << "nearer than near";
  EXPECT_FALSE(sees(4.2, 0)) << "beyond far";
  EXPECT_TRUE(sees(3, 2.15));
  EXPECT_FALSE(sees(3, 2.25)) << "above the upper side";
  EXPECT_TRUE(overlap(f, Box<2>{f.corners[1], {9, 9}})) << "touches a corner";
}

TEST(Frustum, CornersLieOnTheirPlanesAndAxesAreRight) {
  Random random(1);
  for (int round = 0; round < 200; ++round) {
    const Frustum<3> f = random_view<3>(random);
    for (std::size_t c = 0; c < 8; ++c) {
      EXPECT_TRUE(holds(f, f.corners[c], 1e-12)) << "corner " << c << " lies outside";
      EXPECT_NEAR(height(f.corners[c], f.planes[(c & 1u) != 0 ? 1 : 0]), 0, 1e-12);
      for (std::size_t k = 1; k < 3; ++k)
        EXPECT_NEAR(height(f.corners[c], f.planes[2 * k + ((c >> k & 1u) != 0 ? 0 : 1)]), 0, 1e-12)
            << "corner " << c << ", axis " << k;
    }
    for (const Plane<3>& plane : f.planes) EXPECT_NEAR(glm::length(plane.normal), 1, 1e-14);
    EXPECT_GE(f.axes[2].y, 0) << "up is up";
  }
  const Frustum<3> f = view_frustum({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, pi / 2, 2, 1, 2);
  EXPECT_NEAR(glm::distance(f.axes[1], Vec<3>(1, 0, 0)), 0, 1e-15)
      << "looking along -z, x is right";
  EXPECT_NEAR(glm::distance(f.corners[7], Vec<3>(4, 2, -2)), 0, 1e-14) << "far upper right";
}

// Points are the oracle: one found in both proves an overlap; none among many is no proof, so boxes
// that are said to be apart must be apart on a plane through them, too.
template <int D>
void overlap_agrees_with_points(std::uint64_t seed) {
  Random random(seed);
  const Frustum<D> f = random_view<D>(random);
  const Box<D> box =
      Box<D>::around(random_point<D>(random, -6, 6), glm::abs(random_point<D>(random, -2, 2)));
  const bool said = overlap(f, box);
  EXPECT_TRUE(!said || may_overlap(f, box)) << "the cheap test must not refuse, seed " << seed;
  // Alternating projections between two convex bodies come as near to each other as they are.
  Vec<D> p = box.center();
  for (int i = 0; i < 2000; ++i) {
    for (const Plane<D>& plane : f.planes)
      if (const double h = height(p, plane); h < 0) p -= plane.normal * h;
    p = glm::clamp(p, box.lo, box.hi);
  }
  const bool meets = holds(f, p, 1e-6);
  EXPECT_TRUE(said || !holds(f, p, -1e-6)) << "a common point was denied, seed " << seed;
  EXPECT_TRUE(!said || meets) << "there is no common point, seed " << seed;
}

TEST(Frustum, OverlapIsExact) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    overlap_agrees_with_points<2>(seed);
    overlap_agrees_with_points<3>(seed);
  }
}

TEST(Frustum, EndlessBoxesAreSeen) {
  const double infinity = std::numeric_limits<double>::infinity();
  const Frustum<3> f = view_frustum({0, 5, 0}, {0, 0, -20}, {0, 1, 0}, 1, 1, 1, 50);
  EXPECT_TRUE(overlap(f, Box<3>{{-1e150, -1e150, -1e150}, {1e150, 0, 1e150}})) << "a floor";
  EXPECT_FALSE(overlap(f, Box<3>{{-1e150, 30, -1e150}, {1e150, 1e150, 1e150}})) << "a ceiling";
  EXPECT_TRUE(may_overlap(f, Box<3>{Vec<3>(-infinity), Vec<3>(infinity)}));
  EXPECT_FALSE(may_overlap(f, Box<3>{{-infinity, -infinity, 60}, Vec<3>(infinity)}));
}

TEST(Frustum, RefusesWhatIsNoView) {
  EXPECT_THROW(view_wedge({0, 0}, {0, 0}, 1, 0, 1), Refused) << "no direction";
  EXPECT_THROW(view_wedge({0, 0}, {1, 0}, 0, 0, 1), Refused) << "no angle";
  EXPECT_THROW(view_wedge({0, 0}, {1, 0}, pi, 0, 1), Refused);
  EXPECT_THROW(view_wedge({0, 0}, {1, 0}, 1, 1, 1), Refused) << "near is far";
  EXPECT_THROW(view_wedge({0, 0}, {1, 0}, 1, -1, 1), Refused);
  EXPECT_THROW(view_wedge({NAN, 0}, {1, 0}, 1, 0, 1), Refused);
  EXPECT_THROW(view_frustum({0, 0, 0}, {0, 1, 0}, {0, 1, 0}, 1, 1, 0, 1), Refused) << "up along";
  EXPECT_THROW(view_frustum({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, 0, 0, 1), Refused) << "no width";
}

}  // namespace
}  // namespace lantern
