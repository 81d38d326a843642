#include "draw/axis_ranges.hpp"

#include <algorithm>

namespace lantern::draw {

void AxisRanges::see(const scenario::Frame& frame) {
  const scenario::FrameChart& chart = frame.get<FrameChart>();
  for (const scenario::FrameBar& bar : chart.bars) chart_.add(bar.value, chart.logarithmic);
  for (const scenario::FrameSeries& series : chart.series)
    for (const Vec<2>& p : series.points) {
      chart_.add(p.y, chart.logarithmic);
      chart_x_.add(p.x, chart.logarithmic && !chart.over_time);
    }
  for (const Vec<2>& p : frame.get<FrameTrace>().points) {
    trace_ = std::max(trace_, p.y);
    double& seconds = seconds_[frame.part];
    seconds = std::max(seconds, p.x);
  }
  for (const scenario::Frame& side : frame.sides) see(side);
}

void AxisRanges::settle(scenario::Frame& frame) const {
  if (auto* chart = frame.find<FrameChart>()) {
    if (!chart_.empty()) chart->range = std::pair(chart_.least, chart_.most);
    if (!chart_x_.empty() && !chart->over_time)
      chart->x_range = std::pair(chart_x_.least, chart_x_.most);
  }
  if (auto* trace = frame.find<FrameTrace>()) {
    if (trace_ > 0) trace->most = trace_;
    const auto seconds = seconds_.find(frame.part);
    if (!trace->seconds && seconds != seconds_.end() && seconds->second > 0)
      trace->seconds = seconds->second;
  }
  for (scenario::Frame& side : frame.sides) settle(side);
}

}  // namespace lantern::draw
