// The text of a scenario file as its reader sees it: lines, letters, places.
#pragma once

#include <compare>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "base/utf8.hpp"

namespace lantern::scenario {

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

}  // namespace lantern::scenario
