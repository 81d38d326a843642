// Columns of text, for people.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "base/printable.hpp"
#include "base/utf8.hpp"

namespace lantern {

// Rows of equally many cells, each a printable line, padded to columns.
inline std::string table(std::vector<std::vector<std::string>> rows) {
  std::vector<std::size_t> widths;
  for (auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) {
      row[i] = printable(row[i]);
      widths[i] = std::max(widths[i], letters(row[i]));
    }
  }
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i)
      text += row[i] + (i + 1 < row.size() ? std::string(widths[i] - letters(row[i]) + 2, ' ')
                                           : std::string());
    text += '\n';
  }
  return text;
}

}  // namespace lantern
