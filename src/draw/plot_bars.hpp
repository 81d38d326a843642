// Counts as level bars, in groups.
#pragma once

#include "draw/labels.hpp"
#include "scenario/frame.hpp"

namespace lantern {

// Fills the panel: names before the bars, numbers behind them, type of this size. Bars that are not
// finite are left out, and those at the end that there is no room for; these are counted in words.
void draw_bars(const FrameChart& chart, const Box<2>& panel, double size, DrawList& list,
               Labels& labels);

}  // namespace lantern
