// Lines of a plot: what is left of a long series, and those that are no series: the front's stairs,
// guides and slopes. These are drawn first, and named when all marks are in place.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "draw/plot.hpp"
#include "draw/plot_parts.hpp"

namespace lantern::draw {

// Many points become about as many as `most`, so that the page can tell them apart: of each part of
// the line its first, lowest, highest and last one.
std::vector<Vec<2>> thinned(const std::vector<Vec<2>>& points, std::size_t most);

// The Pareto front: from the upper edge down to the first corner, then in steps from corner to
// corner to the right edge, under the marks. Corners are on the page, ascending in x; those that
// are not finite are left out. `area` is the part of the plot that has a scale, `rim` the width of
// the stairs' outline. Gives the steps.
std::vector<Vec<2>> draw_front(const std::vector<Vec<2>>& corners, const Box<2>& area, double width,
                               double rim, DrawList& list);
// Along the last step where it is free, else along the others.
void name_front(const std::string& text, const std::vector<Vec<2>>& steps, double width,
                TextStyle style, PlotNamer& namer);

// A guide, dashed and cut to the area. Gives the pieces.
using Pieces = std::vector<std::pair<Vec<2>, Vec<2>>>;
Pieces draw_guide(const std::vector<Vec<2>>& points, const Box<2>& area, PlotNamer& namer,
                  DrawList& list);
void name_guide(const std::string& text, const Pieces& pieces, const TextStyle& style,
                PlotNamer& namer);

// A key to slopes on logarithmic axes: lines that begin at one point and fall (or rise) as orders
// would.
//
//     +---___
//      `.    ---  h
//        `.
//          `  h²
//
// The least fan whose names can be told apart, in a corner of `area` where nothing else is; none if
// there is no such corner. `decade` is the size of a decade along x and y, page units.
void draw_slope_fan(const std::vector<PlotSlope>& slopes, const Vec<2>& decade, const Box<2>& area,
                    const PlotType& type, const PlotNamer& namer, DrawList& list, Labels& labels);

}  // namespace lantern::draw
