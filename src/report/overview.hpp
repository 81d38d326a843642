// All of a measurement on one page: a small plot of each problem, and the bars.
#pragma once

#include "measure/row.hpp"
#include "report/bars.hpp"

namespace lantern {

// In the proportions of A3, 1600 units wide (2263 high) or as much larger as many problems need;
// for fewer than five only as high as these need.
// Each small plot names its scenario's file, so that every number can be found in the rows.
DrawList draw_overview(const Measurement& measurement, const std::vector<Bar>& bars);

}  // namespace lantern
