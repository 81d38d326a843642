// Texts from outside (files, names, arguments, libraries) on their way to a terminal, which would
// obey what stands in them: recolour, retitle, delete, turn around.
#pragma once

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

}  // namespace lantern
