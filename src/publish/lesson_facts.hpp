// What a page tells of a frame when it is asked, and by which it knows what belongs together.
#pragma once

#include <string>

#include "draw/draw_list.hpp"
#include "scenario/frame.hpp"

namespace lantern::publish {

// A list of objects, one for the frame or one for each of its sides:
//   name, title    of the side; empty without sides
//   counts         [["pairs", 3], ...], and measures likewise
//   textures       [id, "name"]
//   bodies         [id, "name", [x, y], speed, "static" | "asleep" | ""]
//   nodes          ["root.0", "label", depth, leaf, [body ids], outline, pool slot]: the outline on
//                  the page, [x, y, ...] in page units, of a flat world; the slot or -1
//   pairs          [a, b, their boxes overlap]
//   contacts       [a, b]
// Measures, places and speeds have five digits: they are to be read, not to be reckoned with.
std::string facts_for_page(const Frame& frame, const DrawList& list);

}  // namespace lantern::publish
