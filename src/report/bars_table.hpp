// The bars as a table: what was promised, what was measured, and how far apart they are.
#pragma once

#include <vector>

#include "draw/labels.hpp"
#include "report/overview.hpp"

namespace lantern {

double bars_table_height(const std::vector<Bar>& bars);  // page units

// As wide as the place. The strip shows the measured value on a logarithmic scale on which every
// bar is the middle line: left of it is better.
void draw_bars_table(const std::vector<Bar>& bars, const Box<2>& place, DrawList& list,
                     Labels& labels);

}  // namespace lantern
