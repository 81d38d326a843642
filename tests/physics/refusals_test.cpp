// Bad values are refused where they enter, by name, and change nothing.

#include <gtest/gtest.h>

#include "geometry/not_finite.hpp"
#include "world_scene.hpp"

namespace lantern::physics {
namespace {

template <class Action>
void expect_refused(World<2>& world, const std::string& part, Action&& action) {
  const std::uint64_t before = world.hash();
  try {
    action();
    FAIL() << "not refused: " << part;
  } catch (const Refused& refused) {
    EXPECT_NE(std::string(refused.what()).find(part), std::string::npos) << refused.what();
  }
  EXPECT_EQ(world.hash(), before) << "a refusal left the world changed: " << part;
}

World<2> resting() {
  World<2> world(falling<2>());
  world.add(floor_at<2>());
  world.add(box_at<2>(up<2>(0.5)));
  world.add(box_at<2>(up<2>(1.5)));
  run(world, 0.1);
  return world;
}

TEST(Refusals, OfBodiesNameTheField) {
  World<2> world = resting();
  const auto add = [&](const char* field, auto&& spoil) {
    for (const double bad : {-1.0, kNan, kInfinity}) {
      Body<2> body = box_at<2>({5, 5});
      body.name = "ghost";
      spoil(body, bad);
      expect_refused(world, std::string("'ghost': ") + field, [&] { world.add(body); });
    }
  };
  add("mass", [](Body<2>& b, double bad) { b.mass = bad; });
  add("density", [](Body<2>& b, double bad) { b.density = bad; });
  add("restitution", [](Body<2>& b, double bad) { b.material.restitution = bad; });
  add("friction", [](Body<2>& b, double bad) { b.material.friction = bad; });
  add("linear_drag", [](Body<2>& b, double bad) { b.linear_drag = bad; });
  add("angular_drag", [](Body<2>& b, double bad) { b.angular_drag = bad; });
  add("half_size", [](Body<2>& b, double bad) { b.shape = OrientedBox<2>{{bad, 1}}; });
  add("half_length", [](Body<2>& b, double bad) { b.shape = Capsule{1, bad}; });
  add("normal", [](Body<2>& b, double bad) {
    b.shape = HalfSpace<2>{{0, 2 * bad}};
    b.kind = BodyKind::static_body;
  });
  for (const double bad : {kNan, kInfinity}) {
    Body<2> body = box_at<2>({5, 5});
    body.angular_momentum = bad;
    expect_refused(world, "angular_momentum", [&] { world.add(body); });
    body = box_at<2>({5, 5});
    body.orientation.angle = bad;
    expect_refused(world, "orientation", [&] { world.add(body); });
  }
}

TEST(Refusals, OfDynamicBodiesWithoutMass) {
  World<2> world = resting();
  Body<2> point = ball_at<2>({5, 5}, {0, 0}, 0);
  expect_refused(world, "mass", [&] { world.add(point); });
  point.mass = 2;
  EXPECT_NO_THROW(world.add(point)) << "with a mass it may be";
  point.mass = 0;
  point.kind = BodyKind::static_body;
  EXPECT_NO_THROW(world.add(point)) << "static bodies need none";
  Body<2> floor = floor_at<2>();
  floor.kind = BodyKind::dynamic_body;
  expect_refused(world, "half-space", [&] { world.add(floor); });
}

TEST(Refusals, OfScripts) {
  World<2> world = resting();
  for (const double bad : {kNan, kInfinity}) {
    expect_refused(world, "velocity", [&] { world.set_velocity(1, {bad, 0}); });
    expect_refused(world, "velocity", [&] { world.set_angular_velocity(1, bad); });
    expect_refused(world, "position", [&] { world.place(1, {0, bad}, {0, 0}); });
    expect_refused(world, "orientation", [&] { world.place(1, {0, 0}, {0, 0}, Rotation<2>{bad}); });
    expect_refused(world, "impulse", [&] { world.apply_impulse(1, {bad, 0}, {0, 0}); });
    expect_refused(world, "force", [&] { world.push(1, {bad, 0}, {0, 0}); });
    expect_refused(world, "seconds", [&] { world.push(1, {1, 0}, {0, 0}, bad); });
    expect_refused(world, "gravity", [&] { world.set_gravity({0, bad}); });
    expect_refused(world, "time step", [&] { world.step(bad); });
  }
  expect_refused(world, "no body 7", [&] { world.set_velocity(7, {0, 0}); });
  expect_refused(world, "no body 7", [&] { world.set_angular_velocity(7, 0); });
  expect_refused(world, "no body 7", [&] { world.apply_impulse(7, {0, 0}, {0, 0}); });
  expect_refused(world, "no body 7", [&] { world.push(7, {0, 0}, {0, 0}); });
  expect_refused(world, "no body 7", [&] { world.sleep(7); });
  expect_refused(world, "no body 7", [&] { world.wake(7); });
  const BodyId far = world.add(ball_at<2>({-1.5e308, 0}));
  expect_refused(world, "lever", [&] { world.push(far, {1, 0}, {1.5e308, 0}); });
  for (const double bad : {kNan, kInfinity})
    expect_refused(world, "point", [&] { world.push(1, {1, 0}, {bad, 0}); });
}

TEST(Refusals, OfSpringsAndJoints) {
  World<2> world = resting();
  Spring<2> spring;
  spring.b = 7;
  expect_refused(world, "7", [&] { world.add_spring(spring); });
  spring.b = 1;
  spring.stiffness = -1;
  expect_refused(world, "stiffness", [&] { world.add_spring(spring); });
  Joint<2> joint;
  joint.b = 7;
  expect_refused(world, "no body 7", [&] { world.add_joint(joint); });
  joint.b = 0;
  expect_refused(world, "itself", [&] { world.add_joint(joint); });
  joint.b = 1;
  joint.kind = JointKind::distance;
  expect_refused(world, "length", [&] { world.add_joint(joint); });
  joint.at_a.x = kNan;
  expect_refused(world, "at_a", [&] { world.add_joint(joint); });
}

TEST(Refusals, OfConfigs) {
  WorldConfig<2> config;
  config.sub_steps = 0;
  EXPECT_THROW(World<2>{config}, Refused);
  config = {};
  config.gravity = {kNan, 0};
  EXPECT_THROW(World<2>{config}, Refused);
}

TEST(Refusals, AnOverflowNamesBodyAndStepAndRollsBack) {
  World<2> world = resting();
  Body<2> fast = ball_at<2>({5, 5}, {1e300, 0});
  fast.name = "fast";
  world.add(fast);
  const std::uint64_t steps = world.work().steps;
  expect_refused(world, "'fast': position overflows in step 7", [&] { world.step(1e10); });
  EXPECT_EQ(world.work().steps, steps);
}

}  // namespace
}  // namespace lantern::physics
