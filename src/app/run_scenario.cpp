#include "app/run_scenario.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "app/commands/command.hpp"
#include "app/false_references.hpp"
#include "app/frame_folder.hpp"
#include "app/missing_letters.hpp"
#include "app/progress.hpp"
#include "app/scenario_folder.hpp"
#include "app/terminal.hpp"
#include "base/memory.hpp"
#include "base/stop.hpp"
#include "draw/page.hpp"
#include "scenario/warnings.hpp"

namespace lantern::app {

Pace pace_of(std::string_view word, const Scenario& scenario) {
  if (word.empty()) return scenario.pace;
  return word == word_for(Pace::event, kPaces) ? Pace::event : Pace::step;
}

std::optional<Scenario> load_or_complain(const std::string& file, int& code) try {
  Scenario scenario = load_scenario(scenario_file(file));
  if (!scenario.file_stem.empty())
    say(fmt::format("'{}' is called '{}': names are of a–z, 0–9 and _", file, scenario.name));
  return scenario;
} catch (const ScenarioError& e) {
  complain(e);
  code = std::max<int>(code, kBadScenario);
  return std::nullopt;
} catch (const IoError& e) {
  complain(e.what());
  code = std::max<int>(code, kFailed);
  return std::nullopt;
}

RunResult run_scenario(const Scenario& scenario, Pace pace, FrameSink& sink, Work& work,
                       std::optional<std::uint64_t> chosen, std::uint64_t in_betweens) {
  RunExtent extent = extent_of(scenario, pace);
  extent.chosen = chosen;
  extent.in_betweens = in_betweens;
  Progress progress(scenario.name, extent, work, memory_budget(), [&] { return sink.waiting(); });
  RunWatch watch(scenario, shows_a_body);
  std::uint64_t frames = 0;
  RunResult result;
  result.report = direct(
      scenario, pace, work,
      [&](const Frame& frame) {
        stop_if_asked();
        sink.frame(frame);
        progress.done(++frames);
        return true;
      },
      &watch);
  sink.finish(result.report);
  result.warnings = warnings_of_file(scenario);
  for (Diagnostic& found : false_references(scenario)) result.warnings.push_back(std::move(found));
  for (Diagnostic& found : watch.warnings()) result.warnings.push_back(std::move(found));
  for (Diagnostic& found : missing_letters(scenario)) result.warnings.push_back(std::move(found));
  result.facts = watch.facts();
  return result;
}

std::vector<Diagnostic> unmet_of(const RunResult& result) {
  return result.report.unmet.list("that do not hold");
}

int tell(const RunResult& result, bool strict) {
  complain(unmet_of(result));
  std::vector<Diagnostic> warnings = result.warnings;
  for (Diagnostic& d : warnings) d.severity = strict ? Severity::error : Severity::warning;
  complain(warnings);
  const int code = result.report.unmet.empty() ? kGood : kFailed;
  return strict && !warnings.empty() ? std::max<int>(code, kBadScenario) : code;
}

int exit_code_of(const ScenarioError& error) {
  return dynamic_cast<const BrokenStructure*>(&error) ? kFailed : kBadScenario;
}

void write(JsonWriter& json, const Work& work) {
  json.begin_object();
  for (const auto& [stage, count] : work.listed()) json.member(stage, count);
  json.end_object();
}

}  // namespace lantern::app
