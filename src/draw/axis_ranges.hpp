// What the axes of a sequence must hold, so that none of them changes from frame to frame.
#pragma once

#include <map>
#include <string>

#include "draw/plot_layout.hpp"
#include "scenario/frame.hpp"

namespace lantern::draw {

// Shown all frames of a sequence, or of what shall have one scale, it knows the axes of each.
class AxisRanges {
 public:
  void see(const scenario::Frame& frame);
  // The frame's chart and sparkline get the ends of the whole; those that a scenario has set stay.
  void settle(scenario::Frame& frame) const;

 private:
  PlotRange chart_, chart_x_;
  double trace_ = 0;
  std::map<std::string, double> seconds_;  // of the sparkline, by part
};

}  // namespace lantern::draw
