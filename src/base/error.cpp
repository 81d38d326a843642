#include "base/error.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace lantern {
namespace {

std::string joined(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& d : diagnostics) text += to_string(d) + '\n';
  return text;
}

// At most `width` bytes of a line from `first` on; letters of several bytes are left out whole.
std::string part_of(std::string_view line, std::size_t first, std::size_t width) {
  const auto within_letter = [&](std::size_t at) {
    return at < line.size() && (static_cast<unsigned char>(line[at]) & 0xc0u) == 0x80u;
  };
  std::size_t end = std::min(first + width, line.size());
  while (first < end && within_letter(first)) ++first;
  while (first < end && within_letter(end)) --end;
  return first < end ? std::string(line.substr(first, end - first)) : std::string();
}

// A long line is cut around the column, so that the caret is always in view.
constexpr std::size_t kShownWidth = 120;

}  // namespace

std::string to_string(const Diagnostic& d) {
  std::string text = d.where.file;
  if (d.where.line > 0) text += fmt::format(":{}:{}", d.where.line, d.where.column);
  text += ": error: " + d.message;
  if (!d.source_line.empty() && d.where.line > 0) {
    const auto column = static_cast<std::size_t>(std::max(d.where.column, 1)) - 1;
    const std::size_t first = column < kShownWidth - 20 ? 0 : column - kShownWidth / 2;
    std::string shown = part_of(d.source_line, first, kShownWidth);
    std::replace_if(
        shown.begin(), shown.end(),
        [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
    text += fmt::format("\n  {}\n  {:>{}}", shown, '^', column - first + 1);
  }
  if (!d.suggestion.empty()) text += "\n  " + d.suggestion;
  return text;
}

ScenarioError::ScenarioError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(joined(diagnostics)), diagnostics_(std::move(diagnostics)) {}

ScenarioError::ScenarioError(Diagnostic diagnostic)
    : ScenarioError(std::vector<Diagnostic>{std::move(diagnostic)}) {}

}  // namespace lantern
