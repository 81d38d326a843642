// The text of a scenario file as its reader sees it: lines, letters, places, and TOML as plain
// values (toml++ stays in one source, which alone pays for its templates); and its mistakes,
// gathered so that all are told in one pass.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace lantern::language {

// A line and a column of a file, both from 1; columns count letters, not bytes. {0, 0} is the file
// as a whole.
struct Place {
  int line = 0;
  int column = 0;
  auto operator<=>(const Place&) const = default;
};

// The first byte that no scenario may contain: one that is not valid UTF-8, or a NUL.
std::optional<std::size_t> first_bad_byte(std::string_view text);

// The place of a byte; of the text's end if `offset` lies behind it.
Place place_of(std::string_view text, std::size_t offset);

// Without its line break and byte order mark; bytes that no scenario may contain become '?'.
// Empty if there is no such line.
std::string line_of(std::string_view text, int line);

// 'text' in quotes for a message: printable (base/printable.hpp), a long one is cut.
std::string in_quotes(std::string_view text);

// `text` without the byte order mark that some editors put first.
std::string_view without_mark(std::string_view text);

class Problems {
 public:
  // A hint is worked out only for the mistakes that are shown, so it may be costly. What it refers
  // to must live until raise().
  using Hint = std::function<std::string()>;

  void add(Place where, std::string message, Hint hint = {}) {
    add(where, std::move(message), std::move(hint), false);
  }
  void add(Place where, std::string message, std::string hint);
  void add(Place where, std::string message, const char* hint);

  // There is nothing of this kind and name; `known` are those that there are. Wherever else the
  // same stands, it is the same mistake: it is told once, where it stands first.
  using Known = std::function<std::vector<std::string_view>()>;
  void add_unknown(Place where, std::string_view kind, const std::string& name, Known known);

  bool any() const { return !found_.empty(); }

  // Adds those of several readings of one file, by their names. What all found is told once, what
  // only one did with its name behind it: "…, on the side 'eager'".
  void add_readings(const std::vector<std::pair<std::string, const Problems*>>& readings);

  // Throws ScenarioError with the first mistakes in order of their places, and the number of the
  // others; does nothing if there are none.
  void raise(const std::string& file, std::string_view text);

 private:
  struct Found {
    Place where;
    std::string message;
    Hint hint;
    bool once = false;
  };
  void add(Place where, std::string message, Hint hint, bool once);
  void drop_the_latest();
  void tell_unknown_once();

  std::vector<Found> found_;
  std::size_t dropped_ = 0;
};

// The nearest of `candidates`, or all of them if they are few.
std::string nearest(std::string_view name, std::vector<std::string_view> candidates);

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

// Its value; null if there is none of that type.
template <class T>
const T* value_of(const TomlTable& table, std::string_view key) {
  const TomlEntry* entry = entry_of(table, key);
  return entry ? std::get_if<T>(&entry->value.data) : nullptr;
}
template <class T>
T* value_of(TomlTable& table, std::string_view key) {
  return const_cast<T*>(value_of<T>(std::as_const(table), key));
}

// Adds a problem and gives an empty table if `text` is not TOML, has bytes that are not UTF-8, or
// is nested too deeply. `text` has no byte order mark.
TomlTable read_toml(std::string_view text, Problems& problems);

}  // namespace lantern::language
