// The order of each method on each smooth problem: how its error shrinks with the step, over four
// halvings, above the rounding floor and below where the step is too long to tell.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "measure/forms/closed_forms.hpp"
#include "measure/plan.hpp"
#include "measure/solvers.hpp"
#include "physics/body.hpp"

namespace lantern::measure {
namespace {

Row run(const Scenario& scenario, const Solver& solver, double step) {
  const Schedule schedule = Schedule::of(scenario);
  const Reference reference = reference_for(scenario, schedule, step);
  const Invariants invariants(scenario);
  return evaluated({scenario, schedule, invariants, reference}, solver, schedule.fitted_step(step));
}

struct Run {
  double error = HUGE_VAL;
  double step = 0;  // as it was fitted to the problem's samples
};

Run run_of(const Scenario& scenario, const std::string& method, double step) {
  const Row row = run(scenario, LanternSolver(*method_named(method)), step);
  EXPECT_EQ(row.status, Status::ok) << scenario.name << " by " << method << ": " << row.reason;
  return {row.error().value_or(HUGE_VAL), row.step};
}

// Of each of four halvings from `step` on.
void expect_order(const Scenario& scenario, const std::string& method, double order, double step) {
  Run before = run_of(scenario, method, step);
  for (int i = 0; i < 4; ++i) {
    step /= 2;
    const Run now = run_of(scenario, method, step);
    EXPECT_NEAR(std::log(before.error / now.error) / std::log(before.step / now.step), order, 0.1)
        << scenario.name << " by " << method << ", error " << now.error << " at step " << now.step;
    before = now;
  }
}

Scenario shortened(std::string_view name, double seconds) {
  Scenario scenario = known_problem(name);
  scenario.problem->seconds = seconds;
  return scenario;
}

// What each problem needs to show the orders of all integrators.
struct Steps {
  const char* problem;
  double seconds;
  double first_order, second_order, fourth_order;
};
constexpr Steps kSteps[] = {
    {"projectile", 2, 0.01, 0.1, 0.1},
    {"oscillator", 1.03, 0.002, 0.01, 0.04},
    {"oscillator_damped", 1.03, 0.002, 0.01, 0.04},
    {"chain", 1.3, 0.001, 0.005, 0.01},
    {"kepler", 2.3, 0.002, 0.01, 0.02},
    {"kepler_pair", 2.3, 0.002, 0.01, 0.04},
};

TEST(SmoothOrders, ExplicitAndImplicitEulerAreOfFirstOrder) {
  for (const Steps& s : kSteps)
    for (const char* method : {"explicit_euler", "semi_implicit_euler", "implicit_euler"})
      expect_order(shortened(s.problem, s.seconds), method, 1, s.first_order);
}

TEST(SmoothOrders, VerletAndImplicitMidpointAreOfSecondOrder) {
  for (const Steps& s : kSteps)
    for (const char* method : {"velocity_verlet", "implicit_midpoint"})
      expect_order(shortened(s.problem, s.seconds), method, 2, s.second_order);
}

TEST(SmoothOrders, RungeKuttaIsOfFourthOrder) {
  for (const Steps& s : kSteps)
    expect_order(shortened(s.problem, s.seconds), "runge_kutta_4", 4, s.fourth_order);
}

// The angle by which a box is off after some time.
double top_error(RotationMethod method, int steps) {
  Body<3> body;
  body.inverse_inertia = {1 / 5.2, 1 / 4.0, 1 / 2.0};
  body.inverse_mass = 1;
  body.angular_momentum = {5, -3, 2};
  const FreeTop top(LongVec(body.inverse_inertia), LongQuat(1, 0, 0, 0),
                    LongVec(body.angular_momentum));
  const double time = 3.3;
  for (int i = 0; i < steps; ++i) turn_freely(body, time / steps, method);
  const glm::dquat q = body.orientation.q;
  const LongQuat off = glm::conjugate(top.orientation(time)) * LongQuat(q.w, q.x, q.y, q.z);
  return static_cast<double>(
      2 * std::atan2(std::sqrt(off.x * off.x + off.y * off.y + off.z * off.z), std::abs(off.w)));
}

TEST(SmoothOrders, ATopIsTurnedToTheOrderOfItsMethod) {
  struct Case {
    RotationMethod method;
    double order;
    int steps;
  };
  for (const auto& [method, order, first] :
       {Case{RotationMethod::splitting_2, 2, 400}, Case{RotationMethod::splitting_4, 4, 40},
        Case{RotationMethod::explicit_gyroscopic, 1, 8000}}) {
    int steps = first;
    double before = top_error(method, steps);
    for (int i = 0; i < 4; ++i) {
      steps *= 2;
      const double error = top_error(method, steps);
      EXPECT_NEAR(std::log2(before / error), order, 0.1)
          << "method " << static_cast<int>(method) << ", error " << error;
      before = error;
    }
  }
}

// Drag of 10^4 times the mass: what is stable gets there, what is not says so.
TEST(SmoothOrders, StiffDragIsRefusedOrRightNeverNonsense) {
  const Scenario feather = known_problem("projectile_stiff");
  for (const char* method : {"implicit_euler", "implicit_midpoint"})
    EXPECT_LT(run_of(feather, method, 1e-5).error, 0.1) << method;
  const Row row = run(feather, LanternSolver(*method_named("explicit_euler")), 0.01);
  EXPECT_EQ(row.status, Status::diverged);
}

TEST(SmoothOrders, DormandPrinceIsAsExactAsItIsAsked) {
  for (const char* name : {"oscillator", "oscillator_damped", "chain", "kepler", "kepler_pair",
                           "kepler_stiff", "projectile"}) {
    const Scenario scenario = known_problem(name);
    const DormandPrinceSolver solver;
    const double step = scenario.problem->step;
    const Row coarse = run(scenario, solver, step), fine = run(scenario, solver, step / 64);
    ASSERT_EQ(coarse.status, Status::ok) << name << ": " << coarse.reason;
    ASSERT_EQ(fine.status, Status::ok) << name << ": " << fine.reason;
    EXPECT_LT(*fine.error(), 1e-9) << name;
    EXPECT_LE(*fine.error(), *coarse.error()) << name;
    EXPECT_GE(fine.counted.force_evaluations, coarse.counted.force_evaluations) << name;
  }
  EXPECT_TRUE(DormandPrinceSolver().cannot(known_problem("pendulum"))) << "it has a rod";
  EXPECT_TRUE(DormandPrinceSolver().cannot(known_problem("free_top"))) << "it turns";
}

}  // namespace
}  // namespace lantern::measure
