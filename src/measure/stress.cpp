#include "measure/stress.hpp"

#include <iterator>

#include <fmt/format.h>

#include "embedded/stress_scenarios.hpp"
#include "run/director.hpp"

namespace lantern::measure {

StressResult at_most(double bound, double figure, std::string unit, std::string detail) {
  return {figure, std::move(unit), bound, false, figure <= bound, std::move(detail)};
}

StressResult at_least(double bound, double figure, std::string unit, std::string detail) {
  return {figure, std::move(unit), bound, true, figure >= bound, std::move(detail)};
}

namespace {

// All that the scenario expects must hold.
StressResult as_expected(const Scenario& scenario) {
  Work work;
  const DirectorReport report =
      direct(scenario, Pace::step, work, [](const Frame&) { return true; });
  std::string detail = fmt::format("do not hold, of {}", report.expectations);
  if (!report.unmet.empty()) detail += "; first: " + report.unmet.told().front().message;
  return at_most(0, static_cast<double>(report.unmet.count()), "expectations", std::move(detail));
}

// The files of scenarios/stress/: what must happen is the scenario's idea, its source the group.
std::vector<StressCase> scenario_cases() {
  static std::vector<Scenario> scenarios;
  for (const auto& [name, text] : stress_scenario::files())
    scenarios.push_back(parse_scenario(text, fmt::format("scenarios/stress/{}.toml", name)));
  std::vector<StressCase> cases;
  for (const Scenario& one : scenarios)
    cases.push_back({one.name, one.source, one.idea, [&one] { return as_expected(one); }});
  return cases;
}

}  // namespace

std::span<const StressCase> stress_cases() {
  static const std::vector<StressCase> cases = [] {
    std::vector<StressCase> all;
    for (StressTopic* const topic :
         {tree_cases, input_cases, shape_cases, origin_cases, step_cases, contact_cases,
          stiff_cases, stability_cases, energy_cases, bar_cases, scenario_cases})
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
