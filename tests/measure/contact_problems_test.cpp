// The problems of scenarios/problems in which bodies touch: what is none of them is refused, and
// the engine solves them as well as it promises.
#include <cmath>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "measure/contact_runs.hpp"

namespace lantern::measure {
namespace {

TEST(ContactProblems, RefuseWhatIsAnother) {
  struct Case {
    const char* file;
    Changes changes;
    const char* says;
  };
  const Case cases[] = {
      {"bouncing_ball", {{"gravity = [0, -10]", "gravity = [1, -10]"}}, "straight onto the ground"},
      {"bouncing_ball", {{"position = [0, 1.75]", "position = [0, 0.4]"}}, "begins in the ground"},
      {"bouncing_ball", {{"restitution = 0.8", "drag = 1"}}, "'ball' has drag"},
      {"bouncing_ball", {{"ground = [0, 1]", "radius = 1\nstatic = true"}}, "has no flat face"},
      {"blocks_and_wall", {{"restitution = 1", "restitution = 0.9"}}, "not elastic"},
      {"blocks_and_wall", {{"velocity = [-1, 0]", "velocity = [1, 0]"}}, "towards the wall"},
      {"blocks_and_wall", {{"velocity = [-1, 0]", "velocity = [-1, 1]"}}, "one line"},
      {"newtons_cradle", {{"position = [-5.5, 0]", "position = [-5.5, 1]"}}, "leaves the line"},
      {"superball", {{"position = [-0.5, 0]", "position = [-3, 0]"}}, "in each other"},
      {"billiards", {{"samples = 20", "samples = 21"}}, "odd number of samples"},
      {"billiards", {{"restitution = 1", "restitution = 0.5"}}, "not elastic"},
      {"slide", {{"position = [0, 0.5]", "position = [0, 0.6]"}}, "does not lie on the ground"},
      {"slide", {{"friction = 0.5", "friction = 0.1"}}, "still slides at the end"},
      {"slide", {{"half_size = [0.5, 0.5]", "radius = 0.5"}}, "would roll or topple"},
      {"slip_then_roll", {{"radius = 0.5", "half_size = [0.5, 0.5, 0.5]"}}, "is no ball"},
      {"incline", {{"gravity = [0, -10, 0]", "gravity = [0, 10, 0]"}}, "slantwise"},
      {"topple", {{"friction = 2.0", "friction = 0.01"}}, "would slide"},
      {"topple_extreme", {{"seconds = 5", "seconds = 1"}}, "needs more seconds"},
      {"stack", {{"min = [0, 0.5]", "min = [0, 0.4]"}}, "does not lie on the ground"},
      {"heavy_on_light", {{"position = [0, 1.5]", "position = [0, 1.6]"}}, "on the one below"},
      {"heavy_on_light", {{"position = [0, 1.5]", "position = [0.2, 1.5]"}}, "in one line"},
      {"hanging_chain", {{"to = [0, 0]", "to = [1, 0]"}}, "straight down"},
      {"hanging_chain", {{"b = \"link1\"", "b = \"link2\""}}, "no chain"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(std::string(c.file) + ", " + c.says);
    try {
      metrics_of(problem(c.file, c.changes))();
      ADD_FAILURE() << "it was taken";
    } catch (const Refused& refused) {
      EXPECT_NE(std::string(refused.what()).find(c.says), std::string::npos) << refused.what();
      EXPECT_NE(std::string(refused.what()).find(c.file), std::string::npos) << "name the scenario";
    }
  }
}

TEST(ContactProblems, LeaveOtherProblemsToOthers) {}

struct Bar {
  const char* file;
  const char* method;
  double step;
  Norms at_most;
};

void expect_within(const std::vector<Bar>& bars) {
  for (const Bar& bar : bars) {
    const Norms found = run(problem(bar.file), bar.method, bar.step);
    for (const auto& [name, most] : bar.at_most)
      EXPECT_LE(found.at(name), most) << bar.file << " by " << bar.method << ": " << name;
  }
}

TEST(ContactProblems, ImpactsAreExact) {
  expect_within(
      {{"bouncing_ball", "velocity_verlet", 0.1, {{"times", 1e-11}, {"apex", 1e-12}}},
       {"bouncing_ball_stiff", "velocity_verlet", 0.1, {{"times", 1e-10}, {"apex", 1e-12}}},
       {"blocks_and_wall", "soft", 0.1, {{"hits", 0}, {"v", 1e-13}, {"E", 1e-12}}},
       {"blocks_and_wall_stiff", "soft", 0.1, {{"hits", 0}, {"v", 1e-11}, {"E", 1e-12}}},
       {"newtons_cradle", "soft", 0.1, {{"v", 1e-14}, {"p", 1e-14}, {"E", 1e-14}}},
       {"superball", "soft", 0.1, {{"v", 1e-14}, {"p", 1e-14}, {"E", 1e-14}}},
       {"superball_extreme", "soft", 0.1, {{"v", 1e-14}, {"p", 1e-14}, {"E", 1e-14}}},
       {"billiards", "soft", 0.1, {{"return", 1e-12}, {"E", 1e-13}, {"p", 1e-14}}},
       {"billiards_stiff", "soft", 0.1, {{"return", 1e-11}, {"E", 1e-13}, {"p", 1e-13}}}});
}

// A mass ratio of a million millions.
TEST(ContactProblems, HitsCountPiToSevenFigures) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "as much again, and ten times as slow";
#endif
  expect_within(
      {{"blocks_and_wall_extreme", "soft", 0.1, {{"hits", 0}, {"v", 1e-11}, {"E", 1e-12}}}});
}

TEST(ContactProblems, FrictionIsCoulombs) {
  expect_within(
      {{"slide", "soft", 0.02, {{"distance", 1e-9}, {"time", 1e-9}}},
       {"slide_stiff", "soft", 0.002, {{"distance", 1e-9}, {"time", 1e-9}}},
       {"slip_then_roll", "soft", 0.02, {{"distance", 1e-9}, {"time", 1e-9}, {"v", 1e-9}}},
       {"slip_then_roll_stiff", "soft", 0.002, {{"distance", 1e-9}, {"v", 1e-9}}},
       {"slip_then_roll_extreme", "soft", 0.05, {{"distance", 1e-9}, {"v", 1e-9}}},
       {"incline", "soft", 0.01, {{"class", 0}, {"a", 1e-3}}},
       {"incline_stiff", "soft", 0.01, {{"class", 0}, {"a", 1e-3}}},
       {"incline_extreme", "soft", 0.01, {{"class", 0}, {"a", 1e-3}}},
       {"topple", "soft", 1.0 / 60, {{"class", 0}, {"tilt", 1e-9}}},
       {"topple_stiff", "soft", 1.0 / 60, {{"class", 0}, {"tilt", 1e-9}}},
       {"topple_extreme", "soft", 1.0 / 60, {{"class", 0}, {"tilt", 1e-9}}}});
}

// The bars of stacks, of heavy on light, and of chains: ten seconds at 1/60 s.
TEST(ContactProblems, WhatRestsStaysAtRest) {
  expect_within(
      {{"stack", "soft", 1.0 / 60, {{"depth", 1e-4}, {"impulse", 1e-6}}},
       {"stack_stiff", "soft", 1.0 / 60, {{"depth", 1e-4}, {"impulse", 1e-6}}},
       {"heavy_on_light_stiff", "soft", 1.0 / 60, {{"depth", 1e-4}, {"impulse", 1e-6}}},
       {"heavy_on_light_extreme", "soft", 1.0 / 60, {{"depth", 5e-3}, {"impulse", 1e-4}}},
       {"hanging_chain", "soft", 1.0 / 60, {{"stretch", 1e-6}, {"tension", 1e-6}}},
       {"hanging_chain_stiff", "soft", 1.0 / 60, {{"stretch", 1e-2}, {"tension", 1e-4}}}});
}

}  // namespace
}  // namespace lantern::measure
