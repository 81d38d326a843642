#include "app/scenario_folder.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "app/terminal.hpp"
#include "base/error.hpp"
#include "base/suggest.hpp"

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

}  // namespace lantern::app
