#include "app/scenario_folder.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <optional>
#include <sstream>
#include <string_view>
#include <tuple>

#include <fmt/format.h>

#include "app/terminal.hpp"
#include "base/error.hpp"
#include "base/suggest.hpp"
#include "language/scenario.hpp"
#include "rooms.hpp"

namespace lantern::app {

namespace {

namespace fs = std::filesystem;

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

// In a folder itself, then among its problems.
constexpr const char* kSubfolders[] = {"", "problems"};

std::optional<fs::path> find_named(const std::string& name, const std::vector<fs::path>& folders) {
  std::error_code error;
  for (const fs::path& folder : folders)
    for (const char* sub : kSubfolders)
      if (fs::path file = folder / sub / (name + ".toml"); fs::is_regular_file(file, error))
        return file.lexically_normal();
  return std::nullopt;
}

std::string nearest_of(const std::string& name, const std::vector<fs::path>& folders) {
  std::vector<std::string> names;
  for (const fs::path& folder : folders)
    for (const char* sub : kSubfolders) {
      std::error_code error;
      for (fs::directory_iterator it(folder / sub, error), end; !error && it != end;
           it.increment(error))
        if (it->path().extension() == ".toml") names.push_back(it->path().stem().string());
    }
  std::ranges::sort(names);
  const std::vector<std::string_view> known(names.begin(), names.end());
  const std::string near = suggestion(name, known, 0);
  return near.empty() ? "'lantern list' names those that there are" : near;
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
  throw IoError(fmt::format("there is no file '{}' and no scenario of that name; {}", words,
                            nearest_of(words, folders)));
}

namespace {

struct Lesson {
  std::uint64_t place = 0;
  std::string file;
  bool operator<(const Lesson& o) const {
    return std::tie(place, file) < std::tie(o.place, o.file);
  }
};

std::vector<fs::path> toml_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (std::error_code unknown;
        it->path().extension() == ".toml" && !fs::is_directory(it->path(), unknown))
      files.push_back(it->path());
  if (error) throw IoError(fmt::format("cannot list '{}': {}", folder.string(), error.message()));
  std::sort(files.begin(), files.end());
  return files;
}

void add_folder(const fs::path& folder, std::vector<std::string>& files) {
  std::vector<Lesson> lessons;
  for (const fs::path& path : toml_files(folder)) {
    const Glance glance = glance_at(path.string());
    if (glance.is_scenario)
      lessons.push_back(
          {glance.lecture ? *glance.lecture : std::numeric_limits<uint64_t>::max(), path.string()});
    else
      warn(fmt::format("'{}' is no scenario: it is left out", path.string()));
  }
  if (lessons.empty())
    throw UsageError(
        fmt::format("there is no scenario in the folder '{}'; a scenario is a .toml "
                    "file right in it",
                    folder.string()));
  std::sort(lessons.begin(), lessons.end());
  for (Lesson& lesson : lessons) files.push_back(std::move(lesson.file));
}

}  // namespace

std::vector<std::string> input_files(const std::vector<std::string>& words) {
  if (std::count(words.begin(), words.end(), "-") > 1)
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

}  // namespace lantern::app
