// Plots in a web page: what draw_plot draws, with colours by style sheet, and each series in a
// group of its own class, so that a reader can choose what to see.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "draw/plot.hpp"

namespace lantern::report {

// The variables of a theme's colours, which the plots below are painted with: "--r3:#a0b1c2;...".
std::string web_colors(std::string_view theme);

// A sample of the series' line and mark, for a legend.
std::string web_sample(const PlotInk& ink);

// The plot without its title and the name of y, which the page writes. `classes` has one class list
// for each of its series. Runs that failed are open marks at the upper edge, errors of 0 on a strip
// below a logarithmic scale, spreads whiskers. Slopes, which the series' names tell, are left out.
// Every mark has a title with its numbers.
std::string web_plot(const Plot& plot, const std::vector<std::string>& classes);

}  // namespace lantern::report
