// Texts letter by letter, for whoever must know what is no UTF-8.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace lantern {

// The letter that a text starts with.
struct Letter {
  std::size_t bytes = 1;         // at least 1
  std::optional<char32_t> code;  // none: the first byte starts no valid sequence and stands alone
};

// `text` must not be empty. Valid is what RFC 3629 says (table 3-7 of the Unicode standard).
Letter first_letter(std::string_view text);

// How many there are; a byte that is no UTF-8 counts as one.
std::size_t letters(std::string_view text);

// The letter's bytes behind the text; `code` is a valid one, as first_letter() gives it.
void append_utf8(std::string& text, char32_t code);

}  // namespace lantern
