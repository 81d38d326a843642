// A DrawList as SVG: no graphics library.
#pragma once

#include <optional>

#include "draw/draw_list.hpp"
#include "draw/theme.hpp"

namespace lantern::render {

// What an SVG says beside its shapes.
struct SvgWords {
  std::string title, description;  // for whoever does not see the picture; empty for none
  std::string prefix;              // of all ids: other files in the same page have others
  // Letters as <text> in whatever face of the name is there, as wide as they are in Inter; else as
  // outlines, which need no font.
  bool letters = false;
  std::optional<Vec<2>> points = std::nullopt;  // its size on paper, instead of one in pixels
};

// One file that stands alone; width and height in pixels, the page as its view box.
std::string to_svg(const DrawList& list, const Theme& theme, bool transparent, int width,
                   int height, const SvgWords& words = {});

}  // namespace lantern::render
