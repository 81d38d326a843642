// Contacts and joints make no energy: some of the random worlds of `lantern stress`.
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "measure/energy_trial.hpp"

namespace lantern::measure {
namespace {

class RandomWorld : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomWorld, MakesNoEnergy) {
  for (const auto method : {ContactMethod::soft, ContactMethod::impulse, ContactMethod::direct}) {
    const EnergyTrial trial = random_trial(GetParam(), method);
    EXPECT_LE(trial.excess, kEnergyAllowance)
        << to_string(method) << ", " << random_scene_text(GetParam()) << ", at " << trial.time
        << " s " << trial.reason;
  }
}

// Those among the first that are quick.
INSTANTIATE_TEST_SUITE_P(EnergyInvariant, RandomWorld,
                         testing::Values(1, 3, 4, 5, 8, 11, 14, 18, 21, 23, 24, 31, 33, 34, 39, 42,
                                         44, 45, 46, 51, 54, 65, 69, 70));

TEST(EnergyInvariant, ARandomWorldIsTheSameAgain) {
  std::vector<double> first, again;
  for (std::vector<double>* all : {&first, &again})
    random_trial(3, ContactMethod::soft,
                 [&](const EnergyMoment& moment) { all->push_back(moment.energy); });
  EXPECT_GT(first.size(), 30u);
  EXPECT_EQ(first, again);
}

World<2> ball_on_spring(Integrator integrator) {
  World<2> world({.integrator = integrator});
  world.add({.shape = Sphere{0.1}, .kind = BodyKind::static_body});
  world.add({.shape = Sphere{0.1}, .position = {1, 0}, .mass = 1});
  world.add_spring({.b = 1, .stiffness = 25});
  return world;
}

TEST(EnergyInvariant, WhatGainsIsSeen) {
  World<2> wrong = ball_on_spring(Integrator::explicit_euler);
  EXPECT_GT(follow_energy<2>(wrong, 0.1, 3).excess, 0.01);
  World<2> right = ball_on_spring(Integrator::implicit_midpoint);
  EXPECT_LE(follow_energy<2>(right, 0.1, 3).excess, 1e-9);
}

// A force of 3 N over 10 s works 450 J on 1 kg; it is no gain.
TEST(EnergyInvariant, ThePushsWorkIsTakenOff) {
  World<3> world({.integrator = Integrator::velocity_verlet, .contacts = ContactMethod::none});
  world.add({.shape = Sphere{0.5}, .mass = 1});
  world.push(0, {3, 0, 0}, Vec<3>(0.0));
  double least = 0;
  const EnergyTrial trial = follow_energy<3>(world, 0.1, 100, [&](const EnergyMoment& moment) {
    least = std::min(least, moment.excess());
  });
  EXPECT_NEAR(world.bodies()[0].velocity.x, 30, 1e-9);
  EXPECT_LE(trial.excess, 1e-12);
  EXPECT_GE(least, -1e-12);
}

// Two balls of radius 1 whose centres are 1.5 apart, and one that only the first of them could
// touch if nothing held both together.
TEST(EnergyInvariant, OverlapsAreOfPairsThatCollide) {
  World<2> world({.contacts = ContactMethod::soft});
  for (const double x : {0.0, 1.5, -1.0})
    world.add({.shape = Sphere{1}, .position = {x, 0}, .mass = 1});
  world.add_joint({.kind = JointKind::distance, .b = 2, .length = 1});
  EXPECT_DOUBLE_EQ(overlap_of(world), 0.5);
  world.remove(2);
  EXPECT_DOUBLE_EQ(overlap_of(world), 0.5);
}

}  // namespace
}  // namespace lantern::measure
