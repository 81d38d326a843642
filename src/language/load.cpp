// Scenario files on a disk.
#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/file.hpp"
#include "language/language.hpp"
#include "language/scenario.hpp"
#include "language/tables/draft.hpp"

namespace lantern::language {
Scenario load_scenario(const std::string& path) {
  if (path == "-") return parse_scenario(read_stdin(kMostFileBytes), std::string(kStandardInput));
  std::error_code error;
  if (fs::is_regular_file(path, error)) {
    const std::uintmax_t bytes = fs::file_size(path, error);
    if (!error && bytes > kMostFileBytes) refuse_size(path, bytes);
  }
  return parse_scenario(read_input(path, kMostFileBytes), path);
}

Glance glance_at(const std::string& path) try {
  Problems problems;
  const std::string bytes = read_file(path, kMostFileBytes);
  const TomlTable table = read_toml(without_mark(bytes), problems);
  Glance glance;
  glance.name = fs::path(path).stem().string();
  if (problems.any() || table.empty()) return glance;
  if (const auto* name = value_of<std::string>(table, "name")) glance.name = *name;
  glance.is_scenario = std::ranges::any_of(
      table, [](const TomlEntry& entry) { return language_table("").find(entry.key) != nullptr; });
  if (const auto* place = value_of<std::int64_t>(table, "lecture");
      place && std::in_range<std::uint32_t>(*place))
    glance.lecture = static_cast<std::uint32_t>(*place);
  return glance;
} catch (const IoError&) {
  return {};
}

}  // namespace lantern::language
