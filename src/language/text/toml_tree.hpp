// A TOML text as plain values, each with its place. toml++ stays behind this door, so that only one
// source file pays for its templates.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "language/text/problems.hpp"

namespace lantern::language {

struct TomlValue;
struct TomlEntry;
struct TomlDate {};  // TOML has dates and times; no scenario has a use for one

using TomlArray = std::vector<TomlValue>;
using TomlTable = std::vector<TomlEntry>;  // in order of their keys' letters

struct TomlValue {
  Place where;
  std::variant<TomlDate, std::string, std::int64_t, double, bool, TomlArray, TomlTable> data;
};

struct TomlEntry {
  std::string key;
  Place where;  // of the key
  TomlValue value;
};

// The entry of that key; null if there is none.
const TomlEntry* entry_of(const TomlTable& table, std::string_view key);

// Adds a problem and gives an empty table if `text` is not TOML, has bytes that are not UTF-8, or
// is nested too deeply. `text` has no byte order mark.
TomlTable read_toml(std::string_view text, Problems& problems);

}  // namespace lantern::language
