#include "measure/yardstick.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "base/check.hpp"
#include "base/error.hpp"
#include "measure/yardsticks_contact.hpp"
#include "measure/yardsticks_smooth.hpp"

namespace lantern {

std::unique_ptr<Yardstick> make_yardstick(const Scenario& scenario) {
  if (!scenario.problem) throw Refused("the scenario has no [problem]");
  switch (scenario.problem->solution) {
    case Solution::projectile:
      return projectile_yardstick(scenario);
    case Solution::oscillator:
      return oscillator_yardstick(scenario);
    case Solution::chain:
      return chain_yardstick(scenario);
    case Solution::kepler:
      return kepler_yardstick(scenario);
    case Solution::pendulum:
      return pendulum_yardstick(scenario);
    case Solution::free_top:
      return free_top_yardstick(scenario);
    default:
      return contact_yardstick(scenario);
  }
}

void Trajectory::look(const Observation& now) {
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
