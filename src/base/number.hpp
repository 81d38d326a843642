// Numbers in words of a command line or of a file.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

namespace lantern {

// The number that is all of `text`, in plain digits whatever the locale; nothing if it is none.
template <class Number>
std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_all = error == std::errc() && end == text.data() + text.size();
  return is_all ? std::optional(number) : std::nullopt;
}

// Two of them, with this letter between: "1280x720".
template <class Number>
std::optional<std::pair<Number, Number>> two_numbers_in(std::string_view text, char between) {
  const std::size_t at = text.find(between);
  if (at == text.npos) return std::nullopt;
  const auto first = number_in<Number>(text.substr(0, at));
  const auto second = number_in<Number>(text.substr(at + 1));
  return first && second ? std::optional(std::pair(*first, *second)) : std::nullopt;
}

}  // namespace lantern
