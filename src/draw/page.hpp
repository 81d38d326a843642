// From a frame to shapes on a page.
#pragma once

#include <string>
#include <vector>

#include "base/work.hpp"
#include "draw/draw_list.hpp"
#include "draw/staging.hpp"
#include "frame/frame.hpp"

namespace lantern::draw {

// The page for an output of this many pixels: 1600 x 900 units for 16 : 9, longer on one side for
// other aspects, never shorter.
Vec<2> page_for(int width, int height);

// Title line, the frame's panels side by side (one above the other on a tall page), caption and
// counters. `staging` is of the group that the frame belongs to: it says what all of them share.
// Counts one layout for each panel that is there.
DrawList draw_frame(const Frame& frame, const Staging& staging, const Vec<2>& page, Work& work);

// The same of a frame that stands alone.
DrawList draw_frame(const Frame& frame, const Vec<2>& page, Work& work);

// The numbers beside the caption, as "3 pairs to test", the main one first; at most three.
std::vector<std::string> counter_texts(const Frame& frame);

// Does the world panel show any body that is no ground? What another body hides counts as shown,
// and so does what only a panel twice as wide as high would show: the page's size is not known.
bool shows_a_body(const Frame& frame);

// The finished atlas alone, one page unit a pixel: what is written as a real texture atlas.
DrawList draw_atlas_image(const Frame& frame);

}  // namespace lantern::draw
