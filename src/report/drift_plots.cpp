#include "report/drift_plots.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/check.hpp"
#include "report/measure_plots.hpp"
#include "report/page_parts.hpp"
#include "report/words.hpp"

namespace lantern::report {
namespace {

constexpr double kDriftMargin = 60;

// Nothing if no run has samples.
std::optional<double> shared_step(const ProblemRows& problem) {
  std::map<double, std::size_t> runs;  // of each step
  for (const Row& row : problem.rows)
    if (!row.samples.empty()) ++runs[row.step];
  const auto most = std::ranges::max_element(
      runs, {}, [](const auto& entry) { return std::pair(entry.second, -entry.first); });
  return most == runs.end() ? std::nullopt : std::optional(most->first);
}

// The value of a sample; nothing for one that has none.
using SampleValue = std::optional<double> (*)(const DriftSample&);
constexpr SampleValue kError = [](const DriftSample& s) { return std::optional(s.error); };
constexpr SampleValue kEnergy = [](const DriftSample& s) { return s.energy; };

Plot plot_of(const ProblemRows& problem, const Looks& looks, double step, SampleValue value) {
  Plot plot;
  plot.x_name = fmt::format("seconds since the start, in steps of {} s", figure(step));
  for (const MethodRows& method : by_method(problem)) {
    PlotSeries& series = plot.series.emplace_back(series_of(method, looks));
    const auto row = std::ranges::find(method.rows, step, &Row::step);
    if (row == method.rows.end()) continue;
    for (const DriftSample& sample : row->samples)
      if (const auto y = value(sample)) {
        PlotPoint point{{sample.time, *y}};
        point.beyond = !std::isfinite(*y);
        series.points.push_back(point);
      }
  }
  send_far_ones_off(plot);
  return plot;
}

}  // namespace

std::optional<DriftPlots> drift_plots(const ProblemRows& problem, const Looks& looks) {
  const auto step = shared_step(problem);
  if (!step) return std::nullopt;
  DriftPlots plots{plot_of(problem, looks, *step, kError), plot_of(problem, looks, *step, kEnergy)};
  plots.error.title = "Error so far against time";
  plots.error.y_name = error_words(problem);
  plots.energy.title = "Drift of the energy against time";
  plots.energy.y_name = "largest change of the energy so far, relative";
  plots.energy.empty = "the problem does not keep its energy";
  return plots;
}

DrawList draw_drift(const ProblemRows& problem, const Measurement& measurement) {
  auto plots = drift_plots(problem, looks_of(measurement.rows));
  LANTERN_CHECK(plots.has_value(), ==, true);
  DrawList list;
  Labels labels(list);
  draw_page_title(problem_words(problem), fmt::format("drift with time  ·  {}", file_name(problem)),
                  kDriftMargin, list, labels);
  const double bottom = draw_page_foot({}, circumstances_text(measurement.circumstances),
                                       kDriftMargin, list, labels) -
                        18;
  draw_plot_pair(std::move(plots->error), std::move(plots->energy), bottom, kDriftMargin, list,
                 labels);
  return list;
}

}  // namespace lantern::report
