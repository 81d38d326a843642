// What every renderer asks of a draw list.
#pragma once

#include "draw/draw_list.hpp"

namespace lantern {

// Throws Refused, naming the shape's number, if a coordinate, size or width is not finite or is
// beyond a million page units, or if the page has no area.
void check_draw_list(const DrawList& list);

}  // namespace lantern
