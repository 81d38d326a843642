#include "base/printable.hpp"

#include <iterator>

#include <fmt/format.h>

#include "base/words.hpp"

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

Letter first_letter(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return {1, first};
  if (first < 0xc2 || first > 0xf4) return {};
  const std::size_t length = first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
  char32_t code = first & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3f);
  }
  const bool could_be_shorter = code < (length == 3 ? 0x800 : length == 4 ? 0x10000 : 0x80);
  const bool half_of_a_pair = code >= 0xd800 && code < 0xe000;
  if (could_be_shorter || half_of_a_pair || code > 0x10ffff) return {};
  return {length, code};
}

std::size_t letters(std::string_view text) {
  std::size_t count = 0;
  for (; !text.empty(); ++count) text.remove_prefix(first_letter(text).bytes);
  return count;
}

void append_utf8(std::string& text, char32_t code) {
  const auto tail = [&](int shift) { text += static_cast<char>(0x80 | ((code >> shift) & 0x3f)); };
  if (code < 0x80) {
    text += static_cast<char>(code);
    return;
  }
  if (code < 0x800) {
    text += static_cast<char>(0xc0 | code >> 6);
  } else if (code < 0x10000) {
    text += static_cast<char>(0xe0 | code >> 12);
    tail(6);
  } else {
    text += static_cast<char>(0xf0 | code >> 18);
    tail(12);
    tail(6);
  }
  tail(0);
}

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
      "<!doctype html>\n<html lang=\"{}\"{}>\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1, "
      "interactive-widget=resizes-content\">\n"
      "<title>{}</title>\n{}</body>\n</html>\n",
      spoken() ? spoken()->language : "en", attributes, escaped(title), rest);
}

}  // namespace lantern
