// The legend: each mark of a picture as small as it is, and beside it what it means.
#pragma once

#include <string_view>

#include "draw/labels.hpp"

namespace lantern::draw {

// What a mark means, in a few words.
std::string_view words_of(MarkKind kind);

// The mark alone in this box, drawn by what draws it in a world; gives what is told of it then.
MarkSet draw_sample(MarkKind kind, const Box<2>& box, DrawList& list);

// How high a strip of this width must be for these marks; 0 if there are none.
double legend_height(const MarkSet& marks, double width);

// The marks in rows, in the order of their kinds.
void draw_legend(const MarkSet& marks, const Box<2>& strip, DrawList& list, Labels& labels);

}  // namespace lantern::draw
