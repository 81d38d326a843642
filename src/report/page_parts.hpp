// What stands above and below the plots of a page.
#pragma once

#include <string>
#include <vector>

#include "draw/labels.hpp"
#include "draw/plot.hpp"

namespace lantern::report {

// The title in bold, behind it what else is to be said, and a rule below, at y = 78 page units.
void draw_page_title(const std::string& title, const std::string& rest, double margin,
                     DrawList& list, Labels& labels);

// What a reader must know beside the plots, in three lines at most, and in small how it was
// measured. Between the page's margins, at its lower edge; `margin` in page units. Gives the y of
// the rule above it.
double draw_page_foot(const std::vector<std::string>& notes, const std::string& small,
                      double margin, DrawList& list, Labels& labels);

// Two plots of the same series side by side, from below the title to `bottom`, with one legend
// below, unless the left one names its lanes.
void draw_plot_pair(Plot left, Plot right, double bottom, double margin, DrawList& list,
                    Labels& labels);

}  // namespace lantern::report
