// The sides of a scenario while it is read, and the names by which they are quoted.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "language/specs.hpp"
#include "language/text/problems.hpp"
#include "language/text/toml_tree.hpp"

namespace lantern::language {

// What a file says to one of its sides: a scenario file without sides.
struct SideFile {
  std::string name;
  std::string title;
  TomlTable table;  // its own
  TomlTable file;
};

// In the order in which they stand; `file` has a "side". Adds a problem for each mistake in the
// [[side]] tables; those in what they override are left to whoever reads the files.
std::vector<SideFile> files_of_sides(const TomlTable& file, Problems& problems);

// The chart of all sides together, of a file that is right: a name without a side stands for that
// of each.
ChartSpec chart_of_sides(const TomlTable& file, const ChartSpec& of_one,
                         const std::vector<std::string>& sides);

// The side that a name begins with, as "eager" of "eager.pairs"; empty if there is none of it.
std::string_view side_of(std::string_view name, const std::vector<std::string>& sides);
// And the name without it.
std::string_view within_side(std::string_view name, const std::vector<std::string>& sides);

// May a side override this key of a table?
bool may_differ(std::string_view table, std::string_view key);

}  // namespace lantern::language
