#include "app/inputs.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <tuple>

#include <fmt/format.h>

#include "app/terminal.hpp"
#include "rooms.hpp"
#include "scenario/scenario.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

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
