// Joints at their limits: heavy ends, stiff springs, what cannot be met, contacts that come and go.
#include <cmath>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "jointed_scene.hpp"

namespace lantern::physics {
namespace {

constexpr Integrator kMethods[] = {Integrator::semi_implicit_euler, Integrator::velocity_verlet,
                                   Integrator::runge_kutta_4, Integrator::implicit_midpoint,
                                   Integrator::implicit_euler};

// What a world does in so many steps.
struct Course {
  double most_gained = 0;  // energy
  double kinetic = 0;      // at most
  double gap = 0;
};

template <int D>
Course follow(World<D>& world, int steps, double h = kStep) {
  Course course;
  const double before = total_energy(world);
  for (int i = 0; i < steps; ++i) {
    world.step(h);
    const Energy now = energy<D>(world.bodies(), world.forces());
    course.most_gained = std::max(course.most_gained, now.total() - before);
    course.kinetic = std::max(course.kinetic, now.kinetic());
    course.gap = std::max(course.gap, widest_gap(world));
  }
  return course;
}

TEST(JointExtremes, AMillionTimesAsHeavyAnEndHangs) {
  for (const Integrator method : {Integrator::velocity_verlet, Integrator::runge_kutta_4,
                                  Integrator::implicit_midpoint, Integrator::implicit_euler}) {
    World<2> world = planks(method, 6, 1e6);
    const Course course = follow(world, 30);
    EXPECT_LE(course.gap, 1e-11) << to_string(method);
    EXPECT_LE(course.most_gained, 1e-4 * course.kinetic) << to_string(method);
  }
}

TEST(JointExtremes, StiffSpringsAlongTenPinsGiveNoEnergy) {
  for (const Integrator method : {Integrator::implicit_midpoint, Integrator::implicit_euler}) {
    World<2> world = planks(method, 10);
    for (BodyId i = 1; i <= 10; ++i) {
      Spring<2> spring{.a = i - 1, .b = i, .at_a = {i > 1 ? -1 : 0, 0}, .at_b = {1, 0}};
      spring.rest_length = i > 1 ? 3.9 : 1.9;  // the pins stretch them
      spring.stiffness = 1e9;
      world.add_spring(spring);
    }
    const Course course = follow(world, 12);
    EXPECT_LE(course.gap, 1e-11) << to_string(method);
    EXPECT_LE(course.most_gained, 1e-3 * course.kinetic) << to_string(method);
  }
}

TEST(JointExtremes, EnergyStaysBounded) {
  for (const Integrator method : kMethods) {
    World<2> world = planks(method, 2);
    const Course course = follow(world, 1000, 0.004);
    const double most = 1e-4;
    EXPECT_LE(course.most_gained, most * course.kinetic) << to_string(method);
    EXPECT_LE(course.gap, 1e-11) << to_string(method);
  }
  World<2> world = planks(Integrator::velocity_verlet, 2);
  follow(world, 2000, 0.004);
  EXPECT_NEAR(total_energy(world), 0, 0.05);
}

// Two pins between the same two planks say the same more than once.
TEST(JointExtremes, AnOverDeterminedLoopHolds) {
  for (const Integrator method : kMethods) {
    World<2> world = planks(method, 2);
    pin<2>(world, 1, 2, {1, 0.1}, {-1, 0.1});
    const Course course = follow(world, 120);
    EXPECT_LE(course.gap, 1e-9) << to_string(method);
    EXPECT_LE(course.most_gained, 0.02 * course.kinetic) << to_string(method);
  }
}

TEST(JointExtremes, WhatCannotBeMetIsSharedAndStandsStill) {
  World<2> world(jointed<2>(Integrator::velocity_verlet));
  world.add(fixed_at<2>({0, 0}));
  world.add(fixed_at<2>({3, 0}));
  world.add(plank_at<2>({1, 0}, {1, 0.1}));
  pin<2>(world, 0, 2, {0, 0}, {-1, 0});
  pin<2>(world, 1, 2, {0, 0}, {1, 0});
  const Course course = follow(world, 120);
  EXPECT_LE(course.kinetic, 1e-6);
  EXPECT_NEAR(widest_gap(world), 0.5, 0.01);
}

TEST(JointExtremes, AJointThatStartsWideOpenIsClosedSlowly) {
  for (const Integrator method : kMethods) {
    World<2> world(jointed<2>(method));
    world.add(fixed_at<2>({0, 0}));
    world.add(plank_at<2>({5, 0}, {1, 0.1}));
    pin<2>(world, 0, 1, {0, 0}, {-1, 0});
    const double before = total_energy(world);
    world.step(kStep);
    EXPECT_LE(glm::length(world.bodies()[1].position - Vec<2>(5, 0)), 0.2) << to_string(method);
    follow(world, 300);
    EXPECT_LE(widest_gap(world), 1e-9) << to_string(method);
    EXPECT_LE(total_energy(world), before + 4 * 9.81) << "is lifted by no more than the gap";
  }
}

// A blow against the joints only takes energy, and the rest goes on as the joints let it.
TEST(JointExtremes, AnImpulseAgainstAPinIsTaken) {
  World<2> world = planks(Integrator::velocity_verlet, 1);
  world.apply_impulse(1, {-5, 0.5}, {1, 0});
  const double before = total_energy(world);
  world.step(kStep);
  EXPECT_LE(total_energy(world), before);
  EXPECT_LE(widest_gap(world), 1e-12);
}

TEST(JointExtremes, ContactsComeAndGo) {
  for (const ContactMethod contacts :
       {ContactMethod::soft, ContactMethod::impulse, ContactMethod::direct}) {
    WorldConfig<2> config = jointed<2>(Integrator::velocity_verlet);
    config.contacts = contacts;
    World<2> world = planks(config, 2);
    Body<2> block = fixed_at<2>({-1.5, -1.5});  // in the way of the second plank
    block.shape = Sphere{0.5};
    block.collides = true;
    block.material.restitution = 0.5;
    world.add(block);
    const Course course = follow(world, 300);
    EXPECT_GT(world.work().contact_points, 0u);
    EXPECT_LE(course.gap, 5e-3) << to_string(contacts);
    EXPECT_LE(course.most_gained, 1e-2 * course.kinetic) << to_string(contacts);
  }
}

// A ball of 31 kg on planks of 1.1 kg that are pinned from bank to bank.
double gap_of_bridge(ContactMethod contacts, int iterations) {
  WorldConfig<2> config = jointed<2>(Integrator::semi_implicit_euler);
  config.contacts = contacts;
  config.iterations = iterations;
  World<2> world(config);
  world.add(fixed_at<2>({-1, 0}));
  world.add(fixed_at<2>({11, 0}));
  for (BodyId i = 0; i < 6; ++i) {
    world.add(plank_at<2>({2.0 * i, 0}, {0.95, 0.15}, 1.14));
    pin<2>(world, i > 0 ? i + 1 : 0, i + 2, {i > 0 ? 1 : 0, 0}, {-1, 0});
  }
  pin<2>(world, 1, 7, {0, 0}, {1, 0});
  Body<2> ball = ball_at<2>({4.2, 1.5}, {0, -6}, 1);
  ball.density = 10;
  world.add(ball);
  return follow(world, 40, 0.01).gap;
}

TEST(JointExtremes, ABridgeHoldsAHeavyBall) {
  constexpr double kPlank = 1.9;
  EXPECT_LE(gap_of_bridge(ContactMethod::soft, 10), 0.01 * kPlank);
  EXPECT_LE(gap_of_bridge(ContactMethod::direct, 10), 0.01 * kPlank);
  const double few = gap_of_bridge(ContactMethod::impulse, 10);
  EXPECT_LE(few, 0.01 * kPlank);
  for (const int iterations : {100, 1000})
    EXPECT_LE(gap_of_bridge(ContactMethod::impulse, iterations), 2 * few) << iterations;
}

// A bridge of unit planks of 1 kg, an arc that hangs by `slack` radians at its ends, under a load.
template <int D>
double gap_under_load(ContactMethod contacts, Integrator integrator, double slack, double ratio) {
  WorldConfig<D> config = jointed<D>(integrator);
  config.contacts = contacts;
  World<D> world(config);
  constexpr int kPlanks = 8;
  Vec<D> end(0.0);
  world.add(fixed_at<D>(end));
  for (int i = 0; i < kPlanks; ++i) {
    const double angle = slack * (2 * (i + 0.5) / kPlanks - 1);
    const Vec<D> way = along<D>(std::cos(angle), std::sin(angle));
    Vec<D> half(0.3);
    half.x = 0.45;
    half.y = 0.05;
    Body<D> plank = plank_at<D>(end + way / 2.0, half);
    if constexpr (D == 2)
      plank.orientation.angle = angle;
    else
      plank.orientation.q = glm::angleAxis(angle, Vec<3>(0, 0, 1));
    const BodyId id = world.add(plank);
    pin<D>(world, id - 1, id, i > 0 ? along<D>(0.5) : Vec<D>(0.0), along<D>(-0.5));
    end += way;
  }
  const BodyId bank = world.add(fixed_at<D>(end));
  pin<D>(world, bank - 1, bank, along<D>(0.5), Vec<D>(0.0));
  Vec<D> half(0.5);
  half.x = 0.9;
  const double middle = -end.x / 2 * std::tan(slack / 2);  // of the arc
  world.add(plank_at<D>(along<D>(end.x / 2, middle + 0.6 + slack * 0.2), half, ratio));
  return follow(world, 40, 0.01).gap;
}

template <int D>
void expect_pins_hold() {
  Random random(D);
  for (const ContactMethod contacts :
       {ContactMethod::impulse, ContactMethod::soft, ContactMethod::direct})
    for (const Integrator integrator :
         {Integrator::semi_implicit_euler, Integrator::velocity_verlet}) {
      const double ratio = std::pow(10, random.between(0.5, 1.5)), slack = random.between(0.3, 0.6);
      EXPECT_LE(gap_under_load<D>(contacts, integrator, slack, ratio), 1e-5)
          << D << "D, " << to_string(contacts) << ", " << ratio << " on " << slack;
    }
  const auto taut = [](ContactMethod contacts, double ratio) {
    return gap_under_load<D>(contacts, Integrator::semi_implicit_euler, 0, ratio);
  };
  EXPECT_LE(taut(ContactMethod::impulse, random.between(50, 100)), 3e-5);
  EXPECT_LE(taut(ContactMethod::soft, random.between(200, 500)), 1e-5);
  EXPECT_LE(taut(ContactMethod::direct, random.between(20, 40)), 1e-3);
}

TEST(JointExtremes, PinsHoldUnderLoad) {
  expect_pins_hold<2>();
  expect_pins_hold<3>();
}

}  // namespace
}  // namespace lantern::physics
