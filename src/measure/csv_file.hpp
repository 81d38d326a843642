// A user's own CSV file, line by line, with the place of every mistake.
#pragma once

#include <algorithm>

#include <fmt/format.h>

#include "base/stop.hpp"
#include "base/suggest.hpp"
#include "language/text/problems.hpp"

namespace lantern::measure {

struct CsvCell {
  std::string_view text;  // without spaces and quotes around it
  int column = 1;         // of the line, from 1
};

class CsvFile {
 public:
  CsvFile(std::string file, std::string_view text) : file_(std::move(file)), text_(text) {}

  // act(cells) for each line; those that are empty or begin with # are passed over.
  void each_line(const auto& act) {
    for (std::string_view rest = without_mark(text_); !rest.empty();) {
      stop_if_asked();
      const std::size_t end = rest.find('\n');
      const std::string_view line = rest.substr(0, end);
      const std::size_t first = std::min(line.find_first_not_of(kSpace), line.size());
      ++line_;
      if (!line.substr(first).empty() && line[first] != '#') act(cells_of(line));
      rest = end == rest.npos ? std::string_view() : rest.substr(end + 1);
    }
  }

  int line() const { return line_; }  // that was given last
  // A mistake in it, or in another.
  [[noreturn]] void fail(int column, std::string message, std::string advice = "",
                         std::optional<int> in = {}) const {
    const int line = in.value_or(line_);
    throw ScenarioError(Diagnostic{
        {file_, line, column}, std::move(message), line_of(text_, line), std::move(advice)});
  }

  // Which of `columns` each cell names; no other, and none twice.
  std::vector<std::size_t> named(const std::vector<CsvCell>& cells,
                                 std::span<const std::string_view> columns,
                                 const std::string& advice = "") const {
    std::vector<std::size_t> named;
    for (const CsvCell& cell : cells) {
      const auto found = std::ranges::find(columns, cell.text);
      if (found == columns.end())
        fail(cell.column, fmt::format("unknown column {}", in_quotes(cell.text)),
             suggestion(cell.text, columns, columns.size()));
      const auto column = static_cast<std::size_t>(found - columns.begin());
      if (std::ranges::find(named, column) != named.end())
        fail(cell.column, fmt::format("column '{}' is there twice", cell.text), advice);
      named.push_back(column);
    }
    return named;
  }

 private:
  static constexpr std::string_view kSpace = " \t\r\"";

  // The first line tells what stands between: no comma where a decimal one may stand.
  std::vector<CsvCell> cells_of(std::string_view line) {
    const auto has = [&](const char* text) { return line.find(text) != line.npos; };
    if (separator_ == 0) separator_ = has(";") ? ';' : has("\t") && !has(",\t") ? '\t' : ',';
    std::vector<CsvCell> cells;
    for (std::size_t at = 0;;) {
      const std::size_t end = std::min(line.find(separator_, at), line.size());
      const std::string_view cell = line.substr(at, end - at);
      const std::size_t first = std::min(cell.find_first_not_of(kSpace), cell.size());
      const std::size_t last = first == cell.size() ? first : cell.find_last_not_of(kSpace) + 1;
      cells.push_back({cell.substr(first, last - first), static_cast<int>(at + first) + 1});
      if (end == line.size()) return cells;
      at = end + 1;
    }
  }

  std::string file_;
  std::string_view text_;
  int line_ = 0;
  char separator_ = 0;
};

}  // namespace lantern::measure
