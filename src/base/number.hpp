// Numbers in words of a command line or of a file, and in what is told.
#pragma once

#include <charconv>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

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

// "1 frame", "2 frames", "0 frames": the number and its noun. One whose plural is not made with an
// s gives it: counted(2, "body", "bodies").
std::string counted(std::integral auto number, std::string_view noun,
                    std::string_view plural = {}) {
  if (number == 1) return fmt::format("1 {}", noun);
  return plural.empty() ? fmt::format("{} {}s", number, noun)
                        : fmt::format("{} {}", number, plural);
}

// As a book prints long numbers: the digits of `number` with `gap` before each three from the
// right: 12345 is "12 345". Numbers of up to four digits stay whole.
std::string grouped(std::integral auto number, std::string_view gap = "\u2009") {
  std::string text = fmt::format("{}", number);
  const std::size_t sign = text.starts_with('-') ? 1 : 0;
  if (text.size() - sign < 5) return text;
  for (std::size_t i = text.size() - 3; i > sign && i < text.size(); i -= 3) text.insert(i, gap);
  return text;
}

}  // namespace lantern
