// Texts within XML and HTML.
#pragma once

#include <string>
#include <string_view>

namespace lantern {

// For what stands between tags or in an attribute's double quotes: & < > " as entities, and every
// character that XML forbids or a reader would obey as an escape (printable.hpp); line breaks stay.
std::string escaped(std::string_view text);

// A whole page of HTML with this title, which is escaped here. `rest` is what else stands in its
// head, then "</head>\n<body>\n", then what stands in its body; `attributes` are those of <html>.
std::string html_page(std::string_view title, std::string_view rest,
                      std::string_view attributes = "");

}  // namespace lantern
