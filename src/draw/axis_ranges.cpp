#include "draw/axis_ranges.hpp"

#include <algorithm>

#include "frame/parts/panels.hpp"

namespace lantern::draw {

void AxisRanges::see(const frame::Frame& frame) {
  const frame::FrameChart& chart = frame.get<FrameChart>();
  for (const frame::FrameBar& bar : chart.bars) chart_.add(bar.value, chart.logarithmic);
  for (const frame::FrameSeries& series : chart.series)
    for (const Vec<2>& p : series.points) {
      chart_.add(p.y, chart.logarithmic);
      chart_x_.add(p.x, chart.logarithmic && !chart.over_time);
    }
  for (const Vec<2>& p : frame.get<FrameTrace>().points) {
    trace_ = std::max(trace_, p.y);
    double& seconds = seconds_[frame.part];
    seconds = std::max(seconds, p.x);
  }
  for (const frame::Frame& side : frame.sides) see(side);
}

std::optional<double> AxisRanges::seconds_of(const std::string& part) const {
  const auto found = seconds_.find(part);
  return found == seconds_.end() || found->second <= 0 ? std::nullopt
                                                       : std::optional(found->second);
}

}  // namespace lantern::draw
