#include "draw/projection.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/random.hpp"

namespace lantern::draw {
namespace {

const Box<2> kProjectionPanel{{100, 50}, {700, 450}};
const Box<3> kCube{{-1, -1, -1}, {1, 1, 1}};

View3D seen_from(const Vec<3>& eye, const Vec<3>& target, double angle = 0.7) {
  return View3D(kCube, Camera{eye, target, angle}, kProjectionPanel);
}

bool finite(const Outline& points) {
  for (const Vec<2>& p : points)
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return false;
  return true;
}

TEST(View2D, CentresTheBoundsAndTurnsYOver) {
  const View2D view({{-1, -1}, {3, 1}}, kProjectionPanel);
  EXPECT_NEAR(view.scale(), 594 / 4.0, 1e-12) << "as wide as the panel, less a margin";
  EXPECT_EQ(view.to_page(Vec<2>(1, 0)), kProjectionPanel.center());
  const Vec<3> p{2.5, 0.5, 0};
  EXPECT_EQ(view.seen(p), view.to_page(p)) << "all is seen";
  const Vec<2> way = view.to_page(p) - view.to_page(Vec<3>(1, 0, 0));
  const Vec<2> turned = view.turned(p - Vec<3>(1, 0, 0)) * view.scale_at(p);
  EXPECT_NEAR(glm::distance(way, turned), 0, 1e-9);
  EXPECT_LT(way.y, 0) << "up is up: the page counts downwards";
}

TEST(View3D, IsAPinhole) {
  const View3D view = seen_from({0, 0, 10}, {0, 0, 0});
  const Vec<2> middle = view.to_page({0, 0, 0});
  const double unit = view.to_page({1, 0, 0}).x - middle.x;  // at distance 10
  for (const Vec<3>& p : {Vec<3>(0.5, 0.25, 0), Vec<3>(1, -1, 5), Vec<3>(-2, 1, -10)}) {
    const double away = 10 - p.z;
    const Vec<2> at = view.to_page(p) - middle;
    EXPECT_NEAR(at.x, unit * p.x * 10 / away, 1e-9) << "right is right, twice as far half as large";
    EXPECT_NEAR(at.y, -unit * p.y * 10 / away, 1e-9) << "up is up: the page counts downwards";
    EXPECT_NEAR(view.depth(p), away, 1e-12);
  }
}

TEST(View3D, FitsTheWorldIntoItsPanel) {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    Vec<3> eye;
    for (int axis = 0; axis < 3; ++axis) eye[axis] = random.between(-9, 9);
    if (glm::length(eye) < 3) continue;
    const View3D view = seen_from(eye, {0, 0, 0}, 2.0);
    Outline corners;
    for (const Vec<3>& corner : corners_of(kCube)) corners.push_back(view.to_page(corner));
    const Box<2> box = box_of(corners);
    EXPECT_TRUE(holds(kProjectionPanel, box))
        << "a corner of the world is out of its panel, eye " << i;
    const Vec<2> room = kProjectionPanel.size() - box.size();
    EXPECT_LT(std::min(room.x, room.y), 13) << "the world leaves room unused on both axes";
  }
}

TEST(View3D, KeepsTheAngleFromWithinAndWhenItShowsAPart) {
  // A half angle of atan(1/2): half the panel, less its margin, is half the distance.
  const double angle = 2 * std::atan(0.5);
  for (const Vec<3>& eye : {Vec<3>(0, 0, 0.9), Vec<3>(0, 0, 2)}) {
    const Vec<3> target = eye - Vec<3>(0, 0, 1);
    const View3D view = seen_from(eye, target, eye.z < 1 ? angle : angle / 2);
    const double half = eye.z < 1 ? 0.5 : std::tan(angle / 4);
    EXPECT_NEAR(view.to_page(target + Vec<3>(0, half, 0)).y, kProjectionPanel.lo.y + 6, 1e-6)
        << "the camera's angle is from bottom to top";
  }
}

TEST(View3D, AFoolishCameraIsReplaced) {
  const View3D own(kCube, std::nullopt, kProjectionPanel);
  const double nan = std::nan("");
  for (const Camera& camera :
       {Camera{{nan, 0, 0}, {0, 0, 0}, 0.7}, Camera{{1, 2, 3}, {1, 2, 3}, 0.7},
        Camera{{1e308 * 10, 0, 0}, {0, 0, 0}, 0.7}})
    EXPECT_EQ(View3D(kCube, camera, kProjectionPanel).to_page({0, 0, 0}), own.to_page({0, 0, 0}));
  EXPECT_GT(own.eye().y, 0) << "the default looks from above";
  EXPECT_GT(own.eye().x, 0) << "from the right";
  EXPECT_GT(own.eye().z, 0) << "from the front";
  const View3D down = seen_from({0, 9, 0}, {0, 0, 0});
  EXPECT_GT(down.to_page({0, 0, 1}).y, down.to_page({0, 0, -1}).y)
      << "from straight above, the front is at the bottom";
}

// The tangents from the eye touch a ball on the axis where the angle's sine is r / d.
TEST(View3D, ABallsOutlineIsWhereTangentsTouch) {
  const View3D view = seen_from({0, 0, 5}, {0, 0, 0});
  const double r = 0.8, d = 5;
  const double expected = view.scale_at({0, 0, 4}) * r / std::sqrt(d * d - r * r);  // depth 1
  const Outline rim = view.ball_cap({0, 0, 0}, r, {0, 1, 0}, -1);
  ASSERT_GE(rim.size(), 32u);
  for (const Vec<2>& p : rim) EXPECT_NEAR(glm::length(p - view.to_page({0, 0, 0})), expected, 1e-9);
  EXPECT_TRUE(view.ball_cap({0, 0, 4.5}, r, {0, 1, 0}, -1).empty()) << "the eye is in the ball";
}

TEST(View3D, ACapLiesInItsBallsOutline) {
  const View3D view = seen_from({3, 2, 4}, {0, 0, 0});
  const Box<2> whole = box_of(view.ball_cap({0.2, 0, 0}, 0.5, view.light(), -1));
  double last = 1e9;
  for (const double cosine : {0.0, 0.3, 0.6, 0.9}) {
    const Box<2> cap = box_of(view.ball_cap({0.2, 0, 0}, 0.5, view.light(), cosine));
    EXPECT_TRUE(holds(shrunk(whole, -1.5), cap)) << "light leaks out of the ball";
    EXPECT_LE(cap.size().x * cap.size().y, last * 1.0001) << "a smaller cap looks larger";
    last = cap.size().x * cap.size().y;
  }
}

TEST(View3D, NothingBehindTheEyeIsShown) {
  const View3D view = seen_from({0, 0, 0.5}, {0, 0, -1});
  EXPECT_FALSE(view.segment({0, 0, 0.6}, {1, 1, 3})) << "a line behind the eye";
  EXPECT_TRUE(view.polygon({{0, 0, 1}, {1, 0, 1}, {1, 1, 1}}).empty()) << "a face behind the eye";
  const auto line = view.segment({0, -0.2, -1}, {0, -0.2, 5});
  ASSERT_TRUE(line) << "half of it is in front";
  EXPECT_TRUE(contains(shrunk(kProjectionPanel, -1e-6), line->first));
  EXPECT_TRUE(contains(shrunk(kProjectionPanel, -1e-6), line->second))
      << "cut at the panel, not wrapped";
  EXPECT_GT(line->second.y, line->first.y) << "it runs towards the viewer's feet";
  const Outline face = view.polygon({{-9, -1, -9}, {9, -1, -9}, {9, -1, 9}, {-9, -1, 9}});
  ASSERT_GE(face.size(), 3u);
  EXPECT_TRUE(finite(face)) << "the floor passes under the eye";
}

TEST(Outline, HullsAndCovers) {
  Random random(9);
  for (int round = 0; round < 100; ++round) {
    Outline points;
    for (int i = 0; i < 12; ++i)
      points.emplace_back(double(random.whole(0, 5)), double(random.whole(0, 5)));
    const Outline hull = hull_of(points);
    if (hull.size() < 3) continue;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Vec<2> a = hull[i], along = hull[(i + 1) % hull.size()] - a;
      for (const Vec<2>& p : points)
        EXPECT_GE(along.x * (p.y - a.y) - along.y * (p.x - a.x), 0) << "a point is outside";
    }
  }
  const Outline square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  EXPECT_TRUE(cover_each_other(square, {{1, 1}, {3, 1}, {3, 3}}));
  EXPECT_FALSE(cover_each_other(square, {{2, 0}, {3, 0}, {3, 2}})) << "they only touch";
  EXPECT_TRUE(cover_each_other(square, {{-1, 1}, {3, 1.5}})) << "a line across";
  EXPECT_FALSE(cover_each_other(square, {{1.5, 4}, {4, 1.5}})) << "their boxes meet, they do not";
}

}  // namespace
}  // namespace lantern::draw
