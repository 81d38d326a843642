#include "measure/problems.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/check.hpp"
#include "embedded/problems.hpp"

namespace lantern::measure {

std::vector<std::string_view> problem_names() {
  std::vector<std::string_view> names;
  for (const auto& [name, text] : problem::files()) names.push_back(name);
  std::ranges::sort(names);
  return names;
}

Scenario known_problem(std::string_view name) {
  for (const auto& [known, text] : problem::files())
    if (known == name) return parse_scenario(text, fmt::format("scenarios/problems/{}.toml", name));
  LANTERN_CHECK(name, ==, std::string_view("a known problem"));
  return Scenario(ScenarioSpec());
}

}  // namespace lantern::measure
