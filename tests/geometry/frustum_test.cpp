#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/random.hpp"
#include "geometry/random_vec.hpp"
#include "geometry/ray.hpp"

namespace lantern::geometry {
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
      EXPECT_TRUE(may_overlap(f, Box<3>{f.corners[c], f.corners[c]})) << "touches corner " << c;
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

// The part of a polygon in space where normal . x >= offset.
std::vector<Vec<3>> cut(const std::vector<Vec<3>>& polygon, const Plane<3>& plane) {
  std::vector<Vec<3>> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec<3>& from = polygon[i];
    const Vec<3>& to = polygon[(i + 1) % polygon.size()];
    const double a = height(from, plane), b = height(to, plane);
    if (a >= 0) kept.push_back(from);
    if ((a > 0 && b < 0) || (a < 0 && b > 0)) kept.push_back(from + (to - from) * (a / (a - b)));
  }
  return kept;
}

// A view and a box have a point in common if a face of the view reaches into the box, or the box
// lies within the view.
bool faces_reach_into(const Frustum<3>& f, const Box<3>& box) {
  if (holds(f, box.lo, 0)) return true;
  const std::size_t faces[6][4] = {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 3, 2},
                                   {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}};
  for (const auto& face : faces) {
    std::vector<Vec<3>> part;
    for (const std::size_t corner : face) part.push_back(f.corners[corner]);
    for (int i = 0; i < 3; ++i)
      for (const double sign : {1.0, -1.0}) {
        Plane<3> side{Vec<3>(0.0), sign > 0 ? box.lo[i] : -box.hi[i]};
        side.normal[i] = sign;
        part = cut(part, side);
      }
    if (!part.empty()) return true;
  }
  return false;
}

// Boxes close to the edges of a view, where often nothing parts the two but a plane along an edge
// of each.
TEST(Frustum, BoxesAtItsEdgesAreJudgedExactly) {
  Random random(7);
  int apart = 0;
  for (int round = 0; round < 6000; ++round) {
    const Frustum<3> f = random_view<3>(random);
    const auto corner = static_cast<std::size_t>(random.whole(0, 7));
    const std::size_t other = corner ^ (std::size_t{1} << random.whole(0, 2));
    const Vec<3> on_edge = glm::mix(f.corners[corner], f.corners[other], random.unit());
    const Vec<3> half = glm::abs(random_point<3>(random, -2, 2));
    const auto along = static_cast<int>(random.whole(0, 2));
    Vec<3> away =
        random_point<3>(random, -1, 1);  // from the middle of the box's edge to its centre
    for (int i = 0; i < 3; ++i)
      if (i != along) away[i] = std::copysign(random.between(0.8, 1.4), away[i]);
    const Box<3> box = Box<3>::around(on_edge + away * half, half);
    const bool reaches = faces_reach_into(f, Box<3>::around(box.center(), half + 1e-9));
    if (reaches != faces_reach_into(f, Box<3>::around(box.center(), half - 1e-9))) continue;
    ASSERT_EQ(overlap(f, box), reaches) << "round " << round;
    ASSERT_TRUE(!reaches || may_overlap(f, box));
    apart += !reaches && may_overlap(f, box);
  }
  EXPECT_GT(apart, 100) << "nothing was tried that the planes alone cannot tell";
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
  const auto named = [](const Vec<3>& eye, const Vec<3>& target, const Vec<3>& up) {
    try {
      view_frustum(eye, target, up, 1, 1, 0, 1);
    } catch (const Refused& refused) {
      return std::string(refused.what());
    }
    return std::string();
  };
  const Vec<3> here(0, 0, 0), there(1, 0, 0), up(0, 1, 0), nowhere(0, 0, NAN);
  EXPECT_EQ(named(here, there, up), "");
  EXPECT_NE(named(nowhere, there, up).find("view: eye is"), std::string::npos);
  EXPECT_NE(named(here, nowhere, up).find("view: target is"), std::string::npos);
  EXPECT_NE(named(here, there, nowhere).find("view: up is"), std::string::npos);
  EXPECT_NE(named(here, here, up).find("from eye to target has no length"), std::string::npos);
}

}  // namespace
}  // namespace lantern::geometry
