// The chart of a scenario: what steps with a `plot` counted.
#pragma once

#include <string>

#include "scenario/frame.hpp"

namespace lantern {

class Plotter {
 public:
  explicit Plotter(const ChartSpec& spec) : is_bars_(spec.x.empty()) {
    chart_.x_name = spec.x;
    chart_.y_name = spec.y.size() == 1 ? spec.y[0] : "";
    chart_.logarithmic = spec.logarithmic;
    for (const std::string& name : spec.y) chart_.series.push_back({name, {}});
  }

  // A point on each line, or a bar of this label. A new part begins a new group of bars. What the
  // frame does not count is left out.
  void add(const std::string& label, const std::string& part, const Frame& frame) {
    if (!chart_.bars.empty() && part != part_) ++group_;
    part_ = part;
    const auto x = is_bars_ ? std::optional<std::int64_t>(0) : frame.count(chart_.x_name);
    for (FrameSeries& series : chart_.series) {
      const auto y = frame.count(series.name);
      if (!x || !y) continue;
      if (is_bars_)
        chart_.bars.push_back({label, static_cast<double>(*y), group_});
      else
        series.points.push_back({static_cast<double>(*x), static_cast<double>(*y)});
    }
  }

  // Bars have no lines.
  FrameChart chart() const {
    FrameChart chart = chart_;
    if (is_bars_) chart.series.clear();
    return chart;
  }

 private:
  bool is_bars_;
  FrameChart chart_;
  int group_ = 0;
  std::string part_;  // of the last bar
};

}  // namespace lantern
