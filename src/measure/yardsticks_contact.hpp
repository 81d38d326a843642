// The yardsticks of problems whose bodies touch.
#pragma once

#include <memory>

#include "measure/yardstick.hpp"

namespace lantern {

// Of a scenario whose [problem] is any of those from `bouncing_ball` on. Throws Refused, naming
// what is wrong, if the scenario is not that problem.
std::unique_ptr<Yardstick> contact_yardstick(const Scenario& scenario);

}  // namespace lantern
