// Colours for roles.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "draw/role.hpp"

namespace lantern::draw {

struct Color {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Color&) const = default;
};

struct Theme {
  std::string_view name;
  std::array<Color, static_cast<std::size_t>(Role::count_)> colors;
  const Color& operator[](Role role) const { return colors[static_cast<std::size_t>(role)]; }
};

// light, dark, print
std::span<const Theme> themes();
std::optional<Theme> theme_named(std::string_view name);

}  // namespace lantern::draw
