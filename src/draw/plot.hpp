// A plot of measured points on two axes: what the reports are made of.
#pragma once

#include <string>
#include <vector>

#include "draw/labels.hpp"

namespace lantern {

struct PlotPoint {
  Vec<2> at{0.0};       // x, y in the axes' units
  bool beyond = false;  // diverged: drawn as an open mark at the upper edge, whatever its y
  std::string note;     // written beside it if there is room; mostly empty
};

// Points of one contestant, joined in their order.
struct PlotSeries {
  std::string name;
  std::vector<PlotPoint> points;
  int look = 0;          // colour and mark; the same contestant has the same in every plot
  bool is_peer = false;  // dashed
  bool joined = true;
};

// A line that is not measured: an order's slope, a rounding floor, a theoretical limit, a bar.
struct PlotGuide {
  std::string name;
  std::vector<Vec<2>> points;
};

struct Plot {
  std::string title;
  std::string x_name, y_name;  // with their units: "seconds", "error (relative)"
  bool log_x = true,
       log_y = true;  // on a logarithmic axis, what is not above 0 is at its lower end
  std::vector<PlotSeries> series;
  std::vector<PlotGuide> guides;
  std::vector<Vec<2>> front;  // the Pareto front's corners, ascending in x; drawn as stairs
};

// Fills the panel. Names stand at the lines' ends or in a legend, none covers another. Points that
// are not finite are left out; an empty plot says that there is nothing to see.
void draw_plot(const Plot& plot, const Box<2>& panel, DrawList& list, Labels& labels);

}  // namespace lantern
