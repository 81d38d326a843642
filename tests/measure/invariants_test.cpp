// What a scene should keep, worked out from states.
#include "measure/invariants.hpp"

#include <gtest/gtest.h>

#include "measure/scenes.hpp"
#include "run/engine.hpp"

namespace lantern::measure {
namespace {

std::vector<BodyState> states_after(const Scenario& scenario, int steps) {
  Work work;
  const auto engine = make_engine(scenario, work);
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) engine->enter(i);
  for (int i = 0; i < steps; ++i) engine->step();
  std::vector<BodyState> states;
  engine->observe(states);
  return states;
}

TEST(Invariants, AreWhatTheFormulasSay) {
  const Scenario scenario = thrown();
  const Invariants invariants(scenario);
  const Kept kept = invariants.of(states_after(scenario, 0));
  EXPECT_DOUBLE_EQ(kept.kinetic_energy, 25);
  EXPECT_DOUBLE_EQ(kept.energy, 25 + 2 * 10 * 2);
  EXPECT_EQ(kept.momentum, Vec<3>(6, 8, 0));
  EXPECT_DOUBLE_EQ(kept.angular_momentum.z, 1 * 8 - 2 * 6);
  EXPECT_TRUE(invariants.keeps_energy());
  EXPECT_FALSE(invariants.keeps_momentum()) << "gravity pulls";
}

TEST(Invariants, DependOnTheScene) {
  EXPECT_TRUE(Invariants(thrown("")).keeps_momentum());
  EXPECT_FALSE(Invariants(thrown("contacts = \"soft\"")).keeps_energy())
      << "bodies are not elastic unless they are told to be";
  Scenario dragged = thrown("");
  dragged.bodies[0].linear_drag = 1;
  EXPECT_FALSE(Invariants(dragged).keeps_energy());
  EXPECT_FALSE(Invariants(dragged).keeps_momentum());
  Scenario pushed = thrown("", "[[step]]\ndo = \"force\"\nbody = \"ball\"\nforce = [1, 0]\n");
  EXPECT_FALSE(Invariants(pushed).keeps_energy());
}

TEST(Invariants, TheMeterTellsTheLargestChange) {
  const Scenario scenario = thrown();
  const Invariants invariants(scenario);
  DriftMeter meter(invariants);
  std::vector<BodyState> states = states_after(scenario, 0);
  meter.look(states);
  const double speed = states[0].velocity.x;
  states[0].velocity.x = 5;  // kinetic energy 25 -> 41
  meter.look(states);
  states[0].velocity.x = speed;
  meter.look(states);
  EXPECT_DOUBLE_EQ(*meter.drift().energy, 16.0 / 25);
  EXPECT_FALSE(meter.drift().momentum.has_value());
}

TEST(Invariants, PenetrationIsTheDeepestOfAllPairs) {
  Scenario scenario = parse_scenario(R"(
title = "Deep"
[world]
size = [10, 10]
contacts = "soft"
[[body]]
name = "a"
radius = 1
position = [3, 5]
[[body]]
name = "b"
radius = 1
position = [4.75, 5]
[[body]]
name = "c"
radius = 1
position = [6.5, 5]
[[step]]
do = "insert"
bodies = ["a", "b", "c"]
)",
                                     "deep.toml");
  std::vector<BodyState> states = states_after(scenario, 0);
  const Invariants invariants(scenario);
  EXPECT_NEAR(invariants.of(states).penetration, 0.25, 1e-12);
  states[2].position.x = 6.25;
  EXPECT_NEAR(invariants.of(states).penetration, 0.5, 1e-12);
  states[1].there = false;
  EXPECT_EQ(invariants.of(states).penetration, 0) << "one that is not there meets nothing";
}

}  // namespace
}  // namespace lantern::measure
