// Changes to a scenario's text in place: comments, order, blanks and line ends stay as they are,
// byte for byte, wherever nothing is changed.
//
// A path names one value, as `structure.capacity`, `body[3].position` (of the fourth [[body]]),
// `level.loops[0][2]` or `step[1].expect."for 1".nodes`; names are as in the TOML, quotes may
// stand.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "rooms.hpp"

namespace lantern::live {

// All of these throw Refused if the text is not TOML, or the path is none.

// The value at the path as it is written; empty if there is none, or it is a table of many lines.
std::string value_at(std::string_view text, std::string_view path);

// The text with this TOML value at the path. A key that is not written is put behind the last of
// its table, and a table that is not there is made: in braces, or as a [table] before the first
// [[step]]. An empty value takes the key out with its line, or an element out of its list. Throws
// Refused if the path leads nowhere (an index behind the list's end, a key of a number), or to a
// table of many lines, or `value` is not one TOML value.
std::string with_value(std::string_view text, std::string_view path, std::string_view value);

// A value that changes again and again: with_value(), for which the text is read once.
class Slot {
 public:
  explicit Slot(std::string text = "", std::string path = "")
      : text_(std::move(text)), path_(std::move(path)) {}
  // The value is one TOML value, as long as any other was.
  std::string with(const std::string& value);

 private:
  std::string text_, path_;
  std::optional<std::pair<std::string, std::string>> around_;  // what is before and behind it
};

// The text with one more step behind the one of this index, which is no ending then, and behind
// that one's own tables. Its lines are those of a [[step]]; the header may be left out. Throws
// Refused if there is no such step, or the lines are not one step.
std::string with_step(std::string_view text, std::size_t step, std::string_view lines);

// With one more body behind the last one, if there is any, in the same way.
std::string with_body(std::string_view text, std::string_view lines);

// Which table of a list, as `body`, has this name.
std::optional<std::size_t> index_of(std::string_view text, std::string_view list,
                                    std::string_view name);

}  // namespace lantern::live
