// The page of `bench step`.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "geometry/box.hpp"
#include "report/bench_page.hpp"
#include "report/bench_step.hpp"

namespace lantern::report {
namespace {

// One point a solver: down is more exact, left is sooner.
Plot cost_plot(const BenchPage& page, const std::vector<const StepRow*>& rows) {
  Plot plot;
  plot.title = "Cost of a step, and what it leaves";
  plot.x_name = "ms a step, mean; whiskers: quartiles of single steps";
  plot.y_name = "deepest overlap at the end, units: lower left is better";
  for (const StepRow* row : rows) {
    if (row->simulated == 0) continue;
    PlotSeries series = page.series_of(row->solver);
    PlotPoint point{{row->mean, row->end.deepest}};
    point.beyond = row->status != Status::ok;
    point.spread = Box<2>{{row->lower_quartile, point.at.y}, {row->upper_quartile, point.at.y}};
    series.points.push_back(point);
    plot.series.push_back(series);
  }
  return plot;
}

std::vector<BenchCell> cells_of(const StepRow& row, double seconds) {
  const bool is_bad = row.status != Status::ok;
  std::string status(to_string(row.status));
  if (is_bad) status += ": " + row.reason;
  if (!is_bad && !row.is_whole(seconds)) status = fmt::format("only {:.2g} s of it", row.simulated);
  if (row.simulated == 0) return {{row.solver}, {}, {}, {}, {}, {}, {}, {}, {status, true}};
  const auto ms = [](double value) { return BenchCell{fmt::format("{:.3g}", value)}; };
  const auto size = [](double value) {
    return BenchCell{value == 0 ? "0" : fmt::format("{:.1e}", value)};
  };
  return {
      {row.solver},        ms(row.mean),
      ms(row.median),      {fmt::format("{:.3g} … {:.3g}", row.lower_quartile, row.upper_quartile)},
      ms(row.last_second), size(row.end.deepest),
      size(row.creep),     size(row.gained),
      {status, is_bad}};
}

std::vector<BenchContestant> solvers_of(const StepBenchResult& result) {
  std::vector<BenchContestant> solvers;
  for (const StepRow& row : result.rows)
    if (std::ranges::find(solvers, row.solver, &BenchContestant::name) == solvers.end())
      solvers.push_back({row.solver, row.version, ""});
  std::ranges::stable_sort(solvers, {}, &BenchContestant::is_peer);
  return solvers;
}

}  // namespace

std::string to_html(const StepBenchResult& result) {
  BenchPage page(
      {"A step of many bodies in contact",
       fmt::format("Piles that fall for {:g} s in steps of 1/60 s, friction 0.5, nothing "
                   "sleeps. Solvers take turns of a quarter of a second. Times are of "
                   "the processor, overlaps are measured from poses by one narrow phase "
                   "for all.",
                   result.config.seconds),
       result.command, result.circumstances},
      solvers_of(result));
  for (std::size_t i = 0; i < result.rows.size();) {
    const std::string& pile = result.rows[i].pile;
    std::vector<const StepRow*> rows;
    std::vector<std::vector<BenchCell>> table;
    for (; i < result.rows.size() && result.rows[i].pile == pile; ++i) {
      rows.push_back(&result.rows[i]);
      table.push_back(cells_of(result.rows[i], result.config.seconds));
    }
    page.begin_section(pile, "");
    page.add_plot(cost_plot(page, rows));
    page.add_table({"", "mean ms", "median", "quartiles", "last second", "deepest", "creep",
                    "energy gained", ""},
                   table);
  }
  return page.text();
}

}  // namespace lantern::report
