// One and the same picture at several sizes. Lantern puts some edges on whole pixels, so a draw
// list drawn sixteen times larger is a slightly different picture. Settled for one size, it is not.
#pragma once

#include "draw/draw_list.hpp"

namespace lantern::report {

// The list as it is drawn at this size, with nothing left to be put on pixels: snapped rects and
// lines lie where they come to lie, baselines of texts too, and dashes too short to be seen are
// unbroken lines. What is only approximated at this size (a text's place along its line, say) stays
// as it is wished.
DrawList settled(const DrawList& list, int width, int height);

// What is seen of the page through `window` (page units), as a page of its own. Shapes that do not
// reach it are left out.
DrawList window_of(const DrawList& list, const Box<2>& window);

}  // namespace lantern::report
