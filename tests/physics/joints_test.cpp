// Rods, hinges and springs.
#include <numbers>

#include <gtest/gtest.h>

#include "physics/joint.hpp"
#include "world_scene.hpp"

namespace lantern::physics {
namespace {

template <int D>
Body<D> anchor() {
  Body<D> body = ball_at<D>(Vec<D>(0.0), Vec<D>(0.0), 0.1);
  body.name = "anchor";
  body.kind = BodyKind::static_body;
  return body;
}

// Ten links side by side that fall into a hanging chain, the last one heavy.
template <int D>
World<D> chain(JointKind kind, double ratio) {
  WorldConfig<D> config = falling<D>();
  config.sub_steps = 16;
  config.may_sleep = false;
  World<D> world(config);
  world.add(anchor<D>());
  for (int i = 0; i < 10; ++i) {
    Body<D> link = ball_at<D>(along<D>(i + 1), Vec<D>(0.0), 0.2);
    link.mass = i == 9 ? ratio : 1;
    world.add(link);
    Joint<D> joint;
    joint.kind = kind;
    joint.a = static_cast<BodyId>(i);
    joint.b = static_cast<BodyId>(i + 1);
    joint.length = 1;
    if (kind == JointKind::pin) joint.at_b = along<D>(-1);
    world.add_joint(joint);
  }
  return world;
}

template <int D>
void expect_holds(JointKind kind, double ratio) {
  World<D> world = chain<D>(kind, ratio);
  for (int i = 0; i < 60; ++i) {
    world.step(kStep);
    ASSERT_LE(widest_gap(world), 1e-3) << D << "D, ratio " << ratio << ", step " << i;
  }
}

TEST(Joints, AChainHoldsAHeavyEnd) {
  for (const JointKind kind : {JointKind::distance, JointKind::pin}) {
    expect_holds<2>(kind, 1000);
    expect_holds<3>(kind, 1000);
    expect_holds<2>(kind, 1e4);
  }
}

// T / T0 = 2 K(sin(45 degrees)) / pi = 1.18034 for a swing from 90 degrees.
TEST(Joints, APendulumKeepsItsPeriod) {
  WorldConfig<2> config = falling<2>();
  config.integrator = Integrator::velocity_verlet;
  config.sub_steps = 32;
  World<2> world(config);
  world.add(anchor<2>());
  Body<2> bob = ball_at<2>({1, 0}, {0, 0}, 0.1);
  bob.may_turn = false;
  world.add(bob);
  Joint<2> rod;
  rod.kind = JointKind::distance;
  rod.b = 1;
  rod.length = 1;
  world.add_joint(rod);
  const double period = 1.1803405990 * 2 * std::numbers::pi / std::sqrt(10.0);
  const double h = period / 4 / 60;
  run(world, period / 4, h);
  EXPECT_NEAR(world.bodies()[1].position.x, 0, 2e-3) << "is not at its lowest point in time";
  EXPECT_NEAR(glm::length(world.bodies()[1].velocity), std::sqrt(20.0), 2e-3);
}

TEST(Joints, BodiesThatAreJoinedDoNotCollide) {
  for (const bool collide : {false, true}) {
    World<2> world((WorldConfig<2>()));
    world.add(ball_at<2>({0, 0}));
    world.add(ball_at<2>({0.5, 0}));
    Joint<2> rod;
    rod.kind = JointKind::distance;
    rod.b = 1;
    rod.length = 0.5;
    rod.collide = collide;
    world.add_joint(rod);
    world.step(kStep);
    EXPECT_EQ(world.contacts().size(), collide ? 1u : 0u);
  }
}

TEST(Joints, KeepMomentum) {
  World<3> world((WorldConfig<3>()));
  world.add(ball_at<3>(along<3>(0), along<3>(0, 2)));
  world.add(ball_at<3>(along<3>(2), along<3>(1)));
  Joint<3> pin;
  pin.b = 1;
  pin.at_a = along<3>(1);
  pin.at_b = along<3>(-1);
  world.add_joint(pin);
  run(world, 2);
  const Vec<3> sum = world.bodies()[0].velocity + world.bodies()[1].velocity;
  EXPECT_LE(glm::length(sum - along<3>(1, 2)), 1e-12);
}

TEST(Joints, SpringsPullAcrossTheWorld) {
  WorldConfig<2> config;
  config.integrator = Integrator::velocity_verlet;
  World<2> world(config);
  world.add(anchor<2>());
  Body<2> bob = ball_at<2>({3, 0}, {0, 0}, 0.1);
  bob.mass = 2;
  world.add(bob);
  Spring<2> spring;
  spring.b = 1;
  spring.rest_length = 2;
  spring.stiffness = 8;
  const SpringId id = world.add_spring(spring);
  run(world, std::numbers::pi / 4, std::numbers::pi / 4 / 1000);  // a quarter swing
  EXPECT_NEAR(world.bodies()[1].position.x, 2, 1e-5);
  EXPECT_NEAR(world.bodies()[1].velocity.x, -2, 1e-5);
  world.remove_spring(id);
  const double before = world.bodies()[1].velocity.x;
  run(world, 0.5);
  EXPECT_EQ(world.bodies()[1].velocity.x, before) << "pulls though it was removed";
}

}  // namespace
}  // namespace lantern::physics
