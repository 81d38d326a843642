// Texts within XML and HTML.
#pragma once

#include <string>
#include <string_view>

namespace lantern {

// For what stands between tags or in an attribute's quotes: what would begin a tag, an entity or
// end the quotes is written as an entity, and what a terminal would obey as in printable().
std::string escaped(std::string_view text);

}  // namespace lantern
