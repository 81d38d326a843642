// Names of series beside a piece of their line, in columns.
#pragma once

#include <string>
#include <vector>

#include "draw/labels.hpp"
#include "draw/plot_marks.hpp"

namespace lantern {

struct LegendEntry {
  std::string name;
  int look = 0;
  bool is_peer = false;
  PlotInk ink() const { return {look, is_peer}; }
};

// The height that they take in a legend so wide, page units.
double plot_legend_height(const std::vector<LegendEntry>& entries, double width, double size);

// At the top of `place`, in columns as wide as the longest name, read downwards. Names that are
// wider than the place are shortened; what has no room below is left out, and that is said.
void draw_plot_legend(const std::vector<LegendEntry>& entries, const Box<2>& place, double size,
                      DrawList& list, Labels& labels);

}  // namespace lantern
