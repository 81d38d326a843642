// Texts and pictures on their way into HTML and XML.
#pragma once

#include <string>
#include <string_view>

namespace lantern::publish {

// Between tags and in quoted attributes: & < > " escaped, and every character that XML forbids or a
// reader would obey written as an escape (see printable.hpp), but for line breaks.
std::string marked_up(std::string_view text);

// "data:image/png;base64,...": a picture within the page.
std::string png_uri(std::string_view png);

}  // namespace lantern::publish
