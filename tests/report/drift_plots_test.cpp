// Error and energy against the time that has passed.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "draw/layout_check.hpp"
#include "render/canvas.hpp"
#include "report/measure_document.hpp"
#include "report/pages.hpp"
#include "report/problem_rows.hpp"
#include "report/sample_rows.hpp"

namespace lantern::report {
namespace {

TEST(DriftPlots, AreOfTheStepThatMostMethodsShare) {
  const Measurement m = samples::measurement(1);
  ProblemRows problem = by_problem(m.rows)[0];
  const Looks looks = looks_of(m.rows);
  const double finest = std::ranges::min(problem.rows, {}, &Row::step).step;
  const double coarsest = std::ranges::max(problem.rows, {}, &Row::step).step;
  auto plots = drift_plots(problem, looks);
  ASSERT_TRUE(plots);
  const std::vector<MethodRows> methods = by_method(problem);
  ASSERT_EQ(plots->error.series.size(), methods.size());
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const Row& row = methods[i].rows.back();
    ASSERT_EQ(row.step, finest);
    ASSERT_EQ(plots->error.series[i].points.size(), row.samples.size());
    EXPECT_EQ(plots->error.series[i].points.back().at, Vec<2>(10.3, row.samples.back().error));
    EXPECT_EQ(plots->energy.series[i].points[0].at.y, *row.samples[0].energy);
  }
  for (Row& row : problem.rows)
    if (row.step == finest && row.method == methods[0].method) row.samples.clear();
  EXPECT_NE(drift_plots(problem, looks)->error.series[0].points.size(), 0u)
      << "another step is shared by more";
  for (Row& row : problem.rows)
    if (row.step != coarsest || row.method != methods[0].method) row.samples.clear();
  plots = drift_plots(problem, looks);
  EXPECT_EQ(plots->error.series[1].points.size(), 0u);
  EXPECT_EQ(plots->error.series[0].points.size(), 4u);
  problem.rows.clear();
  EXPECT_FALSE(drift_plots(problem, looks));
}

TEST(DriftPlots, PutWhatIsBeyondTheScaleToTheEdge) {
  ProblemRows problem{"p", "p", "plain", {}};
  for (const auto& [method, error] : {std::pair("velocity_verlet", 1e-4), std::pair("Bullet", 2.0),
                                      std::pair("explicit_euler", HUGE_VAL)}) {
    Row& row = problem.rows.emplace_back();
    row.method = method;
    row.step = 0.5;
    row.samples = {{1, 1e-5, {}}, {10, error, {}}};
  }
  const auto plots = drift_plots(problem, looks_of(problem.rows));
  EXPECT_TRUE(plots->error.series[2].points[1].beyond);
  EXPECT_TRUE(plots->energy.series[0].points.empty());
}

TEST(DriftPlots, MakeAPageAndStandOnTheWebPage) {
  const Measurement m = samples::measurement();
  std::size_t drawn = 0;
  for (const ProblemRows& problem : by_problem(m.rows)) {
    const auto plots = drift_plots(problem, looks_of(m.rows));
    EXPECT_EQ(plots.has_value(), !problem.rows[0].samples.empty());
    if (!plots) continue;
    const DrawList list = draw_drift(problem, m).value();
    expect_laid_out(list, {{0, 0}, list.page}, kLeastDeskLabel, problem.problem);
    EXPECT_NO_THROW(check_draw_list(list));
    ++drawn;
  }
  EXPECT_GT(drawn, 0u);
  const std::string html = to_html(document_of(std::span(&m, 1), {}));
  std::size_t told = 0;
  for (std::size_t at = 0; (at = html.find("Drift of the energy", at)) != std::string::npos; ++at)
    ++told;
  EXPECT_EQ(told, 2 * drawn) << "a heading and a label each";
}

}  // namespace
}  // namespace lantern::report
