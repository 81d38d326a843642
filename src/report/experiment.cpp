#include "report/experiment.hpp"

#include <concepts>
#include <type_traits>

#include <fmt/format.h>

#include "base/number.hpp"

namespace lantern::report {
namespace {

std::string word_of(std::string_view name, bool given) {
  if (name.starts_with('!')) return given ? "" : " " + std::string(name.substr(1));
  return given ? " " + std::string(name) : "";
}
std::string word_of(std::string_view name, const std::string& value) {
  if (value.empty()) return "";
  return name.starts_with('-') ? fmt::format(" {} {}", name, value) : " " + value;
}
std::string word_of(std::string_view name, double value) {
  return fmt::format(" {} {:g}", name, value);
}
std::string word_of(std::string_view name, std::integral auto value) {
  return fmt::format(" {} {}", name, value);
}
template <class T>
std::string word_of(std::string_view name, const std::optional<T>& value) {
  return value ? word_of(name, *value) : "";
}
template <class T>
std::string word_of(std::string_view name, const std::vector<T>& values) {
  std::string words;
  for (const T& value : values) words += word_of(name, value);
  return words;
}

}  // namespace

std::string count_text(std::uint64_t n) { return grouped(static_cast<std::int64_t>(n)); }

std::string range_text(const Timing& timing, double unit) {
  return figure(unit * timing.lower_quartile) + " - " + figure(unit * timing.upper_quartile);
}

PlotPoint level_point(const Timing& timing, double unit, double y) {
  return {.at = {unit * timing.median, y},
          .spread = Box<2>{{unit * timing.lower_quartile, y}, {unit * timing.upper_quartile, y}}};
}

Option only_option(const char* help, std::vector<std::string>& only) {
  return {"--only", &only, help, {.value = "NAME", .one_each = true}};
}

Option peers_option(const char* help, bool& peers) { return {"!--no-peers", &peers, help}; }

Option rounds_option(const char* help, int& rounds, double most) {
  return {"--rounds", &rounds, help, {.value = "N", .least = 1, .most = most}};
}

Option longest_option(const char* help, std::optional<double>& longest) {
  return {"--longest", &longest, help, {.value = "S", .above_0 = true}};
}

std::string as_typed(const Options& options) {
  std::string words;
  for (const Option& option : options)
    words += std::visit(
        [&]<class T>(const T& to) -> std::string {
          if constexpr (std::is_pointer_v<T> && !std::is_function_v<std::remove_pointer_t<T>>)
            return word_of(option.names, *to);
          return "";
        },
        option.to);
  return words;
}

}  // namespace lantern::report
