#include "app/false_references.hpp"

#include <algorithm>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "app/scenario_folder.hpp"
#include "base/suggest.hpp"
#include "measure/error_metric.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

// Of all scenarios there, as far as they can be read.
void add_names(const fs::path& folder, std::vector<std::string>& names) {
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (it->path().extension() == ".toml") names.push_back(glance_at(it->path().string()).name);
}

Diagnostic warning(const Scenario& scenario, Warning kind, const SourcePosition& where,
                   std::string message, const std::string& suggestion) {
  Diagnostic found =
      diagnose(scenario, where, std::move(message), suggestion + if_meant(scenario, kind));
  found.severity = Severity::warning;
  return found;
}

void add_needs(const Scenario& scenario, std::vector<Diagnostic>& found) {
  if (scenario.file == kStandardInput || scenario.is_quiet(Warning::needs)) return;
  std::vector<fs::path> folders = scenario_folders();
  folders.insert(folders.begin(), fs::path(scenario.file).parent_path() / ".");
  // Most files bear their scenario's name: the others need not be read.
  const auto is_there = [&](const std::string& name) {
    std::error_code error;
    return std::ranges::any_of(
        folders, [&](const fs::path& in) { return fs::exists(in / (name + ".toml"), error); });
  };
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scenario.needs.size(); ++i) {
    const std::string& need = scenario.needs[i];
    const auto earlier = scenario.needs.begin() + static_cast<std::ptrdiff_t>(i);
    const bool is_itself = need == scenario.name;
    if (is_itself || std::find(scenario.needs.begin(), earlier, need) != earlier) {
      found.push_back(
          warning(scenario, Warning::needs, scenario.needs_at[i],
                  is_itself ? fmt::format("'{}' cannot be seen before itself", need)
                            : fmt::format("'{}' is to be seen before, and is named twice", need),
                  "leave it out"));
      continue;
    }
    if (is_there(need)) continue;
    if (names.empty())
      for (const fs::path& folder : folders) add_names(folder, names);
    if (std::ranges::find(names, need) != names.end()) continue;
    const std::vector<std::string_view> known(names.begin(), names.end());
    const std::string near = suggestion(need, known, 0);
    found.push_back(warning(scenario, Warning::needs, scenario.needs_at[i],
                            fmt::format("there is no scenario '{}' to be seen before", need),
                            near.empty() ? "'lantern list' names those that there are" : near));
  }
}

void add_problem(const Scenario& scenario, std::vector<Diagnostic>& found) {
  if (!scenario.problem || scenario.is_quiet(Warning::problem)) return;
  try {
    measure::require_problem(scenario);
  } catch (const Refused& refused) {
    found.push_back(warning(scenario, Warning::problem, scenario.problem->where, refused.what(),
                            "'lantern measure' would refuse it: give it the solution that it "
                            "has, or leave out [problem]"));
  }
}

}  // namespace

std::vector<Diagnostic> false_references(const Scenario& scenario) {
  std::vector<Diagnostic> found;
  add_needs(scenario, found);
  add_problem(scenario, found);
  return found;
}

}  // namespace lantern::app
