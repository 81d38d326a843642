#include "scenario/source_text.hpp"

#include <algorithm>

#include "scenario/scenario.hpp"

namespace lantern {
namespace {

constexpr std::string_view kMark = "\xef\xbb\xbf";  // U+FEFF, the byte order mark

std::uint8_t byte(std::string_view text, std::size_t i) {
  return static_cast<std::uint8_t>(text[i]);
}

bool continues(std::string_view text, std::size_t i) {
  return i < text.size() && (byte(text, i) & 0xc0) == 0x80;
}

// Bytes of the valid UTF-8 sequence that starts at `i`; 0 if there is none (RFC 3629, table 3-7 of
// the Unicode standard).
std::size_t sequence(std::string_view text, std::size_t i) {
  const std::uint8_t first = byte(text, i);
  if (first < 0x80) return 1;
  const std::size_t length = first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
  if (first < 0xc2 || first > 0xf4) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if (!continues(text, i + k)) return 0;
  const std::uint8_t second = byte(text, i + 1);
  if (first == 0xe0 && second < 0xa0) return 0;  // could be written shorter
  if (first == 0xed && second > 0x9f) return 0;  // half of a surrogate pair
  if (first == 0xf0 && second < 0x90) return 0;  // could be written shorter
  if (first == 0xf4 && second > 0x8f) return 0;  // above U+10FFFF
  return length;
}

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

}  // namespace

std::size_t letters(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

std::optional<std::size_t> first_bad_byte(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = sequence(text, i);
    if (length == 0 || text[i] == '\0') return i;
    i += length;
  }
  return std::nullopt;
}

Place place_of(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const std::size_t line_break = before.rfind('\n');
  const std::size_t start = line_break == std::string_view::npos ? 0 : line_break + 1;
  return {1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
          1 + static_cast<int>(letters(before.substr(start)))};
}

std::string line_of(std::string_view text, int line) {
  if (line < 1) return {};
  text = without_mark(text);
  for (int i = 1; i < line; ++i) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  text = text.substr(0, text.find('\n'));
  if (text.ends_with('\r')) text.remove_suffix(1);
  std::string clean;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = sequence(text, i);
    clean += length == 0 || text[i] == '\0' ? std::string_view("?") : text.substr(i, length);
    i += std::max<std::size_t>(length, 1);
  }
  return clean;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMostBytes = 60;
  std::size_t end = std::min(text.size(), kMostBytes);
  while (end > 0 && end < text.size() && continues(text, end)) --end;
  std::string clean(text.substr(0, end));
  std::replace_if(clean.begin(), clean.end(), is_control, '?');
  return "'" + clean + (end < text.size() ? "…'" : "'");
}

bool has_control(std::string_view text) {
  return std::any_of(text.begin(), text.end(), is_control);
}

std::string_view without_mark(std::string_view text) {
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  return text;
}

Diagnostic diagnose(const Scenario& scenario, const SourcePosition& where, std::string message,
                    std::string suggestion) {
  return {where, std::move(message), line_of(scenario.text, where.line), std::move(suggestion)};
}

}  // namespace lantern
