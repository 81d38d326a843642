#include "measure/error_metric.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "base/check.hpp"
#include "base/error.hpp"
#include "measure/contact_metrics.hpp"
#include "measure/smooth_metrics.hpp"

namespace lantern {

std::unique_ptr<ErrorMetric> make_error_metric(const Scenario& scenario) {
  if (!scenario.problem) throw Refused("the scenario has no [problem]");
  switch (scenario.problem->solution) {
    case Solution::projectile:
      return projectile_metric(scenario);
    case Solution::oscillator:
      return oscillator_metric(scenario);
    case Solution::chain:
      return chain_metric(scenario);
    case Solution::kepler:
      return kepler_metric(scenario);
    case Solution::pendulum:
      return pendulum_metric(scenario);
    case Solution::free_top:
      return free_top_metric(scenario);
    default:
      return contact_metric(scenario);
  }
}

void TrajectoryMetric::look(const Observation& now) {
  exact_.clear();
  exact(now.time, exact_);
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
