#include "measure/yardsticks_contact.hpp"

#include <fmt/format.h>

namespace lantern {

std::unique_ptr<Yardstick> contact_yardstick(const Scenario& scenario) {
  if (!scenario.problem) throw Refused(fmt::format("'{}' has no [problem]", scenario.name));
  switch (scenario.problem->solution) {
    case Solution::bouncing_ball:
      return bouncing_ball_yardstick(scenario);
    case Solution::blocks_and_wall:
      return blocks_and_wall_yardstick(scenario);
    case Solution::collisions:
      return collisions_yardstick(scenario);
    case Solution::billiards:
      return billiards_yardstick(scenario);
    case Solution::slide:
      return slide_yardstick(scenario);
    case Solution::slip_then_roll:
      return slip_then_roll_yardstick(scenario);
    case Solution::incline:
      return incline_yardstick(scenario);
    case Solution::topple:
      return topple_yardstick(scenario);
    case Solution::stack:
      return stack_yardstick(scenario);
    case Solution::hanging_chain:
      return hanging_chain_yardstick(scenario);
    default:
      return nullptr;
  }
}

}  // namespace lantern
