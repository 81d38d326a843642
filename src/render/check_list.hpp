// What every renderer asks of a draw list.
#pragma once

#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"
#include "draw/draw_list.hpp"

namespace lantern::render {

// Throws Refused, naming the shape's number, if a coordinate, size or width is not finite or is
// beyond a million page units, or if the page has no area, or if some shapes have a tint and others
// none.
inline void check_draw_list(const DrawList& list) {
  constexpr double kMost = 1e6;                                     // page units
  const auto sane = [](double x) { return std::abs(x) <= kMost; };  // false for NaN

  if (!sane(list.page.x) || !sane(list.page.y) || list.page.x <= 0 || list.page.y <= 0)
    throw Refused("a draw list's page must have a finite size above zero");
  if (!list.tints.empty() && list.tints.size() != list.shapes.size())
    throw Refused(fmt::format("a draw list of {} shapes has {} tints", list.shapes.size(),
                              list.tints.size()));
  for (std::size_t i = 0; i < list.shapes.size(); ++i) {
    bool good = true;
    const auto look_at = [&](double measure) { good &= sane(measure); };
    std::visit([&](const auto& s) { for_each_measure(s, look_at); }, list.shapes[i]);
    if (const auto* text = std::get_if<TextShape>(&list.shapes[i])) look_at(text->align);
    if (!good)
      throw Refused(fmt::format(
          "shape {} of the draw list has a coordinate or size that is not finite or beyond {}", i,
          kMost));
  }
}

}  // namespace lantern::render
