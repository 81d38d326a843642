// Impacts that are located in time, against closed forms.
#include <numbers>

#include <gtest/gtest.h>

#include "world_scene.hpp"

namespace lantern::physics {
namespace {

WorldConfig<2> exact(double g) {
  WorldConfig<2> config;
  config.gravity = {0, -g};
  config.integrator = Integrator::velocity_verlet;
  return config;
}

TEST(Impacts, AnElasticBallKeepsItsEnergyAtAnyStep) {
  for (const double h : {1.0 / 60, 0.01, 0.3, 1.0}) {
    World<2> world(exact(10));
    world.add(floor_at<2>());
    Body<2> ball = ball_at<2>(up<2>(2));
    ball.material.restitution = 1;
    world.add(ball);
    const auto energy = [&] {
      const Body<2>& b = world.bodies()[1];
      return 10 * (b.position.y - 0.5) + glm::dot(b.velocity, b.velocity) / 2;
    };
    const double before = energy();
    for (double t = 0; t < 20; t += h) {
      world.step(h);
      ASSERT_NEAR(energy() / before, 1, 1e-12) << "step " << h << " at " << t;
    }
    EXPECT_GE(world.work().impacts_located, 18u);
  }
}

// Falls from height s: first impact after sqrt(2 s / g), the n-th flight takes 2 e^n v / g, and
// after t = sqrt(2 s / g) (1 + e) / (1 - e) all is over.
TEST(Impacts, ABallComesToRestWhenItShould) {
  for (const double e : {0.3, 0.5, 0.8}) {
    World<2> world(exact(10));
    world.add(floor_at<2>());
    Body<2> ball = ball_at<2>(up<2>(0.5 + 0.8));
    ball.material.restitution = e;
    world.add(ball);
    const double first = std::sqrt(2 * 0.8 / 10), end = first * (1 + e) / (1 - e);
    run(world, first + first * e);  // about the first apex
    const double flown = std::round((first + first * e) / kStep) * kStep - first;
    EXPECT_NEAR(world.bodies()[1].position.y, 0.5 + 4 * e * flown - 5 * flown * flown, 1e-9);
    run(world, end);
    EXPECT_NEAR(world.bodies()[1].position.y, 0.5, 1e-6) << e;
    EXPECT_NEAR(world.bodies()[1].velocity.y, 0, 1e-6) << e;
    EXPECT_LE(world.work().impacts_located, 100u) << "Zeno";
  }
}

// Galperin, "Playing pool with pi", 2003.
TEST(Impacts, TwoBlocksAndAWallCountPi) {
  double ratio = 1, expected = std::numbers::pi;
  for (int k = 0; k <= 3; ++k, ratio *= 100, expected *= 10) {
    World<2> world(exact(0));
    Body<2> wall = floor_at<2>();
    wall.shape = HalfSpace<2>{{1, 0}};
    world.add(wall);
    Body<2> block = box_at<2>({2, 0});
    block.shape = AxisBox<2>{{0.5, 0.5}};
    block.material = {1, 0};
    block.mass = 1;
    world.add(block);
    block.position = {4, 0};
    block.velocity = {-1, 0};
    block.mass = ratio;
    world.add(block);
    run(world, 12);
    EXPECT_EQ(world.work().impacts_located, static_cast<std::uint64_t>(expected)) << "100^" << k;
  }
}

TEST(Impacts, NewtonsCradlePassesTheBlowOn) {
  for (int moving = 1; moving <= 4; ++moving) {
    World<2> world(exact(0));
    for (int i = 0; i < 5; ++i) {
      Body<2> ball = ball_at<2>({i < moving ? i - 1.7 : i, 0}, {i < moving ? 2 : 0, 0});
      ball.material = {1, 0};
      world.add(ball);
    }
    run(world, 1.5);
    for (int i = 0; i < 5; ++i)
      EXPECT_NEAR(world.bodies()[static_cast<std::size_t>(i)].velocity.x, i < 5 - moving ? 0 : 2,
                  1e-12)
          << moving << " came, ball " << i;
  }
}

TEST(Impacts, CentralImpactsFollowTheClosedForm) {
  for (const double e : {0.0, 0.4, 1.0})
    for (const double ratio : {1.0, 1e3, 1e9}) {
      World<3> world((WorldConfig<3>()));
      Body<3> ball = ball_at<3>(along<3>(-2), along<3>(3));
      ball.material = {e, 0};
      ball.mass = ratio;
      world.add(ball);
      ball.position = along<3>(0.3);
      ball.velocity = along<3>(-1);
      ball.mass = 1;
      world.add(ball);
      run(world, 1);
      const double common = (3 * ratio - 1) / (ratio + 1);
      EXPECT_NEAR(world.bodies()[0].velocity.x, common - e * 4 / (ratio + 1), 1e-12);
      EXPECT_NEAR(world.bodies()[1].velocity.x, common + e * 4 * ratio / (ratio + 1), 1e-12);
    }
}

TEST(Impacts, FastBodiesDoNotTunnel) {
  for (const double e : {0.0, 0.5})
    for (const double speed : {50.0, 500.0, 5000.0}) {
      WorldConfig<2> config;
      World<2> world(config);
      Body<2> wall = box_at<2>({5, 0});
      wall.shape = AxisBox<2>{{0.01, 5}};
      wall.kind = BodyKind::static_body;
      world.add(wall);
      Body<2> bullet = ball_at<2>({0, 0}, {speed, 0}, 0.05);
      bullet.material.restitution = e;
      world.add(bullet);
      run(world, 0.5);
      EXPECT_LT(world.bodies()[1].position.x, 5) << speed << ", e = " << e;
      EXPECT_NEAR(world.bodies()[1].velocity.x, -e * speed, 1e-9 * speed);
    }
}

// A struck ball flies farther in the rest of the step than it was looked for.
TEST(Impacts, WhatWasStruckDoesNotTunnelEither) {
  World<2> world((WorldConfig<2>()));
  Body<2> ball = ball_at<2>({0, 0}, {300, 0}, 0.1);
  ball.material = {1, 0};
  world.add(ball);
  for (int i = 1; i <= 4; ++i) {
    ball.position = {i * 0.5, 0};
    ball.velocity = {0, 0};
    world.add(ball);
  }
  run(world, 0.2);
  EXPECT_NEAR(world.bodies()[4].velocity.x, 300, 1e-9);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(world.bodies()[i].velocity.x, 0, 1e-9);
}

TEST(Impacts, BilliardsKeepMomentumAndEnergy) {
  World<2> world((WorldConfig<2>()));
  for (int i = 0; i < 4; ++i) {
    Body<2> wall = floor_at<2>();
    const Vec<2> normal = i < 2 ? Vec<2>(i == 0 ? 1 : -1, 0) : Vec<2>(0, i == 2 ? 1 : -1);
    wall.shape = HalfSpace<2>{normal};
    wall.position = normal * -5.0;
    world.add(wall);
  }
  for (int i = 0; i < 16; ++i) {
    Body<2> ball = ball_at<2>({i % 4 * 2.0 - 3, i / 4 * 2.0 - 3}, {i * 0.7 - 5, 3 - i * 0.5}, 0.3);
    ball.material = {1, 0};
    ball.mass = i % 3 == 0 ? 1000 : 1;
    world.add(ball);
  }
  const auto energy = [&] {
    double sum = 0;
    for (const Body<2>& body : world.bodies())
      sum += body.mass * glm::dot(body.velocity, body.velocity);
    return sum;
  };
  const double before = energy();
  run(world, 5);
  EXPECT_GT(world.work().impacts_located, 100u);
  EXPECT_NEAR(energy() / before, 1, 1e-12);
  for (const Body<2>& body : world.bodies())
    if (body.moves()) {
      EXPECT_LE(std::abs(body.position.x), 4.7 + 1e-6);
    }
}

}  // namespace
}  // namespace lantern::physics
