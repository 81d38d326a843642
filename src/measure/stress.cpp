#include "measure/stress.hpp"

#include <exception>
#include <utility>

#include "base/stop.hpp"

namespace lantern {

StressResult at_most(double bound, double figure, std::string unit, std::string detail) {
  return {figure, std::move(unit), bound, false, figure <= bound, std::move(detail)};
}

StressResult at_least(double bound, double figure, std::string unit, std::string detail) {
  return {figure, std::move(unit), bound, true, figure >= bound, std::move(detail)};
}

std::span<const StressCase> stress_cases() {
  static const std::vector<StressCase> cases = [] {
    std::vector<StressCase> all;
    add_tree_cases(all);
    add_input_cases(all);
    add_shape_cases(all);
    add_origin_cases(all);
    add_step_cases(all);
    add_impact_cases(all);
    add_friction_cases(all);
    add_stiff_cases(all);
    add_stability_cases(all);
    add_bar_cases(all);
    return all;
  }();
  return cases;
}

StressOutcome run_case(const StressCase& stress_case) {
  StressOutcome outcome{stress_case, {}};
  try {
    outcome.result = stress_case.run();
  } catch (const Stopped&) {
    throw;
  } catch (const std::exception& error) {
    outcome.result.detail = error.what();
  }
  return outcome;
}

}  // namespace lantern
