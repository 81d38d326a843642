#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "report/problem_rows.hpp"
#include "report/sample_rows.hpp"

namespace lantern::report {
namespace {

// From the definition: no other is as good in both and better in one; of equal points the first.
std::vector<std::size_t> by_definition(const std::vector<Vec<2>>& points) {
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec<2>& p = points[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
    bool beaten = false;
    for (std::size_t j = 0; j < points.size(); ++j) {
      const Vec<2>& q = points[j];
      if (!std::isfinite(q.x) || !std::isfinite(q.y)) continue;
      if (q.x <= p.x && q.y <= p.y && (q != p || j < i)) beaten = true;
    }
    if (!beaten) front.push_back(i);
  }
  std::sort(front.begin(), front.end(),
            [&](std::size_t a, std::size_t b) { return points[a].x < points[b].x; });
  return front;
}

TEST(Pareto, IsTheDefinitionOnRandomPoints) {
  Random random(7);
  for (int i = 0; i < 3000; ++i) {
    std::vector<Vec<2>> points;
    const bool few_values = random.unit() < 0.5;  // so that points meet
    for (std::int64_t n = random.whole(0, 40); n > 0; --n) {
      Vec<2> p{random.unit(), random.unit()};
      if (few_values) p = {std::floor(p.x * 6), std::floor(p.y * 6)};
      if (random.unit() < 0.05) p.y = std::nan("");
      if (random.unit() < 0.05) p.x = HUGE_VAL;
      points.push_back(p);
    }
    EXPECT_EQ(pareto_front(points), by_definition(points)) << "round " << i;
  }
}

TEST(Pareto, RowsThatFailedOrWereNotTimedAreNotOnIt) {
  ProblemRows problem{"p",
                      "p",
                      "plain",
                      {samples::row("a", 0.1, 1e-2, 1, 10), samples::row("b", 0.1, 1e-9, 2, 10),
                       samples::row("c", 0.1, 1e-12, 0, 10), samples::row("d", 0.1, 1e-1, 3, 10),
                       samples::row("dormand_prince:adaptive", 0.1, 1e-15, 0.1, 10)}};
  EXPECT_EQ(pareto_front(problem, seconds_of), (std::vector<Vec<2>>{{1, 1e-2}, {2, 1e-9}}))
      << "c was not timed, d is beaten, the last does no step of a world";
  for (const Status failed : {Status::diverged, Status::collapsed}) {
    problem.rows[1].status = failed;
    EXPECT_EQ(pareto_front(problem, seconds_of), (std::vector<Vec<2>>{{1, 1e-2}}))
        << to_string(failed);
  }
}

TEST(Pareto, OfARunThatIsGoodByChanceIsWhatSmallerStepsBearOut) {
  const ProblemRows problem{
      "p",
      "p",
      "plain",
      {samples::row("a", 0.1, 1e-9, 1, 10), samples::row("a", 0.05, 1e-2, 2, 20),
       samples::row("b", 0.1, 1e-3, 4, 10)}};
  EXPECT_EQ(pareto_front(problem, seconds_of), (std::vector<Vec<2>>{{1, 1e-2}, {4, 1e-3}}));
}

}  // namespace
}  // namespace lantern::report
