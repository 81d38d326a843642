#include "measure/stress.hpp"

#include <algorithm>
#include <exception>
#include <iterator>
#include <utility>

#include "base/stop.hpp"

namespace lantern::measure {

StressResult at_most(double bound, double figure, std::string unit, std::string detail) {
  return {figure, std::move(unit), bound, false, figure <= bound, std::move(detail)};
}

StressResult at_least(double bound, double figure, std::string unit, std::string detail) {
  return {figure, std::move(unit), bound, true, figure >= bound, std::move(detail)};
}

std::span<const StressCase> stress_cases() {
  static const std::vector<StressCase> cases = [] {
    std::vector<StressCase> all;
    for (StressTopic* const topic :
         {tree_cases, input_cases, shape_cases, origin_cases, step_cases, contact_cases,
          stiff_cases, stability_cases, energy_cases, bar_cases})
      std::ranges::copy(topic(), std::back_inserter(all));
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

}  // namespace lantern::measure
