#include "scenario/name_pattern.hpp"

#include "base/check.hpp"

namespace lantern {
namespace {

// The group of letters that starts at `at`, and how many of them are wanted.
struct Letters {
  std::string_view group;  // between the brackets
  std::size_t least = 1;
  std::size_t most = 1;
};

Letters next_letters(std::string_view pattern, std::size_t& at) {
  const std::size_t close = pattern.find(']', at);
  LANTERN_CHECK(close, !=, std::string_view::npos);
  Letters found{pattern.substr(at + 1, close - at - 1)};
  at = close + 1;
  if (at >= pattern.size() || pattern[at] != '{') return found;
  const auto number = [&] {
    std::size_t n = 0;
    while (pattern[++at] >= '0' && pattern[at] <= '9')
      n = n * 10 + static_cast<std::size_t>(pattern[at] - '0');
    return n;
  };
  found.least = number();
  found.most = number();
  ++at;
  return found;
}

bool in_group(char c, std::string_view group) {
  for (std::size_t i = 0; i < group.size(); ++i) {
    const bool is_range = i + 2 < group.size() && group[i + 1] == '-';
    if (is_range ? group[i] <= c && c <= group[i + 2] : c == group[i]) return true;
    if (is_range) i += 2;
  }
  return false;
}

}  // namespace

bool matches(std::string_view text, const NamePattern& name_pattern) {
  const std::string_view pattern = name_pattern.expression;
  for (std::size_t at = 1; at < pattern.size() && pattern[at] == '[';) {
    const Letters letters = next_letters(pattern, at);
    std::size_t taken = 0;
    while (taken < letters.most && taken < text.size() && in_group(text[taken], letters.group))
      ++taken;
    if (taken < letters.least) return false;
    text.remove_prefix(taken);
  }
  return text.empty();
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
