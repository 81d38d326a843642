// What the axes of a sequence must hold, so that none of them changes from frame to frame.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "draw/plot_layout.hpp"
#include "frame/frame.hpp"

namespace lantern::draw {

// Of all frames that it was shown. Nothing is known of what none of them has.
class AxisRanges {
 public:
  using Ends = std::optional<std::pair<double, double>>;

  void see(const frame::Frame& frame);
  Ends chart() const { return ends_of(chart_); }      // of charts' values
  Ends chart_x() const { return ends_of(chart_x_); }  // of what they are drawn against
  double trace() const { return trace_; }             // the most of a sparkline
  // That a part's sparkline goes on for.
  std::optional<double> seconds_of(const std::string& part) const;

 private:
  static Ends ends_of(const PlotRange& range) {
    return range.empty() ? Ends() : std::pair(range.least, range.most);
  }

  PlotRange chart_, chart_x_;
  double trace_ = 0;
  std::map<std::string, double> seconds_;  // by part
};

}  // namespace lantern::draw
