// From a frame to shapes on a page.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/work.hpp"
#include "draw/draw_list.hpp"
#include "draw/labels.hpp"
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

// A page on which a layout is so many units wide, and as high as its panels want, for draw_frame():
// its own letters may be larger by page.x / width.
Vec<2> page_across(const Frame& frame, double width);

// The numbers beside the caption, as "3 candidate pairs", the main one first; at most three.
std::vector<std::string> counter_texts(const Frame& frame);

// Does the world panel show any body that is no ground? What another body hides counts as shown,
// and so does what only a panel twice as wide as high would show: the page's size is not known.
bool shows_a_body(const Frame& frame);

// The finished atlas alone, one page unit a pixel: what is written as a real texture atlas.
DrawList draw_atlas_image(const Frame& frame);

// The legend: each mark of a picture as small as it is, and beside it what it means.

// What a mark means, in a few words.
std::string_view words_of(MarkKind kind);

// The mark alone in this box, drawn by what draws it in a world; gives what is told of it then.
MarkSet draw_sample(MarkKind kind, const Box<2>& box, DrawList& list);

// How high a strip of this width must be for these marks; 0 if there are none.
double legend_height(const MarkSet& marks, double width);

// The marks in rows, in the order of their kinds.
void draw_legend(const MarkSet& marks, const Box<2>& strip, DrawList& list, Labels& labels);

}  // namespace lantern::draw
