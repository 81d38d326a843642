#include "base/markup.hpp"

#include <fmt/format.h>

#include "base/printable.hpp"

namespace lantern {

std::string escaped(std::string_view text) {
  std::string out;
  const std::string plain = printable_lines(text);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const char c = plain[i];
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (plain.compare(i, 2, "\xef\xbf") == 0 && (plain[i + 2] & 0xfe) == 0xbe)
      out += "\\uff", out += plain[i += 2] == '\xbe' ? "fe" : "ff";  // no characters of XML
    else
      out += c;
  }
  return out;
}

std::string html_page(std::string_view title, std::string_view rest, std::string_view attributes) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"{}>\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n{}</body>\n</html>\n",
      attributes, escaped(title), rest);
}

}  // namespace lantern
