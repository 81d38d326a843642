#include "measure/peer_modules.hpp"

#include <filesystem>

#include <fmt/format.h>

namespace lantern::measure {
namespace {

namespace fs = std::filesystem;

// Where the module is; empty if it was not built. Beside the program, or above the tests' folder: a
// folder above a program may be that of another build.
fs::path place_of(const PeerModule& module) {
  std::error_code error;
  const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path home = here.filename() == "tests" ? here.parent_path() : here;
  const fs::path file = home / "peers" / module.file;
  return fs::is_regular_file(file, error) ? file : fs::path();
}

}  // namespace

std::optional<Library> load_module(const PeerModule& module, std::vector<std::string>& missing) {
  const fs::path path = place_of(module);
  if (!path.empty()) return Library({path.c_str()});
  missing.push_back(
      fmt::format("{}: not built in; apt-get install {} and build again: an installed Lantern has "
                  "no engines beside it",
                  module.name, module.package));
  return std::nullopt;
}

}  // namespace lantern::measure
