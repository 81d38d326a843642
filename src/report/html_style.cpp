#include "report/html_style.hpp"

#include <fmt/format.h>

#include "base/markup.hpp"
#include "draw/theme.hpp"
#include "report/html_plot.hpp"

namespace lantern::report {
namespace {

std::string theme_text(std::string_view name) {
  const Theme theme = *theme_named(name);
  std::string text;
  const auto add = [&](std::string_view variable, Role role) {
    const Color& c = theme[role];
    text += fmt::format("--{}:#{:02x}{:02x}{:02x};", variable, c.r, c.g, c.b);
  };
  add("paper", Role::paper);
  add("panel", Role::panel);
  add("ink", Role::ink);
  add("quiet", Role::quiet_ink);
  add("rule", Role::rule);
  add("line", Role::body_line);
  add("warning", Role::warning);
  for (int i = 1; i <= 8; ++i) add(fmt::format("b{}", i), body_role(i));
  return text;
}

}  // namespace

std::string html_begin(std::string_view title, std::string_view rules) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width\"><title>{}</title>"
      "\n<style>:root{{color-scheme:light dark;{}}}@media(prefers-color-scheme:dark)"
      "{{:root{{{}}}}}@media print{{:root{{{}}}}}{}{}</style></head>\n<body>\n{}",
      escaped(title), theme_text("light"), theme_text("dark"), theme_text("print"), kPageStyle,
      rules, svg_marks());
}

}  // namespace lantern::report
