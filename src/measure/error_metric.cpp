#include "measure/error_metric.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "base/check.hpp"
#include "base/error.hpp"
#include "measure/error_metrics.hpp"

namespace lantern {

std::unique_ptr<ErrorMetric> make_error_metric(const Scenario& scenario) {
  constexpr std::pair<Solution, MakeErrorMetric*> kMetrics[] = {
      {Solution::projectile, projectile_metric},
      {Solution::oscillator, oscillator_metric},
      {Solution::chain, chain_metric},
      {Solution::kepler, kepler_metric},
      {Solution::pendulum, pendulum_metric},
      {Solution::free_top, free_top_metric},
      {Solution::bouncing_ball, bouncing_ball_metric},
      {Solution::blocks_and_wall, blocks_and_wall_metric},
      {Solution::collisions, collisions_metric},
      {Solution::billiards, billiards_metric},
      {Solution::slide, slide_metric},
      {Solution::slip_then_roll, slip_then_roll_metric},
      {Solution::incline, incline_metric},
      {Solution::topple, topple_metric},
      {Solution::stack, stack_metric},
      {Solution::hanging_chain, hanging_chain_metric}};
  if (!scenario.problem) throw Refused("the scenario has no [problem]");
  for (const auto& [solution, make] : kMetrics)
    if (solution == scenario.problem->solution) return make(scenario);
  LANTERN_CHECK(to_string(scenario.problem->solution), ==, std::string_view("a known solution"));
  return nullptr;
}

Norm trajectory_norm(double value, double length, double speed) {
  return {"traj", value, "1",
          fmt::format("largest distance from the reference over the run: |Δx| / {:.3g} units or "
                      "|Δv| / {:.3g} units/s, whichever is larger",
                      length, speed)};
}

TrajectoryMetric::TrajectoryMetric(long double length, long double speed, ExactStates exact)
    : length_(static_cast<double>(length)),
      speed_(static_cast<double>(speed)),
      exact_at_(std::move(exact)) {}

void TrajectoryMetric::look(const Observation& now) {
  exact_.clear();
  exact_at_(now.time, exact_);
  for (const Exact& e : exact_) {
    LANTERN_CHECK(e.body, <, now.states.size());
    const BodyState& state = now.states[e.body];
    if (!state.there) throw Refused("a body of the problem is not there");
    const double error = std::max(glm::length(state.position - e.position) / length_,
                                  glm::length(state.velocity - e.velocity) / speed_);
    // What is not a number stays so.
    const bool finite = std::isfinite(glm::dot(state.position, state.velocity));
    if (!finite) worst_ = std::numeric_limits<double>::quiet_NaN();
    if (error > worst_) worst_ = error;
  }
}

}  // namespace lantern
