// What is run when a scenario is measured.
#include "measure/schedule.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "measure/scenes.hpp"

namespace lantern::measure {
namespace {

TEST(Schedule, AScriptsRunsAreItsLegs) {
  const Schedule schedule = Schedule::of(thrown("gravity = [0, -10]", R"(
[[step]]
do = "run"
seconds = 0.5
[[step]]
do = "impulse"
body = "ball"
impulse = [1, 0]
[[step]]
do = "run"
seconds = 0.07
)"));
  ASSERT_EQ(schedule.legs.size(), 2u);
  EXPECT_DOUBLE_EQ(schedule.seconds, 0.57);
  EXPECT_EQ(schedule.legs[0].before.size(), 1u) << "the insert";
  EXPECT_EQ(schedule.legs[1].before.size(), 1u) << "the impulse";
  EXPECT_EQ(schedule.legs[0].looks, 10u) << "50 steps in parts of five";
  EXPECT_EQ(schedule.legs[1].looks, 7u);
  EXPECT_EQ(schedule.steps(0.01), 57u);
  EXPECT_EQ(schedule.steps(0.0025), 228u);
}

TEST(Schedule, AWaitLastsAsLongAsInTheFilesOwnRun) {
  Scenario scenario = parse_scenario(R"(
title = "A fall"
[world]
size = [10, 10]
gravity = [0, -10]
contacts = "impulse"
time_step = 0.01
[[body]]
name = "ball"
radius = 0.5
position = [5, 5.5]
[[body]]
name = "floor"
static = true
half_size = [5, 0.5]
position = [5, 0.5]
[[step]]
do = "insert"
bodies = ["ball", "floor"]
[[step]]
do = "wait"
event = "touch"
bodies = ["ball", "floor"]
at_most = 5
)",
                                     "fall.toml");
  // A fall of 4 units takes sqrt(0.8) = 0.894 s.
  EXPECT_NEAR(Schedule::of(scenario).seconds, 0.894, 0.011);
}

TEST(Schedule, StepsAreFittedToTheLooks) {
  Scenario scenario = thrown();
  scenario.problem = ProblemSpec{};
  scenario.problem->seconds = 10.3;
  scenario.problem->samples = 7;
  const Schedule schedule = Schedule::of(scenario);
  for (const double wished : {100.0, 1.0, 0.3, 1e-3}) {
    const double h = schedule.fitted_step(wished);
    EXPECT_DOUBLE_EQ(h * static_cast<double>(schedule.steps(h)), 10.3) << wished;
    EXPECT_EQ(schedule.steps(h) % 7, 0u) << "a look would fall between two steps";
  }
}

TEST(Schedule, StepsThatAreNoneAreRefused) {
  const Schedule schedule = Schedule::of(thrown());
  for (const double h : {0.0, -0.01, std::numeric_limits<double>::quiet_NaN(),
                         std::numeric_limits<double>::infinity(), 1e-17, 1e-300})
    EXPECT_THROW(schedule.fitted_step(h), Refused) << h;
  EXPECT_THROW(Schedule::of(thrown("gravity = [0, -10]", "")), Refused) << "no time passes";
}

TEST(Schedule, AScriptOfManyLegsTakesOnlyStepsThatDivideThem) {
  const Schedule schedule = Schedule::of(thrown("gravity = [0, -10]", R"(
[[step]]
do = "run"
seconds = 0.5
[[step]]
do = "run"
seconds = 0.07
)"));
  EXPECT_EQ(schedule.fitted_step(0.005), 0.005);
  EXPECT_THROW(schedule.fitted_step(0.003), Refused);
}

}  // namespace
}  // namespace lantern::measure
