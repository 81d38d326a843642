// Plots for problems where error against work says little: those that are right or wrong, and those
// whose work does not depend on the step.
#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "report/measure_plots.hpp"
#include "report/sentences.hpp"

namespace lantern {

void put_into_bands(Plot& plot) {
  double most = 0;
  for (PlotSeries& series : plot.series)
    for (PlotPoint& p : series.points) {
      if (p.beyond) continue;
      most = std::max(most, p.at.y);
      if (p.at.y > 1) p.note = figure(p.at.y);
    }
  plot.bands = {{"exact", 0, 0}, {"off by 1", 1, 1}};
  for (double from = 2, to = 9; from <= most && to < 1e3; from = to + 1, to = 10 * to + 9)
    plot.bands.push_back({fmt::format("off by {} to {}", from, to), from, to});
  if (most >= 1e3) plot.bands.push_back({"off by 1000 or more", 1e3, most});
  plot.guides.clear();
  plot.slopes.clear();
  plot.front_name = "cheapest";
}

PlotSeries series_of(const MethodRows& method, const std::map<std::string, int>& looks) {
  return {method.name(), {}, looks.at(method.method), method.is_peer};
}

Plot step_plot(const ProblemRows& problem, const Cost& value,
               const std::map<std::string, int>& looks) {
  Plot plot;
  const bool whole = has_whole_errors(problem);
  for (const MethodRows& c : by_method(problem)) {
    PlotSeries series = series_of(c, looks);
    for (const Row& row : c.rows)
      if (const auto y = value(row)) {
        PlotPoint point{{row.step, *y}, !std::isfinite(*y), "", false, {}};
        point.open = whole && row.error() > 0.0;
        if (y == seconds_of(row))
          point.spread =
              Box<2>{{row.step, row.timing.lower_quartile}, {row.step, row.timing.upper_quartile}};
        series.points.push_back(point);
      }
    plot.series.push_back(std::move(series));
  }
  plot.x_name = "step h, seconds";
  return plot;
}

bool is_one_count(const ProblemRows& problem, const WorkCount& work) {
  std::set<double> counts;
  for (const Row& row : problem.rows)
    if (const auto count = work.of(row)) counts.insert(*count);
  return counts.size() == 1;
}

}  // namespace lantern
