// Impacts that are located in time, against closed forms.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "physics/body.hpp"
#include "physics/forces.hpp"
#include "physics/impact/time_of_impact.hpp"
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

Rotation<2> any_turn(Random& random, Rotation<2>) { return {random.between(-3, 3)}; }
Rotation<3> any_turn(Random& random, Rotation<3> r) {
  return turned(r, {random.between(-2, 2), random.between(-2, 2), random.between(-2, 2)});
}
template <int D>
Vec<D> any_vec(Random& random, double most) {
  Vec<D> v;
  for (int i = 0; i < D; ++i) v[i] = random.between(-most, most);
  return v;
}

// Boxes that fly about between walls, all of them elastic.
template <int D>
double lost_by_elastic_boxes(double g, int boxes, int steps) {
  WorldConfig<D> config;
  config.gravity = up<D>(-g);
  config.integrator = Integrator::velocity_verlet;
  World<D> world(config);
  const double wall = D == 2 ? 4 : 2.4;
  for (int i = 0; i < D; ++i)
    for (const double side : {1.0, -1.0}) {
      Body<D> body = floor_at<D>(0, 0);
      Vec<D> normal(0.0);
      normal[i] = side;
      body.shape = HalfSpace<D>{normal};
      body.position = normal * -wall;
      body.material.restitution = 1;
      world.add(body);
    }
  Random random(7);
  const int row = D == 2 ? 5 : 3;
  for (int i = 0; i < boxes; ++i) {
    Vec<D> at(0.0), half(0.0);
    for (int k = 0, rest = i; k < D; ++k, rest /= row) {
      at[k] = (rest % row + 0.5) * 2 * wall / row - wall;
      half[k] = random.between(0.2, 0.45);
    }
    Body<D> body = box_at<D>(at);
    body.shape = OrientedBox<D>{half};
    body.orientation = any_turn(random, Rotation<D>{});
    body.velocity = any_vec<D>(random, 3);
    body.material = {1, 0};
    world.add(body);
  }
  const auto height = [&] {  // of the energy, above the floor
    double energy_there = energy<D>(world.bodies(), world.forces()).total();
    for (const Body<D>& body : world.bodies())
      if (body.kind == BodyKind::dynamic_body) energy_there += g * wall / body.inverse_mass;
    return energy_there;
  };
  const double before = height();
  for (int i = 0; i < steps; ++i) world.step(kStep);
  EXPECT_GT(world.work().impacts_located, static_cast<std::uint64_t>(boxes));
  return 1 - height() / before;
}

TEST(Impacts, ElasticBoxesKeepTheirEnergy) {
  for (const double g : {0.0, 10.0}) {
    EXPECT_NEAR(lost_by_elastic_boxes<2>(g, 20, 150), 0, 1e-4) << "2D, gravity " << g;
    EXPECT_NEAR(lost_by_elastic_boxes<3>(g, 12, 60), 0, 1e-4) << "3D, gravity " << g;
  }
}

// A block that lies on the floor and turns: one end comes down, the other parts, until the first is
// struck, which brings it down, too.
template <int D>
void expect_blow_at_both_ends(std::uint64_t seed) {
  Random random(seed);
  for (int round = 0; round < 50; ++round) {
    WorldConfig<D> config;
    config.contacts = ContactMethod::soft;
    World<D> world(config);
    Body<D> floor = floor_at<D>();
    floor.material = {1, 0};
    world.add(floor);
    Body<D> block = box_at<D>(Vec<D>(0.0));
    Vec<D> half(random.between(0.1, 0.5));
    half.x = 1;
    block.shape = OrientedBox<D>{half};
    block.material = {1, 0};
    block.position.y = half.y;
    block.velocity.y = -random.between(0.1, 10);
    Spin<D> spin(0.0);
    spin_component(spin, D == 2 ? 0 : 2) = -block.velocity.y * random.between(1.01, 1.3);
    world.add(block, spin);
    const double before = energy<D>(world.bodies(), world.forces()).kinetic();
    world.step(1.0 / 60);
    EXPECT_GT(world.work().impacts_located, 0u);
    EXPECT_NEAR(energy<D>(world.bodies(), world.forces()).kinetic() / before, 1, 1e-12) << round;
  }
}

TEST(Impacts, ABlowAtBothEndsMakesNoEnergy) {
  expect_blow_at_both_ends<2>(1);
  expect_blow_at_both_ends<3>(2);
}

template <int D>
double gap_of(const Manifold<D>& manifold) {
  double least = HUGE_VAL;
  for (const ManifoldPoint<D>& p : manifold.points()) least = std::min(least, p.separation);
  return least;
}

// Nothing touches within the time that is said to be sure.
template <int D>
void expect_sure_advances(std::uint64_t seed) {
  Random random(seed);
  int useful = 0;
  for (int round = 0; round < 200; ++round) {
    World<D> world;
    for (int i = 0; i < 2; ++i) {
      Body<D> body = box_at<D>(any_vec<D>(random, 1.2));
      Vec<D> half;
      for (int k = 0; k < D; ++k) half[k] = std::exp(random.between(-4, 0));
      body.shape = OrientedBox<D>{half};
      body.orientation = any_turn(random, Rotation<D>{});
      body.velocity = any_vec<D>(random, 3);
      const BodyId id = world.add(body);
      Spin<D> spin(0.0);
      for (int k = 0; k < (D == 2 ? 1 : 3); ++k) spin_component(spin, k) = random.between(-9, 9);
      world.set_angular_velocity(id, spin);
    }
    const Body<D>&a = world.bodies()[0], &b = world.bodies()[1];
    const auto seen = collide(placed(a), placed(b), 10.0);
    if (!seen || gap_of(*seen) <= 1e-9) continue;
    const double sure = sure_advance(flying<D>({&a, a.velocity}), flying<D>({&b, b.velocity}),
                                     seen->normal, 1e-9, 0.5);
    ASSERT_GE(sure, 0);
    useful += sure > 1e-3;
    for (const double share : {0.25, 0.5, 0.75, 1.0}) {
      Body<D> later_a = a, later_b = b;
      for (Body<D>* body : {&later_a, &later_b}) {
        const double t = share * sure;
        body->position += t * body->velocity;
        turn_freely(*body, t, RotationMethod::splitting_4);
        EXPECT_NEAR(fastest_spin(*body) / fastest_spin(body == &later_a ? a : b), 1, 1e-3);
      }
      const auto met = collide(placed(later_a), placed(later_b), 10.0);
      ASSERT_TRUE(!met || gap_of(*met) > -1e-6) << "round " << round;
    }
  }
  EXPECT_GT(useful, 60);
}

TEST(Impacts, WhatIsSaidToBeApartIsApart) {
  expect_sure_advances<2>(1);
  expect_sure_advances<3>(2);
}

}  // namespace
}  // namespace lantern::physics
