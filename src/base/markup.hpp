// Texts within XML and HTML.
#pragma once

#include <string>
#include <string_view>

namespace lantern {

// For what stands between tags or in an attribute's double quotes: & < > " as entities, and every
// character that XML forbids or a reader would obey as an escape (printable.hpp); line breaks stay.
std::string escaped(std::string_view text);

}  // namespace lantern
