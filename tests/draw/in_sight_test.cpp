// Whether a picture shows any body.
#include <gtest/gtest.h>

#include "draw/page.hpp"

namespace lantern::draw {
namespace {

FrameBody ball(const Vec<3>& at, double radius, int dimension) {
  FrameBody body;
  body.shape = Sphere{radius};
  body.position = at;
  const Vec<3> half(radius, radius, dimension == 3 ? radius : 0);
  body.box = Box<3>::around(at, half);
  return body;
}

Frame solid_frame(const Vec<3>& eye, const Vec<3>& target) {
  Frame frame;
  frame.dimension = 3;
  frame.bounds = {Vec<3>(0.0), Vec<3>(4.0)};
  frame.camera = Camera{eye, target};
  frame.bodies = {ball({1, 1, 1}, 0.5, 3)};
  return frame;
}

TEST(InSight, IsWhatTheCameraLooksAt) {
  EXPECT_TRUE(shows_a_body(solid_frame({2, 2, -20}, {2, 2, 2})));
  EXPECT_FALSE(shows_a_body(solid_frame({2, 2, -20}, {2, 2, -40})));
  // Beside the view, from within the world.
  EXPECT_TRUE(shows_a_body(solid_frame({3.5, 3.5, 3.5}, {1, 1, 1})));
  EXPECT_FALSE(shows_a_body(solid_frame({3.5, 3.5, 3.5}, {3.5, 3.5, 0})));
  // The eye is in the body.
  EXPECT_TRUE(shows_a_body(solid_frame({1, 1, 1}, {1, 1, 0})));
}

TEST(InSight, WithoutACameraIsTheWholeWorld) {
  Frame frame = solid_frame({2, 2, -20}, {2, 2, -40});
  frame.camera.reset();
  EXPECT_TRUE(shows_a_body(frame));
  frame.bodies = {ball({400, 1, 1}, 0.5, 3)};
  EXPECT_FALSE(shows_a_body(frame));
}

TEST(InSight, OfAFlatWorldIsWithinItsBounds) {
  Frame frame;
  frame.bounds = {{0, 0, 0}, {16, 9, 0}};
  frame.bodies = {ball({30, 6, 0}, 1, 2)};
  EXPECT_FALSE(shows_a_body(frame));
  frame.bodies.push_back(ball({16.5, 6, 0}, 1, 2));
  EXPECT_TRUE(shows_a_body(frame));
}

TEST(InSight, IsNotTheGround) {
  Frame frame = solid_frame({2, 2, -20}, {2, 2, 2});
  frame.bodies[0].shape = HalfSpace<3>{{0, 1, 0}};
  EXPECT_FALSE(shows_a_body(frame));
}

}  // namespace
}  // namespace lantern::draw
