// A key to slopes on logarithmic axes: lines that begin at one point and fall (or rise) as orders
// would.
//
//     +---___
//      `.    ---  h
//        `.
//          `  h²
#pragma once

#include <vector>

#include "draw/plot.hpp"
#include "draw/plot_axes.hpp"
#include "draw/plot_names.hpp"

namespace lantern {

// The least fan whose names can be told apart, in a corner of `area` where nothing else is; none if
// there is no such corner. `decade` is the size of a decade along x and y, page units.
void draw_slope_fan(const std::vector<PlotSlope>& slopes, const Vec<2>& decade, const Box<2>& area,
                    const PlotType& type, const PlotNamer& namer, DrawList& list, Labels& labels);

}  // namespace lantern
