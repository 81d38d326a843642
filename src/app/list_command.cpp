#include <algorithm>
#include <filesystem>
#include <tuple>

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/run_scenario.hpp"
#include "app/scenario_folder.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/json_writer.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

// scenarios/ here, or the nearest one that came with this program.
fs::path default_folder() {
  const std::vector<fs::path> folders = scenario_folders();
  if (folders.empty()) throw IoError("no folder scenarios here, and none came with this program");
  if (folders.front() != "scenarios") say(fmt::format("from {}", folders.front().string()));
  return folders.front();
}

std::vector<fs::path> scenario_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (it->path().extension() == ".toml") files.push_back(it->path());
  if (error) throw IoError(fmt::format("cannot list '{}': {}", folder.string(), error.message()));
  std::sort(files.begin(), files.end());
  return files;
}

// In the order in which one would teach; those without a place behind the others, by name.
void sort_for_teaching(std::vector<Scenario>& scenarios) {
  std::ranges::stable_sort(scenarios, [](const Scenario& a, const Scenario& b) {
    if (a.lecture.has_value() != b.lecture.has_value()) return a.lecture.has_value();
    return std::tie(a.lecture, a.name) < std::tie(b.lecture, b.name);
  });
}

std::vector<std::string> row_of(const Scenario& s) {
  return {s.lecture ? fmt::format("{}", *s.lecture) : "", s.name, s.title, s.idea,
          s.needs.empty() ? "" : fmt::format("after {}", fmt::join(s.needs, ", "))};
}

void add_member(JsonWriter& json, const Scenario& s) {
  json.line().begin_object().members("name", s.name, "title", s.title, "source", s.source, "idea",
                                     s.idea);
  json.key("lecture");
  s.lecture ? json.value(*s.lecture) : json.null();
  json.key("needs").begin_array();
  for (const std::string& name : s.needs) json.value(name);
  json.end_array();
  json.members("steps", s.steps.size(), "file", s.file);
  json.end_object();
}

}  // namespace

int list_command(const ListOptions& options) {
  std::vector<fs::path> folders(options.folders.begin(), options.folders.end());
  if (folders.empty()) folders.push_back(default_folder());
  std::vector<std::vector<std::string>> rows;
  JsonWriter json;
  json.begin_array();
  int code = kGood;
  for (const fs::path& folder : folders) {
    std::vector<Scenario> scenarios;
    for (const fs::path& file : scenario_files(folder))
      if (auto s = load_or_complain(file.string(), code)) scenarios.push_back(std::move(*s));
    sort_for_teaching(scenarios);
    for (const Scenario& s : scenarios) {
      rows.push_back(row_of(s));
      add_member(json, s);
    }
  }
  json.line().end_array();
  options.json ? write_stdout(json.text() + "\n") : print(table(rows));
  return code;
}

}  // namespace lantern::app
