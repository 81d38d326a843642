#include "base/json_writer.hpp"

#include "base/printable.hpp"
#include "base/utf8.hpp"

namespace lantern {

std::string json_string(std::string_view text) {
  std::string out = "\"";
  while (!text.empty()) {
    const auto [bytes, code] = first_letter(text);
    if (!code)
      out += "\ufffd";
    else if (*code == '"' || *code == '\\')
      (out += '\\') += text[0];
    else if (*code == '\n')
      out += "\\n";
    else if (is_obeyed(*code))
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(*code));
    else
      out += text.substr(0, bytes);
    text.remove_prefix(bytes);
  }
  return out += '"';
}

}  // namespace lantern
