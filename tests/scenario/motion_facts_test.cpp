// What the sequences about methods of motion show, against closed forms.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "frame/parts/panels.hpp"
#include "scenario/directing.hpp"

namespace lantern::run {
namespace {

std::vector<const Frame*> of_step(const std::vector<Frame>& frames, const std::string& event) {
  std::vector<const Frame*> found;
  for (const Frame& frame : frames)
    if (frame.event == event) found.push_back(&frame);
  EXPECT_FALSE(found.empty()) << event;
  return found;
}

double measure(const Frame& frame, const std::string& name) {
  const auto found = frame.measure(name);
  EXPECT_TRUE(found) << name;
  return found.value_or(0);
}

void expect_as_long_as_a_lecture_wants(const std::vector<Frame>& frames) {
  EXPECT_GE(frames.size(), 6u);
  EXPECT_LE(frames.size(), 18u);
}

TEST(MotionFacts, EnergyOfASpringGoesAsItsMethodSays) {
  const auto frames = frames_of("stiff_spring");
  expect_as_long_as_a_lecture_wants(frames);
  for (const Frame* frame : of_step(frames, "swing")) {
    const double steps = std::round(frame->time / 0.1);
    const double grown = std::pow(1.25, steps);  // 1 + (omega h)^2
    const double explicit_energy = 2 * grown, implicit_energy = 2 / grown;
    const double rk4_energy = 2 * std::pow(1 - 1.0 / 64 / 72 + 1.0 / 256 / 576, steps);
    EXPECT_NEAR(measure(*frame, "energy.explicit Euler"), explicit_energy, 1e-9 * explicit_energy);
    EXPECT_NEAR(measure(*frame, "energy.implicit Euler"), implicit_energy, 1e-9);
    EXPECT_NEAR(measure(*frame, "energy.Runge-Kutta 4"), rk4_energy, 1e-9);
    // v^2 + k x^2 + h k x v is kept exactly by kick, then drift.
    const FrameBody& bob = body(*frame, "semi-implicit Euler");
    const double x = bob.position.x - 4.5, v = bob.velocity.x;
    EXPECT_NEAR((v * v + 25 * x * x - 2.5 * x * v) / 2, 2, 1e-9);
  }
  for (const char* event : {"beyond_two", "beyond_all"})
    for (const Frame* frame : of_step(frames, event))
      EXPECT_NEAR(measure(*frame, "energy.implicit midpoint"),
                  std::string(event) == "beyond_two" ? 32.32 : 72, 1e-8)
          << "it has no limit";
  EXPECT_GT(measure(*of_step(frames, "beyond_two").back(), "energy.semi-implicit Euler"), 1000)
      << "omega h is beyond 2";
  const auto beyond = of_step(frames, "beyond_all");
  for (std::size_t i = 1; i < beyond.size(); ++i)
    EXPECT_NEAR(measure(*beyond[i], "energy.Runge-Kutta 4") /
                    measure(*beyond[i - 1], "energy.Runge-Kutta 4"),
                2.265625 * 2.265625, 1e-8)
        << "a frame is two steps";
}

TEST(MotionFacts, ChartOfTheStiffSpringBeginsAnewWithEachPart) {
  const auto frames = frames_of("stiff_spring");
  for (const char* event : {"start", "stiffer", "stiffest"})
    for (const FrameSeries& series : at(frames, event).get<FrameChart>().series)
      EXPECT_LE(series.points.size(), 1u) << event << ": " << series.name;
  const FrameChart& recap = at(frames, "recap").get<FrameChart>();
  for (const FrameSeries& series : recap.series)
    EXPECT_EQ(series.points.size(), 4u) << series.name << ": one a frame";
}

TEST(MotionFacts, TheBoxTurnsOverAndOnlyExplicitEulerWinsEnergy) {
  const auto frames = frames_of("tumbling_box");
  expect_as_long_as_a_lecture_wants(frames);
  int turns = 0;
  double last = 5;
  for (const Frame& frame : frames) {
    const double spin = measure(frame, "own_spin_y.exact");
    turns += spin * last < 0 ? 1 : 0;
    last = spin;
    EXPECT_NEAR(measure(frame, "angular_momentum.exact"), 1230.3547537, 1e-6);
    EXPECT_NEAR(measure(frame, "energy.exact"), 3076.71, 6);
  }
  EXPECT_EQ(turns, 2) << "by Euler's equations at 1.17 s and 4.19 s";
  EXPECT_NEAR(measure(at(frames, "upside_down"), "own_spin_y.exact"), -4.985, 0.02);
  EXPECT_GT(measure(frames.back(), "energy.explicit Euler"), 1.3 * 3076.71);
}

// Of the side with that name.
const Frame& side(const Frame& frame, const std::string& name) {
  const Frame* found = frame.side_named(name);
  EXPECT_NE(found, nullptr) << name;
  return *found;
}

TEST(MotionFacts, OnlyWithSweepsDepthGrowsWithTheMassRatio) {
  const auto frames = frames_of("heavy_on_light");
  const char* kUnder[] = {"penetration.under x100", "penetration.under x10000"};
  const Frame& pressed = *of_step(frames, "impulses").back();
  const Frame& ten = side(pressed, "ten sweeps");
  EXPECT_GT(measure(ten, kUnder[1]), 5 * measure(ten, kUnder[0]));
  EXPECT_GT(measure(side(pressed, "thousand sweeps"), kUnder[1]), 0.03);
  for (const Frame* frame : of_step(frames, "impulses"))
    for (const char* name : kUnder)
      EXPECT_LT(measure(side(*frame, "all at once"), name), 1e-6) << name;
  // As if nothing were below it: g t (t + h) / 2, but for what the last sweeps stop.
  const double t = 0.2;
  EXPECT_NEAR(2 - body(side(at(frames, "sinks"), "ten sweeps"), "heaviest box").position.y,
              5 * t * (t + 1.0 / 60), 0.03);
}

}  // namespace
}  // namespace lantern::run
