#include "base/printable.hpp"

#include <iterator>

#include <fmt/format.h>

#include "base/utf8.hpp"

namespace lantern {
namespace {

std::string escaped(std::string_view text, bool keeps_lines) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const auto [bytes, code] = first_letter(text);
    if (!code)
      fmt::format_to(std::back_inserter(out), "\\x{:02x}", static_cast<unsigned char>(text[0]));
    else if (!is_obeyed(*code) || (keeps_lines && *code == '\n'))
      out += text.substr(0, bytes);
    else if (*code == '\n' || *code == '\t' || *code == '\r')
      out += *code == '\n' ? "\\n" : *code == '\t' ? "\\t" : "\\r";
    else if (*code < 0x80)
      fmt::format_to(std::back_inserter(out), "\\x{:02x}", static_cast<unsigned>(*code));
    else
      fmt::format_to(std::back_inserter(out), "\\u{:04x}", static_cast<unsigned>(*code));
    text.remove_prefix(bytes);
  }
  return out;
}

}  // namespace

bool is_obeyed(char32_t letter) {
  const auto from_to = [letter](char32_t first, char32_t last) {
    return first <= letter && letter <= last;
  };
  return letter < 0x20 || from_to(0x7f, 0x9f) || letter == 0x61c || from_to(0x200e, 0x200f) ||
         from_to(0x2028, 0x202e) || from_to(0x2066, 0x2069);
}

std::string printable(std::string_view text) { return escaped(text, false); }
std::string printable_lines(std::string_view text) { return escaped(text, true); }

bool is_printable(std::string_view text) {
  for (; !text.empty(); text.remove_prefix(first_letter(text).bytes))
    if (const auto code = first_letter(text).code; !code || is_obeyed(*code)) return false;
  return true;
}

}  // namespace lantern
