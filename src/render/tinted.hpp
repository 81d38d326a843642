// Colours of shapes: of their roles, and in an in-between on the way from one role to another.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "draw/draw_list.hpp"
#include "draw/theme.hpp"

namespace lantern::render {

// Red, green, blue and opacity, not multiplied; opacity 0 is not painted at all.
using Paint = std::array<std::uint8_t, 4>;

// Opaque unless it is tinted. `other` is the role of the tint that is mixed in: of its fill or its
// line. A role that is none has no colour, only less opacity.
inline Paint tinted(const Theme& theme, Role role, const Tint* tint, Role Tint::*other) {
  const auto color = [&](Role of) { return of == Role::none ? Color{} : theme[of]; };
  const Color own = color(role);
  if (!tint) return {own.r, own.g, own.b, static_cast<std::uint8_t>(role == Role::none ? 0 : 255)};
  const Color far = color(tint->*other);
  const double mine = role == Role::none ? 0 : 1 - tint->share;
  const double theirs = tint->*other == Role::none ? 0 : tint->share;
  const double all = mine + theirs;
  const auto whole = [](double x) { return static_cast<std::uint8_t>(std::floor(x + 0.5)); };
  const std::uint8_t opacity = whole(255 * tint->opacity * all);
  if (opacity == 0) return {};
  const auto mixed = [&](std::uint8_t a, std::uint8_t b) {
    return whole((a * mine + b * theirs) / all);
  };
  return {mixed(own.r, far.r), mixed(own.g, far.g), mixed(own.b, far.b), opacity};
}

}  // namespace lantern::render
