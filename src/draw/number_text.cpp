#include "draw/number_text.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/words.hpp"
#include "frame/frame.hpp"
#include "language/counts.hpp"

namespace lantern::draw {
namespace {

constexpr double kLongest = 1e12;  // from here on as a power of ten

std::string without_end_zeros(std::string text) {
  if (text.find('.') == std::string::npos) return text;
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

// "1.2e+15" as "1.2·10¹⁵".
std::string as_power(double number) {
  const std::string text = fmt::format("{:.1e}", std::abs(number));
  const std::size_t e = text.find('e');
  const std::string lead = decimal(without_end_zeros(text.substr(0, e)));
  const std::string power = power_of_ten(std::stoi(text.substr(e + 1)));
  return (number < 0 ? "−" : "") + (lead == "1" ? power : lead + "·" + power);
}

}  // namespace

std::string power_of_ten(int power) {
  constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  if (power == 0) return "1";
  if (power == 1) return "10";
  std::string text = power < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(power))) text += kDigits[digit - '0'];
  return text;
}

std::string number_text(double number, int decimals) {
  if (!std::isfinite(number)) return "–";
  if (std::abs(number) >= kLongest) return as_power(number);
  const std::string plain = without_end_zeros(fmt::format("{:.{}f}", std::abs(number), decimals));
  const std::size_t whole = std::min(plain.find('.'), plain.size());
  const std::string text =
      grouped(std::stoll(plain.substr(0, whole))) + decimal(plain.substr(whole));
  return number < 0 && text != "0" ? "−" + text : text;
}

std::string number_of(double number, std::string_view forms) {
  return fmt::format("{} {}", number_text(number), noun(forms, std::llround(number)));
}

std::string short_number(double number) {
  const double size = std::abs(number);
  if (size > 0 && size < 1e-3) return as_power(number);
  int decimals = 0;
  for (double limit = 100; decimals < 5 && size < limit; limit /= 10) ++decimals;
  return number_text(number, number == std::floor(number) ? 0 : decimals);
}

std::string chart_words(std::string name) {
  // In another language the noun serves: "pairs met" for "pair tests".
  const auto said = [](const auto& self, std::string_view whole) -> std::string {
    for (const std::string_view between : {", ", " and "})
      if (const std::size_t at = whole.find(between); spoken() && at != whole.npos)
        return self(self, whole.substr(0, at)) +
               (between == ", " ? ", " : " " + word("and") + " ") +
               self(self, whole.substr(at + between.size()));
    if (const auto* count = spoken() ? language::find_count(whole) : nullptr)
      return noun(count->forms(), kMany);
    std::string words(whole);
    std::ranges::replace(words, '_', ' ');
    return word(words);
  };
  const std::size_t end = std::min(name.find(" ("), name.size());
  const std::size_t dot = name.find('.');
  const std::string rest = name.substr(end);
  if (dot >= end) return said(said, name.substr(0, end)) + rest;
  return said(said, name.substr(0, dot)) + ": " + said(said, name.substr(dot + 1, end - dot - 1)) +
         rest;
}

std::string count_words(std::string_view name, std::int64_t number) {
  if (const language::CountDoc* count = language::find_count(name))
    return noun(count->forms(), number);
  const std::size_t dot = std::min(name.find('.'), name.size());
  const auto* of_body = find_in(language::known_body_measures(), name.substr(0, dot));
  if (!of_body || dot == name.size()) return chart_words(std::string(name));
  return fmt::format("{}: {}", noun(of_body->forms(), number), name.substr(dot + 1));
}

std::string count_words(const Frame& frame, std::string_view name, std::int64_t number) {
  const auto own = frame.words.find(std::string(name));
  if (own != frame.words.end()) return own_noun(own->second, number);
  const std::string words = count_words(name, number);
  const auto body =
      std::ranges::find(frame.bodies, name.substr(name.find('.') + 1), &FrameBody::name);
  const std::size_t colon = words.find(": ");
  return body == frame.bodies.end() || colon == words.npos
             ? words
             : words.substr(0, colon + 2) + body->called();
}

}  // namespace lantern::draw
