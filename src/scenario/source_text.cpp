#include "scenario/source_text.hpp"

#include <algorithm>

#include "base/printable.hpp"
#include "scenario/scenario.hpp"

namespace lantern::scenario {
namespace {

constexpr std::string_view kMark = "\xef\xbb\xbf";  // U+FEFF, the byte order mark

// A letter that may stand in a scenario.
bool is_good(const Letter& letter) { return letter.code && *letter.code != 0; }

}  // namespace

std::optional<std::size_t> first_bad_byte(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const Letter letter = first_letter(text.substr(i));
    if (!is_good(letter)) return i;
    i += letter.bytes;
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
  while (!text.empty()) {
    const Letter letter = first_letter(text);
    clean += is_good(letter) ? text.substr(0, letter.bytes) : "?";
    text.remove_prefix(letter.bytes);
  }
  return clean;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMostBytes = 60;
  std::size_t end = 0;
  while (end < text.size() && end + first_letter(text.substr(end)).bytes <= kMostBytes)
    end += first_letter(text.substr(end)).bytes;
  return "'" + printable(text.substr(0, end)) + (end < text.size() ? "…'" : "'");
}

std::string_view without_mark(std::string_view text) {
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  return text;
}

Diagnostic diagnose(const Scenario& scenario, const SourcePosition& where, std::string message,
                    std::string suggestion) {
  return {where, std::move(message), line_of(scenario.text, where.line), std::move(suggestion),
          Severity::error};
}

}  // namespace lantern::scenario
