#include "scenario/name_pattern.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace lantern {
namespace {

bool in_group(char c, std::string_view group) {
  for (std::size_t i = 0; i < group.size(); ++i) {
    const bool is_range = i + 2 < group.size() && group[i + 1] == '-';
    if (is_range ? group[i] <= c && c <= group[i + 2] : c == group[i]) return true;
    if (is_range) i += 2;
  }
  return false;
}

}  // namespace

std::string NamePattern::expression() const {
  return fmt::format("^[{}][{}]{{0,{}}}$", first, rest, most - 1);
}

bool matches(std::string_view text, const NamePattern& pattern) {
  return !text.empty() && text.size() <= pattern.most && in_group(text[0], pattern.first) &&
         std::ranges::all_of(text.substr(1), [&](char c) { return in_group(c, pattern.rest); });
}

std::string legal_name(std::string_view text, const NamePattern& pattern) {
  std::string name = "a";  // of all patterns' first letters
  for (const char c : text) {
    const char small = 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if (matches(name + c, pattern))
      name += c;
    else if (matches(name + small, pattern))
      name += small;
    else if (name.back() != '_' && matches(name + '_', pattern))
      name += '_';
  }
  while (name.ends_with('_')) name.pop_back();
  const std::string without = name.substr(1);
  return matches(without, pattern) ? without : name;
}

}  // namespace lantern
