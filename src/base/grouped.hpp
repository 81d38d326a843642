// Long numbers as a book prints them.
#pragma once

#include <concepts>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace lantern {

// The digits of `number` with `gap` before each three from the right: 12345 is "12 345". Numbers of
// up to four digits stay whole.
std::string grouped(std::integral auto number, std::string_view gap = "\u2009") {
  std::string text = fmt::format("{}", number);
  const std::size_t sign = text.starts_with('-') ? 1 : 0;
  if (text.size() - sign < 5) return text;
  for (std::size_t i = text.size() - 3; i > sign && i < text.size(); i -= 3) text.insert(i, gap);
  return text;
}

}  // namespace lantern
