#include "measure/contact_metrics.hpp"

#include <fmt/format.h>

namespace lantern {

std::unique_ptr<ErrorMetric> contact_metric(const Scenario& scenario) {
  if (!scenario.problem) throw Refused(fmt::format("'{}' has no [problem]", scenario.name));
  switch (scenario.problem->solution) {
    case Solution::bouncing_ball:
      return bouncing_ball_metric(scenario);
    case Solution::blocks_and_wall:
      return blocks_and_wall_metric(scenario);
    case Solution::collisions:
      return collisions_metric(scenario);
    case Solution::billiards:
      return billiards_metric(scenario);
    case Solution::slide:
      return slide_metric(scenario);
    case Solution::slip_then_roll:
      return slip_then_roll_metric(scenario);
    case Solution::incline:
      return incline_metric(scenario);
    case Solution::topple:
      return topple_metric(scenario);
    case Solution::stack:
      return stack_metric(scenario);
    case Solution::hanging_chain:
      return hanging_chain_metric(scenario);
    default:
      return nullptr;
  }
}

}  // namespace lantern
