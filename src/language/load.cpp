// Scenario files on a disk.
#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/file.hpp"
#include "base/suggest.hpp"
#include "language/language.hpp"
#include "language/scenario.hpp"
#include "language/tables/draft.hpp"
#include "language/words.hpp"

namespace lantern::language {
namespace {

WordTable read_words_file(const std::string& path, const WordTable& base) {
  return read_words(read_input(path, kMostFileBytes), path, base);
}

// In the words that are asked for, if any are.
Scenario worded(Scenario scenario, const Wording& wording) {
  const std::string& language = wording.language.empty() ? scenario.language : wording.language;
  const fs::path file(scenario.file);
  std::string words = wording.words;
  if (words.empty() && wording.language.empty() && !scenario.words_file.empty())
    words = (file.parent_path() / scenario.words_file).string();
  const bool foreign = !language.empty() && language != "en";
  if (words.empty() && !foreign) return scenario;
  const auto shipped = words_in(language);
  if (words.empty() && !shipped) {
    Diagnostic unknown = diagnose(scenario, {scenario.file, 0, 0},
                                  fmt::format("there are no words for the language '{}'", language),
                                  suggestion(language, languages()));
    unknown.suggestion += "; others are read from a file: words = \"sv.toml\"";
    throw ScenarioError(unknown);
  }
  WordTable table = shipped ? *shipped : WordTable();
  if (!words.empty()) table = read_words_file(words, table);
  const fs::path own = file.parent_path() / table.language / file.filename();
  std::error_code error;
  table.idle.clear();  // of a table for many scenarios
  if (fs::is_regular_file(own, error)) table = read_words_file(own.string(), table);
  if (wording.language.empty() && wording.words.empty()) scenario.language = table.language;
  translate(scenario, table);
  return scenario;
}

}  // namespace

Scenario load_scenario(const std::string& path) { return load_scenario(path, Wording()); }

Scenario load_scenario(const std::string& path, const Wording& wording) {
  if (path == "-")
    return worded(parse_scenario(read_stdin(kMostFileBytes), std::string(kStandardInput)), wording);
  std::error_code error;
  if (fs::is_regular_file(path, error)) {
    const std::uintmax_t bytes = fs::file_size(path, error);
    if (!error && bytes > kMostFileBytes) refuse_size(path, bytes);
  }
  return worded(parse_scenario(read_input(path, kMostFileBytes), path), wording);
}

Glance glance_at(const std::string& path) try {
  Problems problems;
  const std::string bytes = read_file(path, kMostFileBytes);
  const TomlTable table = read_toml(without_mark(bytes), problems);
  Glance glance;
  glance.name = fs::path(path).stem().string();
  if (problems.any() || table.empty()) return glance;
  if (const auto* name = value_of<std::string>(table, "name")) glance.name = *name;
  glance.is_scenario = !entry_of(table, "texts") && std::ranges::any_of(table, [](const auto& one) {
    return language_table("").find(one.key) != nullptr;
  });
  if (const auto* place = value_of<std::int64_t>(table, "lecture");
      place && std::in_range<std::uint32_t>(*place))
    glance.lecture = static_cast<std::uint32_t>(*place);
  return glance;
} catch (const IoError&) {
  return {};
}

}  // namespace lantern::language
