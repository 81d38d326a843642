// Yardsticks of the problems in which bodies touch. All read masses, places, speeds and materials
// from the scenario, and throw Refused, naming scenario and reason, if it is another problem.
#pragma once

#include <memory>

#include "measure/yardstick.hpp"

namespace lantern {

// Of a scenario with a [problem]; null if its solution is not one of these.
std::unique_ptr<Yardstick> contact_yardstick(const Scenario& scenario);

// One each. The norms are explained where the yardstick is made.
std::unique_ptr<Yardstick> bouncing_ball_yardstick(const Scenario& scenario);
std::unique_ptr<Yardstick> blocks_and_wall_yardstick(const Scenario& scenario);
std::unique_ptr<Yardstick> collisions_yardstick(const Scenario& scenario);
std::unique_ptr<Yardstick> billiards_yardstick(const Scenario& scenario);
std::unique_ptr<Yardstick> slide_yardstick(const Scenario& scenario);
std::unique_ptr<Yardstick> slip_then_roll_yardstick(const Scenario& scenario);
std::unique_ptr<Yardstick> incline_yardstick(const Scenario& scenario);
std::unique_ptr<Yardstick> topple_yardstick(const Scenario& scenario);
std::unique_ptr<Yardstick> stack_yardstick(const Scenario& scenario);
std::unique_ptr<Yardstick> hanging_chain_yardstick(const Scenario& scenario);

}  // namespace lantern
