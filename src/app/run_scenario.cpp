#include "app/run_scenario.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <sstream>

#include <fmt/format.h>

#include "app/commands/command.hpp"
#include "app/folders/frame_folder.hpp"
#include "app/lab.hpp"
#include "app/progress.hpp"
#include "app/terminal.hpp"
#include "app/trial.hpp"
#include "base/memory.hpp"
#include "base/printable.hpp"
#include "base/stop.hpp"
#include "base/suggest.hpp"
#include "draw/font.hpp"
#include "draw/page.hpp"
#include "language/text/problems.hpp"
#include "run/warnings.hpp"
#include "run/watcher.hpp"

namespace lantern::app {

namespace {

constexpr const char* kInstalled = "lantern/scenarios";  // below share/

// Every place to look, there or not.
std::vector<fs::path> places() {
  std::error_code error;
  const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
  // build/lantern, build/debug/lantern
  std::vector<fs::path> all = {"scenarios", here.parent_path() / "share" / kInstalled,
                               here.parent_path() / "scenarios",
                               here.parent_path().parent_path() / "scenarios"};
  const char* set = std::getenv("XDG_DATA_DIRS");
  std::istringstream folders(set && *set ? set : "/usr/local/share:/usr/share");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (folder.starts_with('/')) all.push_back(fs::path(folder) / kInstalled);
  return all;
}

// In a folder itself, then among its problems and what is stress.
constexpr const char* kSubfolders[] = {"", "problems", "stress"};

std::optional<fs::path> find_named(const std::string& name, const std::vector<fs::path>& folders) {
  std::error_code error;
  for (const fs::path& folder : folders)
    for (const char* sub : kSubfolders)
      if (fs::path file = folder / sub / (name + ".toml"); fs::is_regular_file(file, error))
        return file.lexically_normal();
  return std::nullopt;
}

// As far as the folder can be listed; `error` tells what was in the way.
std::vector<fs::path> toml_files(const fs::path& folder, std::error_code& error) {
  std::vector<fs::path> files;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (it->path().extension() == ".toml") files.push_back(it->path());
  return files;
}

std::string nearest_of(const std::string& name, const std::vector<std::string>& names) {
  const std::vector<std::string_view> known(names.begin(), names.end());
  const std::string near = suggestion(name, known, 0);
  if (!near.empty()) return near;
  constexpr std::size_t kMost = 5;
  std::vector<std::string_view> holding;
  for (const std::string_view one : known)
    if (!name.empty() && one.find(name) != one.npos && holding.size() < kMost)
      holding.push_back(one);
  return holding.empty() ? "'lantern list' names those that there are"
                         : fmt::format("did you mean '{}'?", fmt::join(holding, "', '"));
}

// In the order of a lecture; those that have no place in it come last.
void add_folder(const fs::path& folder, std::vector<std::string>& files) {
  std::error_code error, unknown;
  std::vector<fs::path> there = toml_files(folder, error);
  if (error) throw IoError("cannot list '{}': {}", folder.string(), error.message());
  std::erase_if(there, [&](const fs::path& path) { return fs::is_directory(path, unknown); });
  std::ranges::sort(there);
  for (const fs::path& below : fs::directory_iterator(folder))
    if (std::ranges::find(kSubfolders, below.filename().string()) == std::end(kSubfolders) &&
        std::ranges::any_of(toml_files(below, unknown), &Glance::is_scenario, glance_at))
      say(fmt::format("scenarios in '{}' are not read: name that folder, too", below.string()));
  std::vector<std::pair<std::uint64_t, std::string>> lessons;
  for (const fs::path& path : there) {
    const Glance glance = glance_at(path.string());
    if (glance.is_scenario)
      lessons.emplace_back(glance.lecture.value_or(std::numeric_limits<std::uint64_t>::max()),
                           path.string());
    else
      warn(fmt::format("'{}' is no scenario: it is left out", path.string()));
  }
  if (lessons.empty())
    throw UsageError(
        "there is no scenario in the folder '{}'; a scenario is a .toml file right in it",
        folder.string());
  std::ranges::sort(lessons);
  for (auto& [place, file] : lessons) files.push_back(std::move(file));
}

// The bytes of Debian's Japanese typeface; none where it is not installed.
std::string japanese_typeface() {
  constexpr const char* kFile = "/usr/share/fonts/opentype/ipaexfont-gothic/ipaexg.ttf";
  constexpr std::size_t kMostBytes = std::size_t{1} << 25;
  std::error_code error;
  return fs::is_regular_file(kFile, error) ? read_file(kFile, kMostBytes) : "";
}

// Of all texts that come onto a page, each letter once, in order.
void find_missing(const Scenario& scenario, std::u32string& letters) {
  const auto look_at = [&](std::string_view text) {
    while (!text.empty()) {
      const Letter letter = first_letter(text);
      text.remove_prefix(letter.bytes);
      if (letter.code && !has_glyph(*letter.code) && letters.find(*letter.code) == letters.npos)
        letters += *letter.code;
    }
  };
  for (const std::string& text : language::texts_of(scenario)) look_at(text);
  for (const BodySpec& body : scenario.bodies) look_at(body.called());
  for (const TextureSpec& texture : scenario.textures) look_at(texture.name);
  if (scenario.words)
    for (const auto& [english, said] : scenario.words->said) look_at(said);
}

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

void add_missing_letters(const Scenario& scenario, std::vector<Diagnostic>& found) {
  constexpr std::size_t kMost = 5;
  std::u32string letters;
  find_missing(scenario, letters);
  if (letters.empty()) return;
  std::vector<std::string> some;
  for (const char32_t letter : letters.substr(0, kMost)) append_utf8(some.emplace_back(), letter);
  found.push_back(warning(
      scenario, place_in(scenario, some.front()),
      fmt::format(
          "the bundled typeface has no '{}'{}: a picture shows a box in its place",
          fmt::join(some, "', '"),
          letters.size() > kMost ? fmt::format(" and {} more", letters.size() - kMost) : ""),
      "Inter has Latin, Greek and Cyrillic letters; Japanese ones come with the package "
      "fonts-ipaexfont-gothic"));
}

void add_missing_words(const Scenario& scenario, std::vector<Diagnostic>& found) {
  constexpr std::size_t kMost = 5;
  if (!scenario.words) return;
  if (!scenario.words->idle.empty())
    found.push_back(
        warning(scenario, {scenario.file, 0, 0},
                fmt::format("its texts in '{}' have \"{}\", which it does not say",
                            scenario.words->language, fmt::join(scenario.words->idle, "\", \"")),
                "`lantern reference --texts` prints what it says"));
  if (scenario.words->missing.empty()) return;
  const std::vector<std::string>& missing = scenario.words->missing;
  const auto some = std::min(missing.size(), kMost);
  found.push_back(warning(
      scenario, {scenario.file, 0, 0},
      fmt::format(
          "the words for '{}' lack \"{}\"{}: they stay as they are", scenario.words->language,
          fmt::join(missing.begin(), missing.begin() + static_cast<std::ptrdiff_t>(some), "\", \""),
          missing.size() > some ? fmt::format(" and {} more", missing.size() - some) : ""),
      "`lantern reference --words de` prints a table that has them all"));
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
  std::vector<std::string> names;  // of all scenarios there, as far as they can be read
  for (std::size_t i = 0; i < scenario.needs.size(); ++i) {
    const std::string& need = scenario.needs[i];
    const auto add = [&](const std::string& message, const std::string& suggestion) {
      found.push_back(warning(scenario, scenario.needs_at[i], message,
                              suggestion + if_meant(scenario, Warning::needs)));
    };
    const auto earlier = scenario.needs.begin() + static_cast<std::ptrdiff_t>(i);
    if (need == scenario.name) {
      add(fmt::format("'{}' cannot be seen before itself", need), "leave it out");
    } else if (std::find(scenario.needs.begin(), earlier, need) != earlier) {
      add(fmt::format("'{}' is to be seen before, and is named twice", need), "leave it out");
    } else if (!is_there(need)) {
      std::error_code error;
      if (names.empty())
        for (const fs::path& folder : folders)
          for (const fs::path& file : toml_files(folder, error))
            names.push_back(glance_at(file.string()).name);
      if (std::ranges::find(names, need) == names.end())
        add(fmt::format("there is no scenario '{}' to be seen before", need),
            nearest_of(need, names));
    }
  }
}

void add_problem(const Scenario& scenario, std::vector<Diagnostic>& found) {
  if (!scenario.problem || scenario.is_quiet(Warning::problem)) return;
  const Lab* lab = find_lab();  // who else would know its answer
  if (lab == nullptr) return;
  try {
    lab->require_problem(scenario);
  } catch (const Refused& refused) {
    found.push_back(warning(scenario, scenario.problem->where, refused.what(),
                            "'lantern measure' would refuse it: give it the solution that it "
                            "has, or leave out [problem]" +
                                if_meant(scenario, Warning::problem)));
  }
}

}  // namespace

std::vector<fs::path> scenario_folders() {
  std::vector<fs::path> there;
  std::error_code error;
  for (const fs::path& folder : places())
    if (fs::is_directory(folder, error)) there.push_back(folder.lexically_normal());
  return there;
}

std::string scenario_file(const std::string& words) {
  std::error_code error;
  const bool is_path = words.find('/') != std::string::npos || words.ends_with(".toml");
  if (words.empty() || words == "-" || is_path || fs::exists(words, error)) return words;
  const std::vector<fs::path> folders = scenario_folders();
  if (const auto file = find_named(words, folders)) {
    say(fmt::format("'{}' is {}", words, file->string()));
    return file->string();
  }
  std::vector<std::string> names;
  for (const fs::path& folder : folders)
    for (const char* sub : kSubfolders)
      for (const fs::path& file : toml_files(folder / sub, error))
        names.push_back(file.stem().string());
  std::ranges::sort(names);
  names.erase(std::ranges::unique(names).begin(), names.end());
  throw IoError("there is no file '{}' and no scenario of that name; {}", words,
                fs::exists(words + ".toml", error) ? fmt::format("there is '{}.toml'", words)
                                                   : nearest_of(words, names));
}

std::vector<std::string> input_files(const std::vector<std::string>& words) {
  if (std::ranges::count(words, "-") > 1)
    throw UsageError("- is standard input, which can be read once only");
  std::vector<std::string> files;
  for (const std::string& word : words) {
    std::error_code error;
    if (word != "-" && fs::is_directory(word, error))
      add_folder(word, files);
    else
      files.push_back(word);
  }
  return files;
}

std::vector<std::string> listed_files(std::vector<std::string> words) {
  if (words.empty()) {
    const auto folders = scenario_folders();
    if (folders.empty()) throw UsageError("there is no folder scenarios here: name one");
    if (folders.front() != "scenarios") say(fmt::format("from {}", folders.front().string()));
    words.push_back(folders.front().string());
  }
  return input_files(words);
}

// ---- What is said of a scenario that is run

Pace pace_of(std::string_view word, const Scenario& scenario) {
  if (word.empty()) return scenario.pace;
  return word == word_for(Pace::event, kPaces) ? Pace::event : Pace::step;
}

language::Wording& wording() {
  static language::Wording asked;
  return asked;
}

std::optional<Scenario> load_or_complain(const std::string& file, int& code, std::string* why) {
  const auto refused = [&](const std::exception& error, int its_code) {
    code = std::max(code, its_code);
    if (why != nullptr) *why = error.what();
    return std::nullopt;
  };
  try {
    Scenario scenario = load_scenario(scenario_file(file), wording());
    const auto& words = scenario.words;
    static bool told = false;  // once a run
    if (words && words->texts.empty() && words->language == wording().language &&
        words->language != scenario.language && !std::exchange(told, true))
      say(
          fmt::format("captions without texts in '{0}' stay as they are: there is no {0}/{1}.toml; "
                      "`lantern reference --texts {1}` prints one to fill in",
                      words->language, scenario.name));
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
  const Speaking speaking(scenario.words.get());
  draw::set_more_letters(japanese_typeface);
  extent.pictures = sink.pictures();
  Progress progress(scenario.name, extent, work, memory_budget(), [&] { return sink.waiting(); });
  Trials trials([&] { return progress.long_left(); }, work);
  RunWatch watch(scenario, shows_a_body, &trials);
  RunResult result;
  result.report = direct(
      scenario, pace, work,
      [&](const Frame& frame) {
        stop_if_asked();
        sink.frame(frame);
        progress.done(frame.index + std::uint64_t{1});
        return true;
      },
      &watch, sink.wants());
  sink.finish(result.report);
  result.warnings = warnings_of_file(scenario);
  add_needs(scenario, result.warnings);
  add_problem(scenario, result.warnings);
  std::ranges::move(watch.warnings(), std::back_inserter(result.warnings));
  add_missing_letters(scenario, result.warnings);
  add_missing_words(scenario, result.warnings);
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
