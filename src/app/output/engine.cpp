// The engine that live pages carry.
#include <fmt/format.h>

#include "app/output/sinks.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "embedded/version.hpp"
#include "publish/lesson.hpp"

namespace lantern::app {
namespace {

constexpr const char* kEngine = "lantern.wasm";
constexpr const char* kGetIt = "'./run web' builds it, and the package brings it along";

fs::path engine_file(const std::string& named) {
  if (!named.empty()) return named;
  std::error_code error;
  const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& file : {here / kEngine, here.parent_path() / "share/lantern" / kEngine})
    if (fs::is_regular_file(file, error)) return file;
  throw UsageError(
      "a live page carries Lantern's engine, and there is no {} beside the program, nor where it "
      "is installed: {}; --engine names another place",
      kEngine, kGetIt);
}

}  // namespace

const std::string& packed_engine(const std::string& named) {
  constexpr std::size_t kMostBytes = std::size_t{64} << 20;
  static std::string bytes, packed;  // it takes long, and pages are made by the dozen
  const fs::path file = engine_file(named);
  std::string now = read_input(file, kMostBytes);
  if (!now.starts_with(std::string_view("\0asm\1\0\0\0", 8)))
    throw UsageError("'{}' is no WebAssembly module: {}", file.string(), kGetIt);
  if (now.find(kEngineMark) == now.npos)
    throw UsageError(
        "'{}' is not the engine of this Lantern ({}, sources {}), so that a page would not be what "
        "this program draws: {}",
        file.string(), kVersion, kSourceHash, kGetIt);
  if (now != bytes) {
    packed = publish::packed_engine(now);
    bytes = std::move(now);
  }
  return packed;
}

publish::LiveScenario live_scenario(const Scenario& s) {
  return {s.name + ".toml", s.title, s.idea, s.lecture, s.text};
}

}  // namespace lantern::app
