// Runs and what is told of them.
#include <chrono>
#include <cmath>
#include <thread>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/stop.hpp"
#include "measure/contact_runs.hpp"
#include "measure/plan.hpp"
#include "measure/scenes.hpp"
#include "measure/solvers.hpp"

namespace lantern::measure {
namespace {

std::vector<Row> rows_of(Scenario scenario, std::vector<std::string> methods,
                         std::vector<double> steps) {
  PlanOptions options;
  options.scenarios = {std::move(scenario)};
  options.effort = Effort::quick;
  options.methods = std::move(methods);
  options.steps = std::move(steps);
  options.longest = 1e9;
  options.peers = false;
  Plan plan(std::move(options), [](const Scenario&) {});
  return plan.run(plan.jobs());
}

TEST(Run, AScenarioIsHeldAgainstItsOwnFinerRun) {
  // Semi-implicit Euler misses the parabola by g T h / 2.
  const std::vector<Row> rows = rows_of(thrown(), {"semi_implicit_euler"}, {0.02, 0.01});
  ASSERT_EQ(rows.size(), 2u);
  for (const Row& row : rows) {
    ASSERT_EQ(row.status, Status::ok) << row.reason;
    EXPECT_NE(row.reference.find("own run"), std::string::npos) << row.reference;
    const double way = std::hypot(3.0, 1.0);  // from start to end, larger than any between
    EXPECT_NEAR(*row.error(), 10 * 1 * row.step / 2 / way, 1e-9);
    EXPECT_EQ(row.counted.steps, static_cast<std::uint64_t>(std::lround(1 / row.step)));
    EXPECT_GE(row.timing.repeats, Timing::kFewest);
    EXPECT_EQ(row.timing.repeats, row.processor.repeats);
  }
  EXPECT_LT(rows_of(thrown(), {"velocity_verlet"}, {0.1})[0].error(), 1e-13);
}

TEST(Run, DriftIsSampledFurtherAndFurtherApart) {
  const Scenario spring = known_problem("oscillator");
  const Row row = rows_of(spring, {"semi_implicit_euler"}, {0.1})[0];
  ASSERT_GE(row.samples.size(), 8u);
  EXPECT_LE(row.samples.size(), 16u);
  for (std::size_t i = 1; i < row.samples.size(); ++i) {
    EXPECT_GT(row.samples[i].time, row.samples[i - 1].time);
    EXPECT_GE(row.samples[i].error, row.samples[i - 1].error) << "it is the largest so far";
  }
  EXPECT_DOUBLE_EQ(row.samples.back().time, spring.problem->seconds);
  EXPECT_EQ(row.samples.back().error, row.norms.front().value);
  EXPECT_EQ(row.samples.back().energy, row.drift.energy);
  EXPECT_TRUE(rows_of(known_problem("slide"), {"soft"}, {0.1})[0].samples.empty())
      << "friction keeps nothing";
}

TEST(Run, WhatFallsHasCollapsed) {
  Scenario pyramid = known_problem("pyramid");
  pyramid.bodies[0].material.friction = 0;  // the ground's
  const Row row = rows_of(pyramid, {"lecture"}, {1.0 / 30})[0];
  EXPECT_EQ(row.status, Status::collapsed);
  EXPECT_NE(row.reason.find("moved"), std::string::npos) << row.reason;
  EXPECT_FALSE(row.error());
}

TEST(Run, CountedWorkIsThatOfTheMethod) {
  for (const auto& [method, evaluations] :
       {std::pair("explicit_euler", 100), std::pair("velocity_verlet", 200),
        std::pair("runge_kutta_4", 400)}) {
    const Row row = rows_of(thrown(), {method}, {0.01})[0];
    EXPECT_EQ(row.counted.force_evaluations, static_cast<std::uint64_t>(evaluations)) << method;
  }
}

TEST(Run, ARunThatBlowsUpHasDiverged) {
  Scenario spring = parse_scenario(R"(
title = "A stiff spring"
[world]
min = [-5, -5]
max = [5, 5]
time_step = 0.1
[[body]]
name = "bob"
radius = 0.5
mass = 1
position = [1, 0]
[[spring]]
a = "bob"
to = [0, 0]
rest_length = 0
stiffness = 10000
[[step]]
do = "insert"
bodies = ["bob"]
[[step]]
do = "run"
seconds = 40
)",
                                   "stiff.toml");
  const Row row = rows_of(spring, {"explicit_euler"}, {0.1})[0];
  EXPECT_EQ(row.status, Status::diverged) << to_string(row.status);
  EXPECT_FALSE(row.reason.empty());
  EXPECT_FALSE(row.error().has_value());
  EXPECT_EQ(row.timing.repeats, 0) << "what has diverged is not timed";
}

// Lets all bodies fall through each other, and tells a skin. It may wait in between, as if others
// had the processor.
class Falling : public Solver {
 public:
  explicit Falling(double wait = 0) : wait_(wait) {}
  std::string name() const override { return "falling"; }
  std::string version() const override { return "1"; }
  std::optional<std::string> cannot(const Scenario&) const override { return std::nullopt; }
  std::unique_ptr<Simulation> start(const Scenario& scenario, double h) const override {
    struct Fall : Simulation {
      std::vector<BodyState> states;
      double h = 0, wait = 0;  // seconds
      void advance(std::uint64_t steps) override {
        std::this_thread::sleep_for(std::chrono::duration<double>(wait));
        for (BodyState& state : states) state.position.y -= h * static_cast<double>(steps);
      }
      void observe(std::vector<BodyState>& now) const override { now = states; }
      double skin(std::size_t body) const override { return body == 1 ? 0.25 : 0; }
    };
    auto fall = std::make_unique<Fall>();
    fall->states = at_start(scenario).states;
    fall->h = h;
    fall->wait = wait_;
    return fall;
  }

 private:
  double wait_;
};

TEST(Run, WhatHasFallenIsNoSuccess) {
  const Scenario scenario = problem("stack");
  const Schedule schedule = Schedule::of(scenario);
  const Invariants invariants(scenario);
  const Reference reference = reference_for(scenario, schedule, 1);
  const Row row = evaluated({scenario, schedule, invariants, reference}, Falling(), 0.1);
  EXPECT_EQ(row.status, Status::collapsed) << to_string(row.status);
  EXPECT_NE(row.reason.find("below its place"), std::string::npos) << row.reason;
  EXPECT_FALSE(row.norms.empty()) << "how far off it is may still be read";
  EXPECT_FALSE(row.error()) << "but is no error to be compared";
  EXPECT_EQ(row.skin, 0.25);
}

TEST(Run, OneThatIsStoppedCanBeRunAgain) {
  PlanOptions options;
  options.scenarios = {thrown()};
  options.methods = {"velocity_verlet"};
  options.steps = {0.01};
  options.peers = false;
  Plan plan(std::move(options), [](const Scenario&) {});
  ask_to_stop();
  EXPECT_THROW(plan.run(plan.jobs()), Stopped);
  forget_stop();
  const Row row = plan.run(plan.jobs())[0];
  EXPECT_EQ(row.status, Status::ok) << row.reason;
  EXPECT_GT(row.timing.repeats, 0);
}

TEST(Run, LongOnesAreFoundOutBefore) {
  PlanOptions options;
  options.scenarios = {thrown()};
  options.steps = {0.01, 1e-12};
  options.peers = false;
  Plan plan(std::move(options), [](const Scenario&) {});
  for (const Job& job : plan.jobs()) {
    EXPECT_EQ(plan.is_too_long(job), job.step < 1e-9) << job.step;
    if (job.step < 1e-9) {
      EXPECT_GT(plan.seconds(job), 3600) << "a million million steps";
    }
  }
}

TEST(Run, AreNoLongerWhereOthersHaveTheProcessor) {
  const Scenario scenario = thrown();
  const Schedule schedule = Schedule::of(scenario);
  const Invariants invariants(scenario);
  const Reference reference = reference_for(scenario, schedule, 0.1);
  constexpr double kWait = 0.05, kStep = 0.1;
  const Falling kept_waiting(kWait);
  EXPECT_LT(estimated_seconds(scenario, schedule, kept_waiting, kStep), kWait);
  double seconds = 1;
  const Row row =
      evaluated({scenario, schedule, invariants, reference}, kept_waiting, kStep, &seconds);
  EXPECT_EQ(row.status, Status::ok) << row.reason;
  EXPECT_LT(seconds, kWait);
}

TEST(Run, WhatIsLeftOutIsARowAndSaysWhy) {
  PlanOptions options;
  options.scenarios = {thrown()};
  options.steps = {0.01, 1e-12};
  options.methods = {"velocity_verlet"};
  options.peers = false;
  Plan plan(std::move(options), [](const Scenario&) {});
  const std::vector<Row> rows = plan.run(plan.jobs());
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].status, Status::ok);
  EXPECT_EQ(rows[1].status, Status::left_out);
  EXPECT_FALSE(rows[1].was_run());
  EXPECT_LT(rows[1].step, 1e-9);
  EXPECT_NE(rows[1].reason.find("the limit is 2 s"), std::string::npos) << rows[1].reason;
}

TEST(Run, RepeatsTakeTurns) {
  const Scenario scenario = thrown();
  const Schedule schedule = Schedule::of(scenario);
  const Invariants invariants(scenario);
  const Reference reference = reference_for(scenario, schedule, 0.01);
  EXPECT_LT(reference.error, 1e-12) << "RK4 follows a parabola exactly";
  const Trials trials{scenario, schedule, invariants, reference};
  const LanternSolver euler(*method_named("explicit_euler")), rk4(*method_named("runge_kutta_4"));
  Row rows[] = {evaluated(trials, euler, 0.1), evaluated(trials, rk4, 0.1)};
  const TimedRun runs[] = {{&euler, &rows[0], {3, 0}}, {&rk4, &rows[1], {2, 0}}};
  std::vector<std::size_t> turns;
  time_in_turn(trials, runs, [&](std::size_t i) { turns.push_back(i); });
  EXPECT_EQ(turns, (std::vector<std::size_t>{0, 1, 0, 1, 0}));
  for (const Row& row : rows) {
    EXPECT_LE(row.timing.least, row.timing.lower_quartile);
    EXPECT_LE(row.timing.lower_quartile, row.timing.median);
    EXPECT_LE(row.timing.median, row.timing.upper_quartile);
  }
  EXPECT_EQ(rows[0].timing.repeats, 3);
  EXPECT_EQ(rows[1].timing.repeats, 2);
}

// Beyond that, by how narrow the interval came out, which depends on the machine.
TEST(Run, RepeatsGoOnWhileTheMedianIsNotKnownButNotForEver) {
  const Scenario scenario = thrown();
  const Schedule schedule = Schedule::of(scenario);
  const Invariants invariants(scenario);
  const Reference reference = reference_for(scenario, schedule, 0.01);
  const Trials trials{scenario, schedule, invariants, reference};
  const LanternSolver euler(*method_named("explicit_euler"));
  Row row = evaluated(trials, euler, 0.1);
  const TimedRun run{&euler, &row, {2, 0, 9}};
  time_in_turn(trials, {&run, 1}, [](std::size_t) {});
  EXPECT_GE(row.processor.repeats, Timing::kFewest) << "fewer have no interval";
  EXPECT_LE(row.processor.repeats, 9);
  EXPECT_TRUE(row.processor.repeats == 9 || row.processor.is_narrow());
}

TEST(Timing, HasTheMedianBetweenTwoOfItsRepeats) {
  std::vector<double> seconds;
  for (int i = 1; i <= 5; ++i) seconds.push_back(i);
  EXPECT_EQ(timing_of(seconds).low, 1);
  EXPECT_EQ(timing_of(seconds).high, 5);
  EXPECT_FALSE(timing_of({1, 1, 1, 1, 1}).is_narrow()) << "five cover it by 93.75 % only";
  EXPECT_TRUE(timing_of({1, 1, 1, 1, 1, 1}).is_narrow());
  for (int i = 6; i <= 15; ++i) seconds.insert(seconds.begin(), i);
  EXPECT_EQ(timing_of(seconds).low, 4) << "3 of 15 below it: 1.8 %, 4 of 15: 5.9 %";
  EXPECT_EQ(timing_of(seconds).high, 12);
}

TEST(Run, WhoDoesNotSuitIsKeptWithTheReason) {
  PlanOptions options;
  options.scenarios = {thrown()};
  options.methods = {"impulse", "dormand_prince:adaptive", "velocity_verlet"};
  options.peers = false;
  const Plan plan(std::move(options), [](const Scenario&) {});
  ASSERT_EQ(plan.unsuited().size(), 2u);
  EXPECT_EQ(plan.unsuited()[0].solver, "impulse");
  EXPECT_EQ(plan.unsuited()[0].reason, "its bodies do not collide");
  EXPECT_EQ(plan.unsuited()[1].solver, "dormand_prince:adaptive");
  EXPECT_EQ(plan.unsuited()[1].reason, "it has no [problem]");
}

TEST(Run, MethodsOfPlacesAloneAreOfferedWhereTheySuit) {
  const auto reason = [](std::string_view problem) {
    std::string found = "none";
    for (const char* name : {"kahan_li_8", "dormand_prince"}) {
      const Scenario scenario = known_problem(problem);
      const auto why = why_not(LanternSolver(*method_named(name)), scenario);
      const std::vector<Method> offered = methods_for(scenario);
      if (scenario.problem->methods.empty()) {
        EXPECT_EQ(std::ranges::count(offered, name, &Method::name), why ? 0 : 1) << problem;
      }
      found = why.value_or("none");
    }
    return found;
  };
  EXPECT_EQ(reason("kepler"), "none");
  EXPECT_EQ(reason("oscillator"), "none");
  EXPECT_EQ(reason("oscillator_damped"), "its springs are damped");
  EXPECT_EQ(reason("double_pendulum"), "it has joints");
  EXPECT_EQ(reason("stack"), "its bodies collide");
  EXPECT_TRUE(can_be_measured_by("dormand_prince"));
  EXPECT_TRUE(can_be_measured_by("dormand_prince:adaptive"));
}

TEST(Run, AWrongStepNamesTheScenario) {
  PlanOptions options;
  options.scenarios = {thrown()};
  options.steps = {1e-300};
  try {
    Plan plan(std::move(options), [](const Scenario&) {});
    FAIL() << "a step that moves no clock was accepted";
  } catch (const ScenarioError& error) {
    EXPECT_EQ(error.diagnostics().at(0).where.file, "throw.toml");
  }
}

TEST(Run, MethodsAreThoseThatMakeADifference) {
  EXPECT_EQ(methods_for(thrown()).size(), 8u);
  EXPECT_EQ(methods_for(thrown("")).size(), 1u) << "free flight is the same by all";
  for (const Method& method : methods_for(thrown("contacts = \"soft\"")))
    EXPECT_TRUE(method.contacts.has_value()) << method.name;
}

TEST(Methods, NamesAreReadBack) {
  EXPECT_EQ(method_named("soft:16")->effort, 16);
  EXPECT_EQ(method_named("impulse:100")->contacts, ContactMethod::impulse);
  EXPECT_EQ(method_named("splitting_4")->rotation, RotationMethod::splitting_4);
  for (const char* bad :
       {"", "soft:", "soft:0", "soft:-1", "soft:1e9", "soft:16x", "rk4", "runge_kutta_4:2"})
    EXPECT_FALSE(method_named(bad).has_value()) << bad;
}

}  // namespace
}  // namespace lantern::measure
