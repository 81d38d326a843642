#include "app/lab.hpp"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "base/child.hpp"
#include "embedded/version.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

// Where the module may be: beside the program, or above the tests' folder; where it is installed;
// and for programs with structures of their own, where Lantern is.
std::vector<fs::path> module_places() {
  std::error_code error;
  const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path home = here.filename() == "tests" ? here.parent_path() : here;
  return {home, here.parent_path() / "lib/lantern", "/usr/local/lib/lantern", "/usr/lib/lantern"};
}

constexpr const char* kBuild = "'./run lab' in Lantern's repository builds it";

std::pair<const Lab*, std::string> loaded_lab() {
  std::string why = fmt::format("the lab is not beside this program; {}", kBuild);
  for (const fs::path& place : module_places()) {
    const fs::path file = place / "lantern_lab.so";
    std::error_code error;
    if (!fs::is_regular_file(file, error)) continue;
    const Library library({file.c_str()});
    const Lab* (*lab)() = nullptr;
    if (!library.find(lab, "lantern_lab"))
      why = fmt::format("'{}' cannot be loaded: {}", file.string(), library.problem());
    else if (lab()->sources != kSourceHash)
      why = fmt::format("'{}' is of another Lantern; {}", file.string(), kBuild);
    else
      return {lab(), ""};
  }
  return {nullptr, why};
}

// `path` leads to it: "bench pairs", "pairs".
Command lab_command(const char* path, const char* name, const char* help) {
  return {name,
          help,
          [path](Options& rows) -> Run {
            const Lab* lab = find_lab();
            return lab == nullptr ? nullptr : lab->begin(path, rows);
          },
          {},
          [path]() -> std::string {
            std::string why;
            return find_lab(&why) != nullptr ? "" : fmt::format("{}: {}", path, why);
          }};
}

}  // namespace

const Lab* find_lab(std::string* why) {
  static const auto found = loaded_lab();
  if (why != nullptr) *why = found.second;
  return found.first;
}

std::vector<Command> lab_commands() {
  return {
      lab_command("measure", "measure",
                  "Error against run time: problems with known answers, method by method"),
      {"bench",
       "Measure speed against named peers",
       nullptr,
       {lab_command("bench frames", "frames", "Frames per second written to disk, beside cairo"),
        lab_command("bench pairs", "pairs",
                    "All pairs of moving boxes, and what rays, boxes and balls meet, beside "
                    "other libraries"),
        lab_command("bench atlas", "atlas",
                    "How full texture atlases become, and how soon, beside stb"),
        lab_command("bench step", "step",
                    "Milliseconds and penetration of piles of bodies, beside engines")}},
      lab_command("stress", "stress",
                  "Check extreme input, stiff springs and the limits of stability")};
}

}  // namespace lantern::app
