#include "base/suggest.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.hpp"

namespace lantern {
namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

// Letters that are missing, too many, other ones, or two that have changed places: optimal string
// alignment, three rows at a time (Damerau 1964; Wagner and Fischer 1974).
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1), above(b.size() + 1), two_above;
  std::iota(row.begin(), row.end(), std::size_t{0});
  const auto same = [&](std::size_t i, std::size_t j) { return lower(a[i]) == lower(b[j]); };
  for (std::size_t i = 0; i < a.size(); ++i) {
    two_above = std::exchange(above, row);
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      row[j + 1] = std::min({above[j + 1] + 1, row[j] + 1, above[j] + (same(i, j) ? 0u : 1u)});
      if (i > 0 && j > 0 && same(i, j - 1) && same(i - 1, j))
        row[j + 1] = std::min(row[j + 1], two_above[j - 1] + 1);
    }
  }
  return row.back();
}

}  // namespace

std::optional<std::string> nearest_name(std::string_view name,
                                        std::span<const std::string_view> candidates) {
  constexpr std::size_t kLongest = 64;  // a longer word is no slip of the hand
  if (name.size() > kLongest || candidates.empty()) return std::nullopt;
  const auto slips = [&](std::string_view candidate) { return distance(name, candidate); };
  const std::string_view best = *std::ranges::min_element(candidates, {}, slips);
  const std::size_t allowed = best.size() >= 4 ? std::max<std::size_t>(2, best.size() / 3) : 1;
  return slips(best) <= allowed ? std::optional<std::string>(best) : std::nullopt;
}

std::string suggestion(std::string_view name, std::span<const std::string_view> candidates,
                       std::size_t most) {
  std::string text;
  if (const auto near = nearest_name(name, candidates)) {
    text = "did you mean '" + *near + "'?";
    if (candidates.size() > 1 && candidates.size() <= most) text += ' ';
  }
  if (candidates.size() > most || candidates.size() == (text.empty() ? 0 : 1)) return text;
  return fmt::format("{}known here: {}", text, fmt::join(candidates, ", "));
}

std::string with_suggestion(std::string message, std::string_view name,
                            std::span<const std::string_view> candidates, std::size_t most) {
  const std::string hint = suggestion(name, candidates, most);
  return hint.empty() ? message : std::move(message) + "; " + hint;
}

void require_own_name(std::string_view thing, std::string_view name, bool is_taken) {
  const bool written_well = !name.empty() && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
  if (!written_well) throw Refused("{} '{}': a name is of a–z, 0–9 and _", thing, name);
  if (is_taken) throw Refused("{} '{}': there is one of this name already", thing, name);
}

}  // namespace lantern
