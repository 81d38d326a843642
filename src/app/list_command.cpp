#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/run_scenario.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/json_writer.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

// scenarios/ here, or beside the folder in which this program was built.
fs::path default_folder() {
  std::error_code error;
  if (fs::is_directory("scenarios", error)) return "scenarios";
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return program.parent_path().parent_path() / "scenarios";
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

}  // namespace

int list_command(const ListOptions& options) {
  std::vector<fs::path> folders(options.folders.begin(), options.folders.end());
  if (folders.empty()) folders.push_back(default_folder());
  std::vector<std::vector<std::string>> rows;
  JsonWriter json;
  json.begin_array();
  int code = kGood;
  for (const fs::path& folder : folders)
    for (const fs::path& file : scenario_files(folder))
      if (const auto s = load_or_complain(file.string(), code)) {
        rows.push_back({s->name, s->title, s->source, file.string()});
        json.line().begin_object().members("name", s->name, "title", s->title, "source", s->source,
                                           "steps", s->steps.size(), "file", file.string());
        json.end_object();
      }
  json.line().end_array();
  options.json ? write_stdout(json.text() + "\n") : print(table(rows));
  return code;
}

}  // namespace lantern::app
