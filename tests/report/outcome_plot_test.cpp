// Problems that are right or wrong: their plots.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "draw/layout_check.hpp"
#include "report/problem_rows.hpp"
#include "report/sample_rows.hpp"

namespace lantern::report {
namespace {

using samples::row;

// As of blocks that should hit each other some number of times.
Measurement outcomes(const std::vector<double>& wrong, std::size_t methods = 3) {
  Measurement m;
  for (std::size_t k = 0; k < methods; ++k)
    for (std::size_t i = 0; i < wrong.size(); ++i) {
      const double h = 0.1 / static_cast<double>(1 << i);
      Row r = row(fmt::format("method_{}", k), h, k % 2 ? wrong[i] : 0,
                  1e-4 / h * static_cast<double>(k + 1), 124);
      r.norms[0].name = "hits";
      m.rows.push_back(r);
    }
  return m;
}

TEST(Bands, HoldEveryWholeNumber) {
  for (const double most : {0.0, 1.0, 2.0, 9.0, 10.0, 437.0, 999.0, 1000.0, 3141592.0}) {
    Plot plot;
    plot.series = {{"a", {{{1, most}, false, ""}}}};
    put_into_bands(plot);
    for (double value = 0; value <= most; value = value < 20 ? value + 1 : 2 * value + 3) {
      const auto in =
          std::ranges::count_if(plot.bands, [&](const PlotBand& b) { return b.holds(value); });
      EXPECT_EQ(in, 1) << value << " is in " << in << " bands, the most being " << most;
    }
    EXPECT_LE(plot.bands.size(), 6u);
  }
}

TEST(OutcomePage, TellsExactFromWrong) {
  const Measurement m = outcomes({1, 12, 0, 0});
  const DrawList list = draw_problem(by_problem(m.rows)[0], m);
  for (const char* text :
       {"exact", "off by 1", "off by 10 to 99", "12", "Outcome against time", "Time against step"})
    EXPECT_TRUE(says(list, text)) << text;
  EXPECT_FALSE(says(list, "off by 2 to 9")) << "a band for nothing";
  std::size_t named = 0;
  for (const LabelBox& label : list.labels) named += label.text == "method 1";
  EXPECT_EQ(named, 3u) << "in each band that it has runs in";
}

TEST(OutcomePage, IsLaidOutHoweverManyTakePart) {
  for (const std::size_t methods : {1u, 2u, 9u, 16u, 17u, 40u})
    for (const auto& wrong : {std::vector<double>{0}, {0, 1}, {5, 1, 700, 12, 0, 3e6}}) {
      Measurement m = outcomes(wrong, methods);
      const auto draw = [&](const char* how) {
        const ProblemRows problem = by_problem(m.rows)[0];
        const DrawList list = draw_problem(problem, m);
        const std::string where =
            fmt::format("{} methods, {} steps, {}", methods, wrong.size(), how);
        expect_laid_out(list, {{0, 0}, list.page}, kLeastDeskLabel, where);
        for (const MethodRows& c : by_method(problem))
          EXPECT_TRUE(methods > 17 || says_part(list, method_words(c.method))) << where;
      };
      draw("timed");
      m.rows[0].status = Status::diverged;
      draw("one diverged");
      for (Row& r : m.rows) r.timing = r.processor = {};
      draw("untimed");
      for (Row& r : m.rows) r.counted = {};
      draw("nothing counted");
    }
}

TEST(OutcomePage, NobodyExactIsSaid) {
  const Measurement m = outcomes({1, 1, 1}, 2);
  Measurement wrong;
  for (const Row& r : m.rows)
    if (r.method == "method_1") wrong.rows.push_back(r);
  EXPECT_TRUE(says(draw_problem(by_problem(wrong.rows)[0], wrong), "exact: none"));
}

TEST(StepPlot, WrongOutcomesAreOpen) {
  const Measurement m = outcomes({1, 0, 0});
  const ProblemRows problem = by_problem(m.rows)[0];
  const Plot plot = step_plot(problem, seconds_of, looks_of(m.rows));
  ASSERT_EQ(plot.series.size(), 3u);
  EXPECT_TRUE(plot.series[1].points[0].open);
  EXPECT_FALSE(plot.series[1].points[1].open);
  EXPECT_FALSE(plot.series[0].points[0].open);
  EXPECT_EQ(plot.series[1].points[0].at.x, 0.1) << "the step is to the right";
}

TEST(ProblemPage, ShowsTheStepWhereWorkIsTheSameForAll) {
  Measurement m = outcomes({0.5, 0.25, 0.125});
  const DrawList list = draw_problem(by_problem(m.rows)[0], m);
  EXPECT_TRUE(says(list, "Error against step")) << "one count for all runs is a plot of one point";
  m.rows[0].counted.force_evaluations = 99;
  EXPECT_FALSE(says(draw_problem(by_problem(m.rows)[0], m), "Error against step"));
}

}  // namespace
}  // namespace lantern::report
