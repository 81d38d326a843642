// Texts that stand within an HTML page.
#pragma once

#include <string>
#include <string_view>

namespace lantern::publish {

// RFC 4648, section 4.
std::string base64(std::string_view bytes);

// JSON as it may stand in a <script>: no letter of it can end the element or begin a comment.
std::string script_text(std::string_view json);

// `text` with each {{name}} replaced by what `value(name)` gives. What a value holds is not
// searched.
std::string filled(std::string_view text, const auto& value) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = text.find("{{", at);
    const std::size_t close = open == text.npos ? text.npos : text.find("}}", open);
    result += text.substr(at, close == text.npos ? text.npos : open - at);
    if (close == text.npos) break;
    result += value(text.substr(open + 2, close - open - 2));
    at = close + 2;
  }
  return result;
}

}  // namespace lantern::publish
