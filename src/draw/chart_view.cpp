#include <algorithm>
#include <cmath>

#include "draw/panels.hpp"
#include "draw/plot.hpp"

namespace lantern {
namespace {

// A panel that has the page for itself gets larger type.
double type_size(const Box<2>& panel) {
  return panel.size().x > 1000 && panel.size().y > 380 ? 1.22 * kLabel : kLabel;
}

Plot plot_of(const FrameChart& chart) {
  Plot plot;
  plot.slide = true;
  plot.names = PlotNames::column;
  plot.over_time = chart.over_time;
  plot.seconds = chart.seconds;
  plot.least = chart.least;
  plot.most = chart.most;
  plot.log_y = chart.logarithmic;
  plot.log_x = chart.logarithmic && !chart.over_time;
  plot.x_name = chart.over_time ? "time in s" : chart_words(chart.x_name);
  if (plot.log_x) plot.x_note = plot.x_name.empty() ? "both logarithmic" : "  (both logarithmic)";
  plot.title = chart_words(chart.y_name);
  for (const FrameSeries& series : chart.series) {
    PlotSeries& line = plot.series.emplace_back();
    line.name = chart_words(series.name);
    line.look = static_cast<int>(plot.series.size()) - 1;
    line.color = series.color;
    for (const Vec<2>& p : series.points) line.points.push_back({p});
  }
  if (plot.series.size() == 1 && plot.title.empty()) plot.title = plot.series[0].name;
  if (plot.over_time && plot.log_y && !plot.title.empty()) plot.title += "  (logarithmic)";
  return plot;
}

}  // namespace

std::string chart_words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  if (const std::size_t dot = name.find('.'); dot != std::string::npos) name.replace(dot, 1, ": ");
  return name;
}

void draw_chart(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels) {
  const FrameChart& chart = frame.chart;
  const Box<2> place = shrunk(panel, 4);
  if (place.size().x < 40 || place.size().y < 40) return;
  if (!chart.bars.empty()) return draw_bars(chart, place, type_size(place), list, labels);
  Plot plot = plot_of(chart);
  plot.size = type_size(place);
  draw_plot(plot, place, list, labels);
}

}  // namespace lantern
