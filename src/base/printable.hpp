// Texts letter by letter; and those from outside (files, names, arguments, libraries) on their way
// to a terminal, which would obey what stands in them (recolour, retitle, delete, turn around), to
// JSON and to HTML.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace lantern {

// Is it a letter that a terminal obeys instead of showing it: a control character (C0, DEL, C1), a
// line or paragraph separator, or one that turns the direction of writing?
bool is_obeyed(char32_t letter);

// `text` with an escape for each such letter (\n, \t, \r, \x1b, \u202e) and for each byte that is
// no UTF-8 (\xff). Always valid UTF-8; a printable text comes back as it is.
std::string printable(std::string_view text);

// The same for a text of several lines of ours: line breaks stay.
std::string printable_lines(std::string_view text);

// Is there anything in it for which printable() writes an escape?
bool is_printable(std::string_view text);

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

// `text` with quotes, as a JSON string. Bytes that are no UTF-8 become U+FFFD; what a terminal
// would obey is written as an escape, since JSON is printed, too.
std::string json_string(std::string_view text);

// For what stands between tags or in an attribute's double quotes: & < > " as entities, and every
// character that XML forbids or a reader would obey as an escape, as above; line breaks stay.
std::string escaped(std::string_view text);

// A whole page of HTML with this title, which is escaped here. `rest` is what else stands in its
// head, then "</head>\n<body>\n", then what stands in its body; `attributes` are those of <html>.
std::string html_page(std::string_view title, std::string_view rest,
                      std::string_view attributes = "");

}  // namespace lantern
