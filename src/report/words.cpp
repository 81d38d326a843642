#include "report/words.hpp"

#include <cmath>

#include <fmt/format.h>

namespace lantern::report {

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

std::string capital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z')
    text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

std::string seconds_text(double seconds) {
  if (!std::isfinite(seconds)) return "?";
  const double size = std::abs(seconds);
  if (size >= 1 || size == 0) return fmt::format("{:.3g} s", seconds);
  if (size >= 0.9995e-4) return fmt::format("{:.3g} ms", seconds * 1e3);
  if (size >= 0.9995e-7) return fmt::format("{:.3g} µs", seconds * 1e6);
  return fmt::format("{:.3g} ns", seconds * 1e9);
}

std::string figure(double number) {
  if (!std::isfinite(number)) return "?";
  const double size = std::abs(number);
  if (size == 0) return "0";
  if (size >= 0.9995e-3 && size < 1e5) {
    if (size >= 999.5) return fmt::format("{:.0f}", number);
    return fmt::format("{:.3g}", number);
  }
  std::string text = fmt::format("{:.2e}", number);
  const std::size_t e = text.find('e');
  std::string lead = text.substr(0, e);
  while (lead.back() == '0') lead.pop_back();
  if (lead.back() == '.') lead.pop_back();
  return fmt::format("{}e{}", lead, std::stoi(text.substr(e + 1)));
}

}  // namespace lantern::report
