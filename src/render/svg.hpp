// A DrawList as SVG: text as outlines, no fonts, no graphics library.
#pragma once

#include <string>

#include "draw/draw_list.hpp"
#include "draw/theme.hpp"

namespace lantern::render {

// One file that stands alone; width and height in pixels, the page as its view box.
std::string to_svg(const DrawList& list, const Theme& theme, bool transparent, int width,
                   int height);

}  // namespace lantern::render
