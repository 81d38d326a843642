// The pages of a measurement: layout, what they say, and that they can be drawn at all.
#include "report/pages.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "draw/layout_check.hpp"
#include "render/canvas.hpp"
#include "report/problem_rows.hpp"
#include "report/sample_rows.hpp"

namespace lantern::report {
namespace {

// Measurements that reports must bear.
std::vector<std::pair<std::string, Measurement>> measurements() {
  std::vector<std::pair<std::string, Measurement>> all = {
      {"nine", samples::measurement()}, {"none", {}}, {"one", samples::measurement(1)}};
  Measurement untimed = samples::measurement(8, 2);
  for (Row& row : untimed.rows) row.timing = row.processor = {};
  all.push_back({"untimed", untimed});
  Measurement failed = samples::measurement(3, 3);
  for (Row& row : failed.rows) {
    row.status = Status::diverged;
    row.norms = {{"traj", HUGE_VAL}};
  }
  all.push_back({"failed", failed});
  Measurement bare = samples::measurement(2, 4);
  for (Row& row : bare.rows) {
    row.norms.clear();
    row.family.clear();
    row.counted = {};
  }
  all.push_back({"bare", bare});
  Measurement crowd = samples::measurement(2, 5);
  const std::size_t n = crowd.rows.size();
  for (std::size_t i = 0; i < n; ++i) {
    Row row = crowd.rows[i];
    row.method += fmt::format("_with_a_very_long_name_indeed_{}", i % 4);
    row.norms[0].value *= 1e20;
    crowd.rows.push_back(row);
  }
  crowd.circumstances.processor = std::string(300, 'x');
  all.push_back({"crowd", crowd});
  return all;
}

TEST(ProblemPage, IsLaidOut) {
  for (const auto& [name, m] : measurements())
    for (const ProblemRows& problem : by_problem(m.rows)) {
      const DrawList list = draw_problem(problem, m);
      EXPECT_EQ(list.page, Vec<2>(1600, 900));
      expect_laid_out(list, {{0, 0}, list.page}, kLeastDeskLabel, name + " " + problem.problem);
      EXPECT_NO_THROW(check_draw_list(list));
    }
}

TEST(ProblemPage, SaysItsNotesItsFileAndItsCircumstances) {
  const Measurement m = samples::measurement();
  for (const ProblemRows& problem : by_problem(m.rows)) {
    const DrawList list = draw_problem(problem, m);
    EXPECT_TRUE(says_part(list, problem.problem + ".toml"));
    EXPECT_TRUE(says(list, circumstances_text(m.circumstances)));
    std::string all;
    for (const LabelBox& label : list.labels) all += label.text + " ";
    for (const std::string& note : notes_on(problem))
      EXPECT_NE(all.find(note), std::string::npos) << note << "\n" << all;
    EXPECT_TRUE(says_part(list, work_count(problem).name));
    for (const MethodRows& c : by_method(problem))
      EXPECT_TRUE(says_part(list, c.is_peer ? c.method : method_words(c.method))) << c.method;
  }
}

// It is read from the last row.
TEST(Slide, IsLaidOutInLargeTypeAndNamesAllThatDoAWorldsStep) {
  for (const auto& [name, m] : measurements())
    for (const ProblemRows& problem : by_problem(m.rows)) {
      const DrawList list = draw_slide(problem, m);
      expect_laid_out(list, {{0, 0}, list.page}, kLeastLabel, name + " " + problem.problem);
      EXPECT_TRUE(says_part(list, problem_words(problem) + ": error against run time"));
    }
  Measurement m = samples::measurement(1);
  m.rows.push_back(m.rows[0]);
  m.rows.back().method = kAdaptive;
  const ProblemRows problem = by_problem(m.rows)[0];
  const DrawList list = draw_slide(problem, m);
  for (const MethodRows& c : by_method(problem))
    EXPECT_EQ(says(list, c.name()), c.method != kAdaptive) << c.method;
}

TEST(ProblemPage, PrintsTheObservedOrders) {
  const Measurement m = samples::measurement(1);
  const DrawList list = draw_problem(by_problem(m.rows)[0], m);
  EXPECT_TRUE(says_part(list, "Runge–Kutta 4: order 4.0") ||
              says_part(list, "Runge–Kutta 4: order 3.9"));
  for (const char* name : {"h", "h²", "h⁴", "front, borne out", "diverged"})
    EXPECT_TRUE(says(list, name)) << name;
}

TEST(CostPlot, HasEveryRunThatCostSomething) {
  const Measurement m = samples::measurement();
  const auto looks = looks_of(m.rows);
  for (const ProblemRows& problem : by_problem(m.rows)) {
    std::size_t points = 0, beyond = 0, failed = 0;
    for (const PlotSeries& s : cost_plot(problem, seconds_of, looks, false).series)
      for (const PlotPoint& p : s.points) {
        ++points;
        beyond += p.beyond;
      }
    for (const Row& row : problem.rows) failed += row.status != Status::ok;
    EXPECT_EQ(points, problem.rows.size());
    EXPECT_EQ(beyond, failed);
  }
}

// It has no time, but its work was counted.
TEST(CostPlot, ShowsARunThatDivergedByItsWorkAlone) {
  ProblemRows problem{"oscillator", "oscillator", "plain", {}};
  problem.rows = {samples::row("a", 0.1, 1, 0, 100), samples::row("a", 0.05, 1e-3, 0.02, 200),
                  samples::row("a", 0.025, 1e-4, 0.04, 400)};
  problem.rows[0].status = Status::diverged;
  const Looks looks = looks_of(problem.rows);
  const auto timed = cost_plot(problem, seconds_of, looks, false).series;
  ASSERT_EQ(timed.size(), 1u);
  EXPECT_EQ(timed[0].points.size(), 2u);
  const auto work = [&](const Row& row) { return work_count(problem).of(row); };
  const auto counted = cost_plot(problem, work, looks, false).series;
  ASSERT_EQ(counted[0].points.size(), 3u) << "the run that diverged is not shown";
  EXPECT_TRUE(counted[0].points[0].beyond);
  EXPECT_EQ(counted[0].points[0].at.x, 100);
}

TEST(Overview, IsLaidOut) {
  for (const auto& [name, m] : measurements())
    for (const auto& bars : {std::vector<Bar>{}, samples::bars()}) {
      const DrawList list = draw_overview(m, bars);
      expect_laid_out(list, {{0, 0}, list.page}, 15, "overview of " + name);
      EXPECT_NO_THROW(check_draw_list(list));
    }
}

TEST(Overview, KeepsTheProportionsOfA3ForManyProblems) {
  for (const std::size_t problems : {5u, 9u, 16u, 36u, 45u}) {
    const DrawList list = draw_overview(samples::measurement(problems), samples::bars());
    EXPECT_GE(list.page.x, 1600);
    EXPECT_LE(std::max(list.page.x, list.page.y), 8192) << problems << " problems";
    EXPECT_NEAR(list.page.y / list.page.x, std::sqrt(2.0), 0.08) << problems << " problems";
    expect_laid_out(list, {{0, 0}, list.page}, 15, fmt::format("{} problems", problems));
  }
}

TEST(Overview, NamesTheFileOfEveryProblemAndTheRowOfEveryBar) {
  const Measurement m = samples::measurement(20);
  const DrawList list = draw_overview(m, samples::bars());
  for (const ProblemRows& problem : by_problem(m.rows))
    EXPECT_TRUE(says(list, problem.problem + ".toml")) << problem.problem;
  for (const Bar& bar : samples::bars()) {
    EXPECT_TRUE(says(list, bar.name)) << bar.name;
    EXPECT_TRUE(says_part(list, bar.reference)) << bar.reference;
  }
  EXPECT_TRUE(says(list, "met"));
  EXPECT_TRUE(says(list, "missed"));
  EXPECT_TRUE(says(list, "not run"));
  EXPECT_TRUE(says_part(list, m.circumstances.processor));
}

TEST(Bars, AreMetAtTheBoundAndNeverByWhatIsNotANumber) {
  Bar bar;
  bar.bound = 2;
  EXPECT_EQ(bar.met(), std::nullopt);
  bar.value = 2;
  EXPECT_EQ(bar.met(), true);
  bar.value = 2.1;
  EXPECT_EQ(bar.met(), false);
  bar.at_least = true;
  EXPECT_EQ(bar.met(), true);
  bar.value = std::nan("");
  EXPECT_EQ(bar.met(), false);
  bar.at_least = false;
  EXPECT_EQ(bar.met(), false);
}

}  // namespace
}  // namespace lantern::report
