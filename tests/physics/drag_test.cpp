// Drag of any strength: it slows bodies and never turns them round.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "geometry/random_vec.hpp"
#include "jointed_scene.hpp"

namespace lantern::physics {
namespace {

constexpr std::array kMonotone = {Integrator::velocity_verlet, Integrator::implicit_midpoint,
                                  Integrator::implicit_euler};

template <int D>
World<D> space(Integrator integrator, const Vec<D>& gravity = Vec<D>(0.0)) {
  WorldConfig<D> config = jointed<D>(integrator);
  config.gravity = gravity;
  return World<D>(config);
}

template <int D>
Spin<D> any_turning(Random& random) {
  Spin<D> spin(0.0);
  for (int i = 0; i < (D == 2 ? 1 : 3); ++i) spin_component(spin, i) = random.between(-1, 1);
  return spin;
}

template <int D>
Body<D> any_box(Random& random) {
  Body<D> box =
      plank_at<D>(Vec<D>(0.0), random_point<D>(random, 0.1, 1.0), std::exp(random.between(-3, 3)));
  if constexpr (D == 3) box.orientation = turned(box.orientation, any_turning<3>(random) * 3.0);
  return box;
}

// From parts of a velocity that a step hardly takes to some that it takes a million times.
double any_part(Random& random) { return std::exp(random.between(-3, 14)); }

// Thrown, without any force: it slows down, on a straight way of m v / c.
template <int D>
void expect_stops(Integrator integrator, Random& random) {
  World<D> world = space<D>(integrator);
  Body<D> box = any_box<D>(random);
  const double h = random.between(1e-3, 0.1), z = any_part(random);
  box.linear_drag = z * box.mass / h;
  box.velocity = random_direction<D>(random) * 7.0;
  const Vec<D> way = box.velocity * (box.mass / box.linear_drag);
  const BodyId id = world.add(box);
  const Vec<D> ahead = box.velocity / glm::length(box.velocity);
  double last = 7;
  for (int i = 0; i < 400; ++i) {
    world.step(h);
    const double speed = glm::dot(world.find(id)->velocity, ahead);
    ASSERT_GE(speed, -1e-14) << to_string(integrator) << ", part " << z;
    ASSERT_LE(speed, last + 1e-14) << to_string(integrator) << ", part " << z;
    last = speed;
  }
  if (integrator != Integrator::implicit_euler && z > 0.1) {
    EXPECT_LT(glm::length(world.find(id)->position - way), 1e-12 * glm::length(way) + 1e-14 * h)
        << z;
  }
}

TEST(Drag, StopsWhatIsThrownAndNeverTurnsItRound) {
  Random random(1);
  for (const Integrator integrator : kMonotone)
    for (int round = 0; round < 12; ++round) {
      expect_stops<2>(integrator, random);
      expect_stops<3>(integrator, random);
    }
}

// Falls as fast as drag bears its weight, whatever its speed was.
template <int D>
void expect_terminal(Integrator integrator, Random& random) {
  const Vec<D> gravity = random_direction<D>(random) * 9.81;
  World<D> world = space<D>(integrator, gravity);
  Body<D> box = any_box<D>(random);
  const double h = random.between(1e-3, 0.1), z = any_part(random);
  box.linear_drag = z * box.mass / h;
  box.velocity = random_direction<D>(random) * 7.0;
  const Vec<D> limit = gravity * (box.mass / box.linear_drag);
  const BodyId id = world.add(box);
  for (int i = 0; i < 1000; ++i) world.step(h);
  const Vec<D> from = world.find(id)->position;
  world.step(h);
  EXPECT_LT(glm::length(world.find(id)->velocity - limit), 1e-11 * glm::length(limit) + 1e-14 * h)
      << to_string(integrator) << ", part " << z;
  EXPECT_LT(glm::length(world.find(id)->position - from - limit * h),
            1e-11 * glm::length(limit) * h + 1e-14)
      << to_string(integrator) << ", part " << z;
}

TEST(Drag, EndsInTheVelocityAtWhichItBearsTheForce) {
  Random random(2);
  for (const Integrator integrator : kMonotone)
    for (int round = 0; round < 6; ++round) {
      expect_terminal<2>(integrator, random);
      expect_terminal<3>(integrator, random);
    }
}

template <int D>
void expect_turning_stops(Integrator integrator, Random& random) {
  World<D> world = space<D>(integrator);
  Body<D> box = any_box<D>(random);
  const double h = random.between(1e-3, 0.1), z = any_part(random);
  const BodyId probe = world.add(box);
  box.angular_drag = z / (h * spin_component(world.find(probe)->inverse_inertia, 0));
  const BodyId id = world.add(box);
  const Spin<D> spin = any_turning<D>(random) * std::exp(random.between(-2, 3));
  world.set_angular_velocity(id, spin);
  const Spin<D> start = world.find(id)->angular_momentum;
  for (int i = 0; i < 200; ++i) {
    const Spin<D> before = world.find(id)->angular_momentum;
    world.step(h);
    const Spin<D> after = world.find(id)->angular_momentum;
    const double square = dot(before, before);
    ASSERT_GE(dot(after, before), -1e-14 * dot(start, start))
        << to_string(integrator) << ", part " << z;
    ASSERT_LE(dot(after, after), square + 1e-14 * dot(start, start))
        << to_string(integrator) << ", part " << z;
  }
  if (z > 1) {
    EXPECT_LT(std::sqrt(dot(angular_velocity(*world.find(id)), angular_velocity(*world.find(id)))),
              1e-9 * std::sqrt(dot(spin, spin)))
        << to_string(integrator) << ", part " << z;
  }
}

TEST(Drag, StopsTurningAndNeverTurnsItRound) {
  Random random(3);
  for (const Integrator integrator : kMonotone)
    for (int round = 0; round < 20; ++round) {
      expect_turning_stops<2>(integrator, random);
      expect_turning_stops<3>(integrator, random);
    }
}

// A box of three different inertias, whose drag is another about each axis.
TEST(Drag, OfATumblingBoxIsOfTheOrderOfTheMethod) {
  const auto tumbled = [](Integrator integrator, int steps) {
    World<3> world = space<3>(integrator);
    Body<3> box = plank_at<3>({0, 0, 0}, {1, 0.4, 0.2}, 2);
    box.angular_drag = 0.4;
    const BodyId id = world.add(box);
    world.set_angular_velocity(id, {2, 3, 1});
    for (int i = 0; i < steps; ++i) world.step(1.0 / steps);
    return *world.find(id);
  };
  const Body<3> exact = tumbled(Integrator::velocity_verlet, 16384);
  for (const Integrator integrator : {Integrator::velocity_verlet, Integrator::implicit_midpoint}) {
    const auto error = [&](int steps) {
      const Body<3> body = tumbled(integrator, steps);
      return glm::length(body.angular_momentum - exact.angular_momentum) +
             glm::length(body.orientation.q - exact.orientation.q);
    };
    for (int steps = 40; steps <= 320; steps *= 2)
      EXPECT_NEAR(std::log2(error(steps) / error(2 * steps)), 2, 0.1) << to_string(integrator);
  }
}

// Just below the limit of velocity Verlet, omega h = 2, and far beyond it by the midpoint.
TEST(Drag, LeavesSpringsAsStableAsTheyAre) {
  for (const double z : {0.0, 0.3, 1.0, 1.9, 2.1, 5.0, 100.0, 1e6})
    for (const Integrator integrator :
         {Integrator::velocity_verlet, Integrator::implicit_midpoint}) {
      const double h = 0.01, omega = (integrator == Integrator::velocity_verlet ? 1.98 : 300) / h;
      World<2> world = space<2>(integrator);
      world.add(fixed_at<2>({0, 0}));
      Body<2> bob = ball_at<2>({1, 0});
      bob.mass = 1;
      bob.linear_drag = z / h;
      const BodyId id = world.add(bob);
      world.add_spring({0, id, {0, 0}, {0, 0}, 0, omega * omega, 0});
      const double start = energy<2>(world.bodies(), world.forces()).total();
      for (int i = 0; i < 1200; ++i) world.step(h);
      EXPECT_LT(energy<2>(world.bodies(), world.forces()).total(), 40 * start)
          << to_string(integrator) << ", part " << z;
    }
}

// A plank on a pin, in honey: it only falls, and ends hanging.
template <int D>
void expect_sinks(Integrator integrator, double part) {
  const double h = kStep;
  WorldConfig<D> config = jointed<D>(integrator);
  World<D> world(config);
  world.add(fixed_at<D>(Vec<D>(0.0)));
  Body<D> plank = plank_at<D>(along<D>(1), Vec<D>(0.1) + along<D>(0.9), 2);
  plank.linear_drag = plank.angular_drag = part * plank.mass / h;
  const BodyId id = world.add(plank);
  pin<D>(world, 0, id, Vec<D>(0.0), along<D>(-1));
  double last = energy<D>(world.bodies(), world.forces()).total();
  for (int i = 0; i < 300; ++i) {
    world.step(h);
    ASSERT_LE(world.find(id)->velocity.y, 1e-12) << to_string(integrator) << ", part " << part;
    const double now = energy<D>(world.bodies(), world.forces()).total();
    ASSERT_LE(now, last + 1e-9) << to_string(integrator) << ", part " << part;
    last = now;
  }
  ASSERT_LT(widest_gap(world), 1e-9);
}

TEST(Drag, OfWhatAJointHoldsTurnsNothingRound) {
  for (const double part : {1.0, 3.0, 30.0, 1e3, 1e5})
    for (const Integrator integrator : kMonotone) {
      expect_sinks<2>(integrator, part);
      expect_sinks<3>(integrator, part);
    }
}

}  // namespace
}  // namespace lantern::physics
