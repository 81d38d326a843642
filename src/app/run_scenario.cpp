#include "app/run_scenario.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "app/commands/command.hpp"
#include "app/folders/frame_folder.hpp"
#include "app/lab.hpp"
#include "app/progress.hpp"
#include "app/scenario_folder.hpp"
#include "app/terminal.hpp"
#include "base/memory.hpp"
#include "base/printable.hpp"
#include "base/stop.hpp"
#include "base/suggest.hpp"
#include "draw/font.hpp"
#include "draw/page.hpp"
#include "language/text/problems.hpp"
#include "run/warnings.hpp"

namespace lantern::app {

namespace {

// Of all texts that come onto a page, each letter once, in order.
class Missing {
 public:
  void look_at(std::string_view text) {
    while (!text.empty()) {
      const Letter letter = first_letter(text);
      text.remove_prefix(letter.bytes);
      if (letter.code && !has_glyph(*letter.code) && letters_.find(*letter.code) == letters_.npos)
        letters_ += *letter.code;
    }
  }
  void look_at(const Scenario& scenario) {
    look_at(scenario.title);
    look_at(scenario.side_title);
    for (const BodySpec& body : scenario.bodies) look_at(body.name);
    for (const TextureSpec& texture : scenario.textures) look_at(texture.name);
    for (const Step& step : scenario.steps) {
      look_at(step.part);
      look_at(step.caption);
      for (const NoteSpec& note : step.notes) look_at(note.text);
    }
    for (const auto& side : scenario.sides) look_at(*side);
  }
  const std::u32string& letters() const { return letters_; }

 private:
  std::u32string letters_;
};

// Where the file first writes it, comments aside; as a whole if it writes it as \u....
SourcePosition place_in(const Scenario& scenario, std::string_view letter) {
  const std::string_view text = without_mark(scenario.text);
  for (std::size_t at = text.find(letter); at != text.npos; at = text.find(letter, at + 1)) {
    const std::size_t line = text.substr(0, at).rfind('\n') + 1;  // 0 in the first line
    if (text[std::min(text.find_first_not_of(" \t", line), at)] == '#') continue;
    const Place place = place_of(text, at);
    return {scenario.file, place.line, place.column};
  }
  return {scenario.file, 0, 0};
}

}  // namespace

std::vector<Diagnostic> missing_letters(const Scenario& scenario) {
  constexpr std::size_t kMost = 5;
  Missing missing;
  missing.look_at(scenario);
  const std::u32string& letters = missing.letters();
  if (letters.empty()) return {};
  std::string list, first;
  for (std::size_t i = 0; i < std::min(letters.size(), kMost); ++i) {
    std::string letter;
    append_utf8(letter, letters[i]);
    if (i == 0) first = letter;
    list += (i > 0 ? ", '" : "'") + letter + "'";
  }
  if (letters.size() > kMost) list += fmt::format(" and {} more", letters.size() - kMost);
  Diagnostic found = diagnose(
      scenario, place_in(scenario, first),
      fmt::format("the bundled typeface has no {}: a picture shows a box in its place", list),
      "Inter has Latin, Greek and Cyrillic letters");
  found.severity = Severity::warning;
  return {found};
}

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
  const Lab* lab = find_lab();  // who else would know its answer
  if (lab == nullptr) return;
  try {
    lab->require_problem(scenario);
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

Pace pace_of(std::string_view word, const Scenario& scenario) {
  if (word.empty()) return scenario.pace;
  return word == word_for(Pace::event, kPaces) ? Pace::event : Pace::step;
}

std::optional<Scenario> load_or_complain(const std::string& file, int& code, std::string* why) {
  const auto refused = [&](const std::exception& error, int its_code) {
    code = std::max(code, its_code);
    if (why != nullptr) *why = error.what();
    return std::nullopt;
  };
  try {
    Scenario scenario = load_scenario(scenario_file(file));
    if (!scenario.file_stem.empty())
      say(fmt::format("'{}' is called '{}': names are of a–z, 0–9 and _", file, scenario.name));
    return scenario;
  } catch (const ScenarioError& e) {
    complain(e);
    return refused(e, kBadScenario);
  } catch (const IoError& e) {
    complain(e.what());
    return refused(e, kFailed);
  }
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
