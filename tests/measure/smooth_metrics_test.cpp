// The metrics of smooth motion: what they read from a scenario, and what they refuse.
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "measure/plan.hpp"
#include "measure/row.hpp"

namespace lantern::measure {
namespace {

Scenario scene(const std::string& solution, const std::string& world, const std::string& rest) {
  return parse_scenario(fmt::format(R"(
title = "A problem"
[world]
min = [-5, -5]
max = [5, 5]
{}
[problem]
solution = "{}"
seconds = 1
step = 0.1
{}
[[step]]
do = "show"
)",
                                    world, solution, rest),
                        "problem.toml");
}

std::string ball(const std::string& more) {
  return fmt::format("[[body]]\nname = \"ball\"\nradius = 0.1\nmass = 2\n{}\n", more);
}

std::string refusal(const Scenario& scenario) {
  try {
    metrics_of(scenario)();
  } catch (const Refused& refused) {
    return refused.what();
  }
  return "accepted";
}

const std::string kPulled = ball("position = [1, 0]");
const std::string kSpring = "[[spring]]\na = \"ball\"\nto = [0, 0]\nstiffness = 8\n";
const std::string kRod = "[[joint]]\nkind = \"distance\"\na = \"ball\"\nto = [0, 0]\n";

BodyState at(Vec<3> position, Vec<3> velocity) {
  BodyState state;
  state.there = true;
  state.position = position;
  state.velocity = velocity;
  return state;
}

double error_at(const Scenario& scenario, double time, const std::vector<BodyState>& states) {
  const auto metric = metrics_of(scenario)();
  metric->look({time, states, 0});
  return metric->norms().front().value;
}

TEST(SmoothMetrics, EveryProblemFileIsItsProblemAndStartsWithoutError) {
  int found = 0;
  for (const std::string_view name : problem_names()) {
    const Scenario scenario = known_problem(name);
    if (scenario.problem->solution > Solution::free_top) continue;
    ++found;
    std::vector<BodyState> states;
    for (const BodySpec& body : scenario.bodies) {
      states.push_back(at(body.position, body.velocity));
      states.back().orientation = turned(Rotation<3>(), body.axis * body.angle);
    }
    EXPECT_LT(error_at(scenario, 0, states), 1e-12) << name;
  }
  EXPECT_GE(found, 18);
}

TEST(SmoothMetrics, ReadMassesSpringsAndGravity) {
  // omega = sqrt(8 / 2) = 2, about a place that is lower by 10 * 2 / 8.
  const Scenario hung = scene("oscillator", "gravity = [0, -10]",
                              ball("position = [0, -3.5]") +
                                  "[[spring]]\na = \"ball\"\nto = [0, 0]\nstiffness = 8\n"
                                  "rest_length = 0\n");
  const double t = 0.7, c = std::cos(2 * t), s = std::sin(2 * t);
  EXPECT_LT(error_at(hung, t, {at({0, -2.5 - c, 0}, {0, 2 * s, 0})}), 1e-15);
  EXPECT_NEAR(error_at(hung, t, {at({0.5, -2.5 - c, 0}, {0, 2 * s, 0})}), 0.5, 3e-15)
      << "relative to the amplitude";
  EXPECT_NEAR(error_at(hung, t, {at({0, -2.5 - c, 0}, {0, 2 * s + 0.5, 0})}), 0.25, 3e-15)
      << "relative to amplitude times frequency";

  const Scenario braked =
      scene("projectile", "", ball("position = [1, 2]\nvelocity = [4, 0]\ndrag = 6"));
  EXPECT_LT(error_at(braked, 0.5,
                     {at({1 + 4.0 / 3 * (1 - std::exp(-1.5)), 2, 0}, {4 * std::exp(-1.5), 0, 0})}),
            1e-15);
}

TEST(SmoothMetrics, TheWorstMomentCounts) {
  const Scenario fall = scene("projectile", "gravity = [0, -10]", ball("position = [0, 0]"));
  const auto metric = metrics_of(fall)();
  metric->look({0, {at({0.5, 0, 0}, {0, 0, 0})}, 0});
  metric->look({0, {at({0, 0, 0}, {0, 0, 0})}, 0});
  EXPECT_NEAR(metric->norms().front().value, 0.1, 1e-15) << "it falls by 5 in the second";
}

TEST(SmoothMetrics, WhatIsNotANumberStaysSo) {
  const Scenario fall = scene("projectile", "gravity = [0, -10]", ball("position = [0, 0]"));
  const auto metric = metrics_of(fall)();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  metric->look({0, {at({nan, 0, 0}, {0, 0, 0})}, 0});
  metric->look({0, {at({0, 0, 0}, {0, 0, 0})}, 0});
  EXPECT_TRUE(std::isnan(metric->norms().front().value));
}

TEST(SmoothMetrics, RefuseWhatIsNotTheProblem) {
  const std::string second = "[[body]]\nname = \"other\"\nradius = 0.1\nposition = [2, 0]\n";
  struct Case {
    const char* what;
    Scenario scenario;
  };
  const Case cases[] = {
      {"two bodies", scene("oscillator", "", kPulled + second + kSpring)},
      {"two springs", scene("oscillator", "", kPulled + kSpring + kSpring)},
      {"a rod", scene("oscillator", "", kPulled + kRod)},
      {"a spring at rest", scene("oscillator", "", kPulled + kSpring)},
      {"a spring that swings aside",
       scene("oscillator", "", ball("position = [1, 0]\nvelocity = [0, 1]") + kSpring)},
      {"a spring that turns inside out",
       scene("oscillator", "", ball("position = [1, 0]\nvelocity = [4, 0]") + kSpring)},
      {"an end off the centre", scene("oscillator", "", kPulled + kSpring + "at_a = [0.05, 0]\n")},
      {"a projectile on a spring", scene("projectile", "", kPulled + kSpring)},
      {"a projectile that rests", scene("projectile", "", kPulled)},
      {"a chain that is not fixed", scene("chain", "",
                                          kPulled + second +
                                              "[[spring]]\na = \"ball\"\nb = \"other\"\n"
                                              "stiffness = 8\n")},
      {"a chain in two pieces", scene("chain", "", kPulled + second + kSpring)},
      {"a chain under gravity", scene("chain", "gravity = [0, -1]", kPulled + kSpring)},
      {"an orbit without attraction", scene("kepler", "", kPulled + second)},
      {"an orbit of one", scene("kepler", "gravitation = 1", kPulled)},
      {"a straight fall", scene("kepler", "gravitation = 1", kPulled + second)},
      {"a pendulum without gravity", scene("pendulum", "", kPulled + kRod)},
      {"a pendulum over the top", scene("pendulum", "gravity = [0, -1]",
                                        ball("position = [0, -1]\nvelocity = [3, 0]") + kRod)},
      {"a pendulum with drag",
       scene("pendulum", "gravity = [0, -1]", ball("position = [1, 0]\ndrag = 1") + kRod)},
      {"a top in a flat world",
       [] {
         Scenario flat = scene("projectile", "gravity = [0, -1]", kPulled);
         flat.problem->solution = Solution::free_top;
         return flat;
       }()},
  };
  for (const Case& c : cases) {
    const std::string reason = refusal(c.scenario);
    const std::string problem(to_string(c.scenario.problem->solution));
    EXPECT_NE(reason, "accepted") << c.what;
    EXPECT_TRUE(reason.find("is no problem of kind " + problem) != std::string::npos ||
                reason.starts_with("the "))
        << reason;
  }
}

TEST(SmoothMetrics, TheRodsDriftIsANormOfItsOwn) {
  const Scenario swing = scene("pendulum", "gravity = [0, -10]", kPulled + kRod);
  const auto metric = metrics_of(swing)();
  metric->look({0, {at({1.001, 0, 0}, {0, 0, 0})}, 0});
  const std::vector<Norm> norms = metric->norms();
  ASSERT_EQ(norms.size(), 2u);
  EXPECT_EQ(norms[1].name, "joint");
  EXPECT_NEAR(norms[1].value, 1e-3, 1e-15);
}

}  // namespace
}  // namespace lantern::measure
