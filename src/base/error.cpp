#include "base/error.hpp"

#include <algorithm>

#include "base/json_writer.hpp"
#include "base/printable.hpp"

namespace lantern {
namespace {

std::string joined(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& d : diagnostics) text += to_string(d) + '\n';
  return text;
}

// The first letters of a line as they are shown: a tab as a blank, others that a terminal obeys as
// escapes.
std::vector<std::string> shown_letters(std::string_view line, std::size_t most) {
  std::vector<std::string> shown;
  while (!line.empty() && shown.size() < most) {
    const std::string_view letter = line.substr(0, first_letter(line).bytes);
    shown.push_back(letter == "\t" ? " " : printable(letter));
    line.remove_prefix(letter.size());
  }
  return shown;
}

// The line and a caret under its letter `column` (from 0). A long line is cut around the column, so
// that the caret is always in view.
std::string with_caret(std::string_view line, std::size_t column) {
  constexpr std::size_t kMostBefore = 100, kMost = 120;  // letters shown
  for (column = std::min(column, letters(line)); column > kMostBefore; --column)
    line.remove_prefix(first_letter(line).bytes);
  const std::vector<std::string> all = shown_letters(line, kMostBefore + kMost);
  std::size_t before = 0, first = column;
  while (first > 0 && before + letters(all[first - 1]) <= kMostBefore)
    before += letters(all[--first]);
  std::string text;
  for (std::size_t i = first, width = 0; i < all.size() && width < kMost; ++i) {
    text += all[i];
    width += letters(all[i]);
  }
  return fmt::format("\n  {}\n  {:>{}}", text, '^', before + 1);
}

}  // namespace

JsonWriter& JsonWriter::value(const Diagnostic& d) {
  return object("severity", d.severity == Severity::error ? "error" : "warning", "line",
                d.where.line, "column", d.where.column, "message", d.message, "suggestion",
                d.suggestion);
}

std::string_view to_string(Severity severity) {
  return severity == Severity::error ? "error:" : "warning:";
}

std::string to_string(const Diagnostic& d) {
  std::string text = printable(d.where.file);
  if (d.where.line > 0) text += fmt::format(":{}:{}", d.where.line, d.where.column);
  text += fmt::format(": {} {}", to_string(d.severity), printable(d.message));
  if (!d.source_line.empty() && d.where.line > 0)
    text += with_caret(d.source_line, static_cast<std::size_t>(std::max(d.where.column, 1)) - 1);
  if (!d.suggestion.empty()) text += "\n  " + printable(d.suggestion);
  return text;
}

void Diagnostics::add_all(const Diagnostics& others) {
  for (const Diagnostic& one : others.told_) add([&] { return one; });
  count_ += others.count_ - others.told_.size();
}

std::vector<Diagnostic> Diagnostics::list(std::string_view others) const {
  std::vector<Diagnostic> all = told_;
  if (count_ > told_.size())
    all.push_back({{told_.front().where.file, 0, 0},
                   fmt::format("{} more {}", count_ - told_.size(), others),
                   {},
                   {},
                   told_.front().severity});
  return all;
}

ScenarioError::ScenarioError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(joined(diagnostics)), diagnostics_(std::move(diagnostics)) {}

ScenarioError::ScenarioError(Diagnostic diagnostic)
    : ScenarioError(std::vector<Diagnostic>{std::move(diagnostic)}) {}

}  // namespace lantern
