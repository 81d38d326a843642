#include "base/grouped.hpp"

#include <fmt/format.h>

namespace lantern {

std::string grouped(std::int64_t number, std::string_view gap) {
  const std::string plain = fmt::format("{}", number);
  const std::size_t sign = number < 0 ? 1 : 0;
  const std::size_t digits = plain.size() - sign;
  if (digits < 5) return plain;
  std::string text = plain.substr(0, sign);
  for (std::size_t i = 0; i < digits; ++i) {
    if (i > 0 && (digits - i) % 3 == 0) text += gap;
    text += plain[sign + i];
  }
  return text;
}

}  // namespace lantern
