// The problems of scenarios/problems with joints, plates, blocks that tip and many bodies: what
// they are held against is right, what is none of them is refused, and a collapse is told.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "measure/contact_runs.hpp"
#include "measure/forms/closed_forms.hpp"
#include "measure/forms/linkage.hpp"

namespace lantern::measure {
namespace {

TEST(JointProblems, RefuseWhatIsAnother) {
  struct Case {
    const char* file;
    Changes changes;
    const char* says;
  };
  const Case cases[] = {
      {"double_pendulum", {{"gravity = [0, -10]", ""}}, "no gravity"},
      {"double_pendulum", {{"to = [0, 0]", "to = [0.1, 0]"}}, "not met at first"},
      {"double_pendulum",
       {{"position = [0.5, 0]", "position = [0.5, 0]\nvelocity = [1, 0]"}},
       "at rest"},
      {"heavy_top", {{"to = [0, 0, 0]", "to = [0, 0.1, 0]"}}, "not met at first"},
      {"heavy_top", {{"at_a = [0, -1, 0]", "at_a = [0, 0, 0]"}}, "at its centre"},
      {"springs_along_pins",
       {{"max = [11, 3]", "max = [11, 3]\ngravity = [0, -1]"}},
       "has gravity"},
      {"ball_on_plate", {{"position = [0, 1.5, 0]", "position = [0, 1.6, 0]"}}, "on the plate"},
      {"ball_on_plate", {{"force = [55.824, 0, 0]", "force = [0, 10, 0]"}}, "along one line"},
      {"ball_on_plate", {{"body = \"plate\"", "body = \"ball\""}}, "does not pull the plate"},
      {"rocking_block", {{"friction = 2", "friction = 0.1"}}, "slips"},
      {"dominoes", {{"seconds = 3.0", "seconds = 0.2"}}, "not all of its dominoes fall"},
      {"dominoes", {{"gravity = [0, -10]", ""}}, "no gravity"},
      {"pile", {{"gravity = [0, -10]", ""}}, "no gravity"},
      {"pyramid", {{"half_size = [0.5, 0.5]", "half_size = [0.5, 0.5]\nspeed = 1"}}, "at rest"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(std::string(c.file) + ", " + c.says);
    try {
      metrics_of(problem(c.file, c.changes))();
      ADD_FAILURE() << "it was taken";
    } catch (const Refused& refused) {
      EXPECT_NE(std::string(refused.what()).find(c.says), std::string::npos) << refused.what();
    }
  }
}

// A bar on a hinge at its end: omega^2 = m g l / I = 3 g / (4 l).
TEST(JointProblems, ALinkageOfOneIsAPendulum) {
  const long double half = 0.5L, inertia = half * half / 3;
  Linkage linkage({{1, inertia, {half, 0}}}, {{0, {}, {-half, 0}, {0, 0}, {}}}, {0, -10});
  for (const long double time : {0.3L, 1.0L, 2.5L}) {
    const PendulumState exact = exact_pendulum(std::sqrt(10 * half / (inertia + half * half)),
                                               {std::numbers::pi_v<long double> / 2, 0}, time);
    const Linkage::Body& now = linkage.at(time).front();
    EXPECT_NEAR(static_cast<double>(now.position.x - half * std::sin(exact.angle)), 0, 1e-14);
    EXPECT_NEAR(static_cast<double>(now.spin - exact.speed), 0, 1e-13);
  }
}

// A rod to a body's centre is the same pendulum.
TEST(JointProblems, ALinkageOfARodIsAPendulum) {
  Linkage linkage({{3, 1, {2, 0}}}, {{0, {}, {0, 0}, {0, 0}, 2}}, {0, -10});
  const PendulumState exact =
      exact_pendulum(std::sqrt(5.0L), {std::numbers::pi_v<long double> / 2, 0}, 1.5L);
  const Linkage::Body& now = linkage.at(1.5L).front();
  EXPECT_NEAR(static_cast<double>(now.position.x - 2 * std::sin(exact.angle)), 0, 1e-14);
}

// Two cranks of 1 on points 2 apart, and a coupler between them: a parallelogram, which swings as
// one: m l^2 (1/3 + 1 + 1/3) angle'' = -2 m g l sin(angle).
TEST(JointProblems, ALinkageMayBeALoop) {
  const long double start = 1, x = std::sin(start), y = -std::cos(start);
  const long double along = start - std::numbers::pi_v<long double> / 2;  // of the cranks' axes
  Linkage linkage({{1, 1 / 12.0L, {x / 2, y / 2}, {0, 0}, along, 0},
                   {1, 4 / 12.0L, {1 + x, y}},
                   {1, 1 / 12.0L, {2 + x / 2, y / 2}, {0, 0}, along, 0}},
                  {{0, {}, {-0.5L, 0}, {0, 0}, {}},
                   {0, 1, {0.5L, 0}, {-1, 0}, {}},
                   {1, 2, {1, 0}, {0.5L, 0}, {}},
                   {2, {}, {-0.5L, 0}, {2, 0}, {}}},
                  {0, -10});
  const PendulumState exact = exact_pendulum(std::sqrt(12.0L), {start, 0}, 1.2L);
  const Linkage::Body now = linkage.at(1.2L)[1];
  EXPECT_NEAR(static_cast<double>(now.position.x - 1 - std::sin(exact.angle)), 0, 1e-13);
  EXPECT_NEAR(static_cast<double>(now.angle), 0, 1e-13) << "the coupler does not turn";
  EXPECT_LT(linkage.energy_error(), 1e-13L);
}

// A top that does not spin is a pendulum in the plane of gravity.
TEST(JointProblems, ATopWithoutSpinIsAPendulum) {
  Scenario scenario = problem("heavy_top");
  scenario.bodies[0].spin = 0;
  const double inertia = (1 + 0.01) / 3 + 1, tilt = std::numbers::pi / 6;
  const Norms norms = looked_at(scenario, [&](Observation& now) {
    // From straight down: gravity leans by `tilt`, and the body stands up.
    const PendulumState exact =
        exact_pendulum(std::sqrt(10 / static_cast<long double>(inertia)),
                       {std::numbers::pi_v<long double> - tilt, 0}, now.time);
    const double angle = tilt + static_cast<double>(exact.angle) - std::numbers::pi;
    now.states[0].position = {-std::sin(angle), std::cos(angle), 0};
    now.states[0].orientation = turned(Rotation<3>{}, Vec<3>(0, 0, angle));
  });
  EXPECT_LT(norms.at("place"), 1e-9);
  EXPECT_LT(norms.at("att"), 1e-9);
}

// As the force and the masses of the file give them.
TEST(JointProblems, PlatesAndBallsGoAsTheyShould) {
  const Norms norms = looked_at(problem("ball_on_plate"), [](Observation& now) {
    const double goes = 12.66 / (10 + 2.0 / 7), t = now.time;
    now.states[1].velocity = {goes * t, 0, 0};
    now.states[1].position.x += goes * t * t / 2;
    now.states[2].velocity = {goes * t * 2 / 7, 0, 0};
    now.states[2].position.x += goes * t * t / 7;
  });
  EXPECT_LT(norms.at("v"), 1e-14);
  EXPECT_LT(norms.at("place"), 1e-14);
  // 84 N less 0.2 of 120 N on the ground and of 20 N under the block, on 10 kg.
  const Norms block = looked_at(problem("block_on_plate"), [](Observation& now) {
    const double t = now.time;
    now.states[1].velocity = {5.6 * t, 0, 0};
    now.states[1].position.x += 2.8 * t * t;
    now.states[2].velocity = {2 * t, 0, 0};
    now.states[2].position.x += t * t;
  });
  EXPECT_LT(block.at("v"), 1e-14);
  EXPECT_LT(block.at("place"), 1e-14);
}

std::optional<std::string> collapse_of(const char* file, void (*change)(Observation&)) {
  const Scenario scenario = problem(file);
  const auto metric = metrics_of(scenario)();
  Observation now = at_start(scenario);
  metric->look(now);
  change(now);
  now.time = scenario.problem->seconds;
  metric->look(now);
  return metric->collapse();
}

TEST(JointProblems, WhatFallsIsTold) {
  EXPECT_EQ(collapse_of("pyramid", [](Observation&) {}), std::nullopt);
  EXPECT_NE(collapse_of("pyramid", [](Observation& now) { now.states.back().position.y -= 0.6; }),
            std::nullopt);
  EXPECT_EQ(collapse_of("pile", [](Observation&) {}), std::nullopt);
  EXPECT_NE(collapse_of("pile", [](Observation& now) { now.states.back().position.x += 9; }),
            std::nullopt);
  EXPECT_EQ(collapse_of("bridge", [](Observation&) {}), std::nullopt);
  EXPECT_NE(collapse_of("bridge", [](Observation& now) { now.states[3].position.y -= 2; }),
            std::nullopt);
  EXPECT_NE(collapse_of("dominoes", [](Observation&) {}), std::nullopt) << "they must fall";
}

// How deep they lie in each other and how far they wander is measured once they should lie.
TEST(JointProblems, PilesAreMeasuredWhereTheyLie) {
  const Norms norms = looked_at(problem("pyramid"), [](Observation& now) {
    if (now.time > 3) now.states[1].position.x += 0.01;  // the lowest row's first, into the next
  });
  EXPECT_NEAR(norms.at("creep"), 0.01, 1e-12);
  EXPECT_NEAR(norms.at("depth"), 0.01, 1e-12);
  EXPECT_NEAR(norms.at("moved"), 0.01, 1e-12);
}

}  // namespace
}  // namespace lantern::measure
