// The chart panel: one count against another as lines, or counts as bars.
#pragma once

#include <string>

#include "draw/labels.hpp"
#include "scenario/frame.hpp"

namespace lantern {

// Lines carry marks of different shapes and their names at their ends; the newest point of each is
// larger and says its number. Bars lie level, their names before and their numbers behind them.
// Points that are not finite are left out; what there is no room for is said.
void draw_chart(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels);

// A count's or measure's name as words: "pair tests" of "pair_tests", "energy: bob" of
// "energy.bob".
std::string chart_words(std::string name);

}  // namespace lantern
