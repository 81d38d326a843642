#include <fstream>

#include <fmt/format.h>

#include "embedded/lab_version.hpp"
#include "measure/row.hpp"

namespace lantern::measure {
namespace {

std::string compiler() {
#if defined(__clang__)
  return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  return fmt::format("gcc {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

}  // namespace

Circumstances here() {
  return {
      std::string(kVersion), std::string(kLabHash), compiler(), LANTERN_FLAGS, processor(), 1, ""};
}

}  // namespace lantern::measure
