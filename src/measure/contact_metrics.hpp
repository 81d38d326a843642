// ErrorMetrics of the problems in which bodies touch. All read masses, places, speeds and materials
// from the scenario, and throw Refused, naming scenario and reason, if it is another problem.
#pragma once

#include <memory>

#include "measure/error_metric.hpp"

namespace lantern {

// Of a scenario with a [problem]; null if its solution is not one of these.
std::unique_ptr<ErrorMetric> contact_metric(const Scenario& scenario);

// One each. The norms are explained where the metric is made.
std::unique_ptr<ErrorMetric> bouncing_ball_metric(const Scenario& scenario);
std::unique_ptr<ErrorMetric> blocks_and_wall_metric(const Scenario& scenario);
std::unique_ptr<ErrorMetric> collisions_metric(const Scenario& scenario);
std::unique_ptr<ErrorMetric> billiards_metric(const Scenario& scenario);
std::unique_ptr<ErrorMetric> slide_metric(const Scenario& scenario);
std::unique_ptr<ErrorMetric> slip_then_roll_metric(const Scenario& scenario);
std::unique_ptr<ErrorMetric> incline_metric(const Scenario& scenario);
std::unique_ptr<ErrorMetric> topple_metric(const Scenario& scenario);
std::unique_ptr<ErrorMetric> stack_metric(const Scenario& scenario);
std::unique_ptr<ErrorMetric> hanging_chain_metric(const Scenario& scenario);

}  // namespace lantern
