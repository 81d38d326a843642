// What stands where in a scenario's text. The reader takes each line as well as it can, as what is
// being written is mostly no TOML; of a text that is TOML it tells every place exactly.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "rooms.hpp"

namespace lantern::live {

using PathPart = std::variant<std::string, std::size_t>;  // a key, or an index in a list
using TomlPath = std::vector<PathPart>;

inline constexpr std::size_t kNone = std::string_view::npos;

// A key or an element: one with a [header] of its own from `begin` to `end`, a pair on a line or in
// braces from its key at `begin` and its value at `value`, an element of a list from both; or one
// that only the keys of others name.
struct Written {
  enum Form { named, header, line, inner, element };
  Form form = named;
  std::size_t parent = kNone;  // whose key or element it is
  PathPart name{};
  std::size_t table = 0;  // under whose header, or in whose braces, it stands
  std::size_t begin = 0, value = 0, end = 0;
  std::size_t headers = 0;  // of a list of [[tables]]

  bool is_value() const { return form >= line; }
  bool is_pair() const { return form == line || form == inner; }
};

// A place that one writes at, and what may stand there from `from` on.
struct Cursor {
  enum class In { nothing, heading, key, value };
  In in = In::nothing;
  std::size_t from = kNone;
  std::size_t of = 0;      // the table that the key is of, whose value it is, or the list's
  bool is_quoted = false;  // within the quotes of a text
};

struct WrittenText {
  std::string_view text;
  // In the order in which they are named first; the file itself is 0.
  std::vector<Written> all = std::vector<Written>(1);
  Cursor cursor;

  // kNone if there is none, and nothing is within that.
  std::size_t find(std::size_t parent, const PathPart& name) const;
  bool is_within(std::size_t one, std::size_t outer) const;
  // What stands there in quotes; empty if nothing does.
  std::string_view text_of(std::size_t parent, const PathPart& name) const;
  std::size_t add(Written written);

  std::map<std::pair<std::size_t, PathPart>, std::size_t> latest;  // of that name in that parent
};

// Without `cursor` the text must be TOML. The key or heading that the cursor is in is not there
// yet. `text` has no byte order mark, and outlives what is read.
WrittenText read_written(std::string_view text, std::size_t cursor = kNone);

// The keys of a path as edit.hpp has them, with their indexes; empty if it is none.
TomlPath path_of(std::string_view text);

}  // namespace lantern::live
