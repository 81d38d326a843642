#include "app/measure_pages.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "report/bars.hpp"
#include "report/drift_plots.hpp"
#include "report/html_page.hpp"
#include "report/measure_plots.hpp"
#include "report/measure_tables.hpp"
#include "report/pages.hpp"

namespace lantern::app {

void save_pages(ReportFolder& folder, const Measurement& m, const MeasurePages& as) {
  folder.write("measure.csv", to_csv(m));
  folder.write("drift.csv", drift_csv(m));
  folder.write("circumstances.csv", to_csv(m.circumstances));
  folder.write("peers.csv", to_csv(m.peers));
  std::vector<ReportPage> pages;
  const std::vector<Bar> bars = as.bars ? measured_bars() : std::vector<Bar>();
  folder.write("report.html", to_html(std::span(&m, 1), bars));
  pages.push_back({"overview", draw_overview(m, bars)});
  for (const ProblemRows& problem : by_problem(m.rows)) {
    pages.push_back({problem.problem, draw_problem(problem, m)});
    if (std::ranges::any_of(problem.rows, [](const Row& row) { return !row.samples.empty(); }))
      pages.push_back({problem.problem + "_drift", draw_drift(problem, m)});
  }
  if (!m.peers.empty()) pages.push_back({"peers", draw_peers(m)});
  folder.draw(pages, as.theme, as.backend);
}

}  // namespace lantern::app
