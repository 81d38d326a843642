#include "scenario/scenario_name.hpp"

#include "base/check.hpp"
#include "scenario/key.hpp"

namespace lantern::scenario {

std::optional<ScenarioName> ScenarioName::of(std::string_view text) {
  return matches(text, kFilePattern) ? std::optional(ScenarioName(text)) : std::nullopt;
}

ScenarioName name_of(const Scenario& scenario) {
  const auto name = ScenarioName::of(scenario.name);
  LANTERN_CHECK(name ? scenario.name : "a scenario's name", ==, scenario.name);
  return *name;
}

}  // namespace lantern::scenario
