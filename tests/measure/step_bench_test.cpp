// Piles, what is looked at in them, and the bench that runs them.
#include "measure/step_bench.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace lantern::measure {
namespace {

std::vector<BodyState> at_start(const Scenario& scenario) {
  std::vector<BodyState> states;
  for (const BodySpec& body : scenario.bodies) {
    BodyState& state = states.emplace_back();
    state.there = true;
    state.position = body.position;
    state.angle = body.angle;
    state.orientation = turned(Rotation<3>(), body.axis * body.angle);
  }
  return states;
}

std::vector<double> no_skins(const Scenario& scenario) {
  return std::vector<double>(scenario.bodies.size(), 0.0);
}

TEST(Pile, HasAName) {
  for (const char* name : {"boxes2d:500", "balls2d:1", "boxes3d:2000", "balls3d:100000"}) {
    const auto pile = pile_named(name);
    ASSERT_TRUE(pile) << name;
    EXPECT_EQ(pile->name(), name);
  }
  for (const char* name : {"", "boxes2d", "boxes2d:", "boxes2d:0", "boxes2d:1.5", "boxes2d:100001",
                           "boxes4d:5", "boxes2d:-1", "boxes2d:5 "})
    EXPECT_FALSE(pile_named(name)) << name;
}

TEST(Pile, StartsApartAndInside) {
  for (const char* name : {"boxes2d:300", "balls2d:300", "boxes3d:300", "balls3d:300"}) {
    const Pile pile = *pile_named(name);
    const Scenario scenario = pile_scene(pile, 1.0 / 60, StructureKind::sort_and_sweep);
    const PileState state = PileGauge(pile, scenario).of(at_start(scenario), no_skins(scenario));
    EXPECT_EQ(state.touching, 0u) << name;
    EXPECT_EQ(state.outside, 0u) << name;
    EXPECT_GT(state.energy, 0) << name;
  }
}

TEST(Pile, TellsHowDeepBodiesLie) {
  const Pile pile = *pile_named("boxes2d:2");
  const Scenario scenario = pile_scene(pile, 1.0 / 60, StructureKind::sort_and_sweep);
  std::vector<BodyState> states = at_start(scenario);
  BodyState &a = states[states.size() - 2], &b = states.back();
  a.angle = b.angle = 0;
  a.position = {0, 0.49, 0};
  b.position = {0.2, 1.505, 0};
  const PileGauge gauge(pile, scenario);
  std::vector<double> skins = no_skins(scenario);
  PileState state = gauge.of(states, skins);
  EXPECT_NEAR(state.deepest, 0.01, 1e-12);  // in the floor; the other hovers by more than touching
  EXPECT_EQ(state.touching, 1u);
  EXPECT_NEAR(state.energy, 10 * (0.49 + 1.505 - 1), 1e-12);
  skins[skins.size() - 2] = skins.back() = 0.01;
  state = gauge.of(states, skins);
  EXPECT_NEAR(state.deepest, 0.02, 1e-12);
  EXPECT_EQ(state.touching, 2u);
  EXPECT_NEAR(state.mean, (0.02 + 0.005) / 2, 1e-12);
  a.position.y = -2;
  EXPECT_EQ(gauge.of(states, skins).outside, 1u);
}

TEST(StepBench, MeasuresOursWithoutPeers) {
  StepBenchResult result;
  result.config = {{*pile_named("balls2d:8"), *pile_named("boxes3d:4")}, 1.1, 20, {}, false};
  std::size_t told = 0;
  bench_steps(result, [&](const Pile&, double share) { told += share >= 0 && share < 1; });
  EXPECT_EQ(result.config.seconds, 1.25);  // whole quarters
  EXPECT_EQ(told, 10u);
  ASSERT_EQ(result.rows.size(), 2 * usual_efforts().size());
  for (const StepRow& row : result.rows) {
    EXPECT_EQ(row.status, Status::ok) << row.reason;
    EXPECT_TRUE(row.is_whole(1.25)) << row.simulated;
    EXPECT_EQ(row.work.steps, 75u);
    EXPECT_GT(row.mean, 0);
    EXPECT_LE(row.lower_quartile, row.upper_quartile);
    EXPECT_GE(row.end.touching, 4u) << row.solver;
    EXPECT_LT(row.end.deepest, 0.05) << row.solver;
    EXPECT_GT(row.lost, 0);
  }
  EXPECT_TRUE(compared(result).empty());
}

TEST(StepBench, EndsEarlyWhoTakesTooLong) {
  StepBenchResult result;
  result.config = {{*pile_named("balls2d:2")}, 1, 1e-9, {"soft:1"}, false};
  bench_steps(result, [](const Pile&, double) {});
  ASSERT_EQ(result.rows.size(), 1u);
  EXPECT_FALSE(result.rows[0].is_whole(1));
  EXPECT_EQ(result.rows[0].simulated, 0.25);
}

TEST(StepBench, RefusesWhoeverIsNotThere) {
  for (const char* name : {"nobody", "soft:0", "velocity_verlet", ""}) {
    StepBenchResult result;
    result.config = {{*pile_named("balls2d:2")}, 1, 20, {name}, false};
    EXPECT_THROW(bench_steps(result, [](const Pile&, double) {}), Refused) << name;
  }
}

StepRow row(const char* solver, const char* version, double deepest, double ms) {
  StepRow made;
  made.pile = "p";
  made.solver = solver;
  made.version = version;
  made.simulated = 1;
  made.mean = ms;
  made.end.deepest = deepest;
  return made;
}

TEST(StepBench, ComparesAtThePeersPenetration) {
  StepBenchResult result;
  result.config.seconds = 1;
  result.rows = {row("exact", "", 1e-6, 16), row("rough", "", 1e-2, 4), row("slow", "", 1e-1, 20),
                 row("Box2D", "2.4", 1e-4, 2), row("Bullet", "3", 0.1, 8)};
  const std::vector<StepComparison> all = compared(result);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_NEAR(all[0].our_ms, 8, 1e-12);  // half way between the two in logarithms
  EXPECT_NEAR(all[0].ratio(), 4, 1e-12);
  EXPECT_EQ(all[0].by, "between rough and exact");
  EXPECT_NEAR(all[1].our_ms, 16, 1e-12);  // at 1e-6
  EXPECT_EQ(all[2].our_ms, 4);
  EXPECT_EQ(all[2].by, "rough");
  result.rows[0].status = Status::diverged;
  EXPECT_EQ(compared(result)[1].our_ms, 0);  // none is so exact
}

}  // namespace
}  // namespace lantern::measure
