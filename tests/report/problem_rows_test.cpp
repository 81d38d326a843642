#include "report/problem_rows.hpp"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "draw/plot.hpp"
#include "report/sample_rows.hpp"

namespace lantern::report {
namespace {

std::vector<Row> power(double order, double factor, double floor, int halvings, double h = 0.1) {
  std::vector<Row> rows;
  for (int i = 0; i < halvings; ++i, h /= 2)
    rows.push_back(samples::row("m", h, std::max(floor, factor * std::pow(h, order)), 1,
                                static_cast<std::uint64_t>(10 / h)));
  return rows;
}

TEST(Order, IsFoundAboveTheFloor) {
  for (const double order : {1.0, 2.0, 4.0}) {
    const auto found = observed_order(power(order, 1, 1e-13, 9));
    ASSERT_TRUE(found) << order;
    EXPECT_NEAR(found->exponent, order, 0.02) << "rows at the floor were fitted too";
  }
}

TEST(Order, OfCoarseStepsThatDoNotShrinkYetIsNotMixedIn) {
  std::vector<Row> rows = power(2, 1, 0, 9);
  rows[0].norms[0].value = 0.4;
  rows[1].norms[0].value = 0.3;
  const auto found = observed_order(rows);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->exponent, 2, 0.02);
}

TEST(Order, IsToldWithHowFarItsSlopesLieFromIt) {
  EXPECT_LT(observed_order(power(2, 1, 0, 6))->spread, 1e-9);
  std::vector<Row> rows = power(2, 1, 0, 6);
  rows[3].norms[0].value *= 1.1;  // one slope is less by log2 1.1 = 0.14, the next one more
  EXPECT_NEAR(observed_order(rows)->spread, 0.14, 0.03);
}

TEST(Floor, BeginsWhereTheErrorNoLongerFalls) {
  const std::vector<Row> rows = power(2, 1, 1e-4, 9);
  const auto floor = observed_floor(rows);
  ASSERT_GE(floor.size(), 2u);
  for (const Row& row : floor) EXPECT_EQ(row.error(), 1e-4);
  EXPECT_TRUE(observed_floor(power(2, 1, 0, 9)).empty()) << "it falls to its end";
  EXPECT_TRUE(observed_floor(power(0, 1, 0, 9)).empty()) << "it never fell";
}

// Noise must not hide it, nor runs that were left out at its end.
TEST(Floor, OfNoiseIsToldByItsLargestError) {
  std::vector<Row> rows = power(8, 1e3, 0, 8);
  const double noise[] = {1.7e-14, 1.4e-13, 8.1e-14, 5.1e-13, 4.7e-13, 2.4e-13};
  for (std::size_t i = 0; i < 6; ++i) rows[i + 1].norms[0].value = noise[i];
  rows[7].status = Status::left_out;
  EXPECT_EQ(observed_floor(rows).size(), 6u);
  EXPECT_EQ(largest_on_floor(rows), 5.1e-13);
  EXPECT_EQ(notes_on({"p", "p", "plain", rows})[0],
            "Floors, where smaller steps bring no smaller error: at most m 5.1e-13.");
}

TEST(Order, ThatIsOnItsWayIsToldByItsEnds) {
  std::vector<Row> rows = power(4, 1, 0, 6);
  for (Row& row : rows) row.norms[0].value *= 1 + 8 * row.step;
  const auto found = observed_order(rows);
  ASSERT_TRUE(found && found->trend);
  EXPECT_EQ(found->words(), "4.36→4.03");
}

Row timed_row(const std::string& method, double error, double seconds, double half = 0.01) {
  Row row = samples::row(method, 0.1, error, seconds, 1);
  row.processor.low = (1 - half) * seconds;
  row.processor.high = (1 + half) * seconds;
  return row;
}
std::string quickest_of(std::vector<Row> rows) {
  return who_is_quickest({"p", "p", "plain", std::move(rows)});
}

TEST(WhoIsQuickest, IsToldOfAllErrorsThatTwoReach) {
  EXPECT_EQ(
      quickest_of({timed_row("velocity_verlet", 0.9e-2, 1), timed_row("velocity_verlet", 0.9e-4, 9),
                   timed_row("runge_kutta_4", 0.9e-2, 3), timed_row("runge_kutta_4", 0.9e-4, 4.5)}),
      "By the cheapest run that is so good, of those at a step of 0.1 s (larger ones, which may be "
      "cheaper, were not tried): at errors of 0.1 to 0.01 "
      "velocity Verlet costs 0.33 of what "
      "Runge–Kutta 4 costs; at errors of 0.001 to 1e-4 Runge–Kutta 4 costs 0.5 of what velocity "
      "Verlet costs.");
}

// The share grows with the accuracy: both ends of it are told.
TEST(WhoIsQuickest, TellsASharesWholeRange) {
  EXPECT_EQ(
      quickest_of({timed_row("velocity_verlet", 0.9e-1, 2), timed_row("velocity_verlet", 0.9e-2, 8),
                   timed_row("runge_kutta_4", 0.9e-2, 1)}),
      "By the cheapest run that is so good, of those at a step of 0.1 s (larger ones, which may be "
      "cheaper, were not tried): at errors of 0.1 to 0.01 "
      "Runge–Kutta 4 costs 0.5 to 0.12 of "
      "what velocity Verlet costs.");
}

TEST(WhoIsQuickest, IsATieWhereAnotherMeasurementMightRankOtherwise) {
  const Row a = timed_row("velocity_verlet", 0.05, 1);
  for (Row b : {timed_row("exact", 0.05, 1.5, 0.4), timed_row("exact", 0.05, 1.05, 0.001)})
    EXPECT_NE(quickest_of({a, b}).find(" tie."), std::string::npos) << quickest_of({a, b});
  Row few = timed_row("exact", 0.05, 3);
  few.processor.repeats = 5;
  EXPECT_NE(quickest_of({a, few}).find(" tie."), std::string::npos) << "five repeats rank nobody";
  few.processor.repeats = 6;
  EXPECT_EQ(quickest_of({a, few}).find(" tie."), std::string::npos);
}

// A tie does not carry over: b ties with a and with c, whom a beats.
TEST(WhoIsQuickest, IsAheadOnlyIfEachOfATieIs) {
  const Row a = timed_row("velocity_verlet", 0.05, 1, 0.06),
            b = timed_row("exact", 0.05, 1.1, 0.06),
            c = timed_row("runge_kutta_4", 0.05, 1.2, 0.06),
            d = timed_row("runge_kutta_4", 0.05, 9);
  EXPECT_EQ(quickest_of({a, b, c}).find("ahead of the others"), std::string::npos);
  EXPECT_NE(quickest_of({a, b, d}).find("ahead of the others"), std::string::npos);
}

TEST(WhoIsQuickest, DoesNotRankBelowAFloor) {
  std::vector<Row> rows;
  const double errors[] = {1e-3, 1.7e-14, 5e-13, 2e-13};
  for (int i = 0; i < 4; ++i)
    for (const char* method : {"kahan_li_8", "dormand_prince"}) {
      rows.push_back(timed_row(method, errors[i], (1 << i) * (method[0] == 'k' ? 1 : 3)));
      rows.back().step = 0.1 / (1 << i);
    }
  EXPECT_NE(quickest_of(rows).find("1e-12 Kahan"), std::string::npos) << quickest_of(rows);
}

TEST(WhoIsQuickest, HoldsStepsOfAWorldBesideEachOtherAlone) {
  const std::vector<Row> rows = {timed_row("velocity_verlet", 0.05, 1), timed_row("exact", 0.05, 2),
                                 timed_row("dormand_prince:adaptive", 1e-9, 1e-3)};
  EXPECT_EQ(quickest_of(rows).find("Dormand"), std::string::npos) << quickest_of(rows);
  EXPECT_EQ(pareto_front(rows, seconds_of), (std::vector<std::size_t>{0}));
}

TEST(WhoIsQuickest, IsNotToldOfOneMethodOrWithoutTimes) {
  EXPECT_NE(quickest_of({timed_row("exact", 0.05, 1)}).find("cannot be told"), std::string::npos);
  EXPECT_NE(
      quickest_of({timed_row("exact", 0.05, 0), timed_row("a", 0.05, 0)}).find("cannot be told"),
      std::string::npos);
}

TEST(Order, OfAnErrorThatGrowsAsStepsShrinkIsNone) {
  EXPECT_FALSE(observed_order(power(-1, 1e-4, 0, 6))) << "no scheme has order -1";
}

TEST(WholeErrors, AreThoseOfOutcomesThatAreCounted) {
  const auto whole = [](std::vector<double> errors) {
    ProblemRows problem;
    for (const double error : errors) problem.rows.push_back(samples::row("m", 0.1, error, 1, 1));
    return has_whole_errors(problem);
  };
  EXPECT_TRUE(whole({0, 0, 0}));
  EXPECT_TRUE(whole({0, 1, 17}));
  EXPECT_FALSE(whole({0, 1, 1e-12})) << "almost right is another thing than right";
  EXPECT_FALSE(whole({})) << "no error says nothing";
  EXPECT_TRUE(whole({0, std::nan("")}));
}

TEST(Order, IsNotClaimedFromTooLittle) {
  EXPECT_FALSE(observed_order(power(2, 1, 0, 2))) << "two points fit any order";
  EXPECT_FALSE(observed_order(power(2, 1e-14, 0, 8))) << "only rounding";
  EXPECT_FALSE(observed_order(power(1, 1e6, 0, 8))) << "errors beyond all sense";
  std::vector<Row> adaptive = power(1, 1, 0, 8);
  for (Row& row : adaptive) row.method = "dormand_prince:adaptive";
  EXPECT_FALSE(observed_order(adaptive)) << "its steps are tolerances";
  std::vector<Row> failed = power(1, 1, 0, 8);
  for (Row& row : failed) row.status = Status::diverged;
  EXPECT_FALSE(observed_order(failed));
}

TEST(Looks, AreTheSameForAMethodInWhateverOrderRowsCome) {
  std::vector<Row> rows = samples::measurement().rows;
  const auto looks = looks_of(rows);
  std::vector<Row> turned(rows.rbegin(), rows.rend());
  const auto others = looks_of(turned);
  for (const char* name : {"velocity_verlet", "runge_kutta_4", "explicit_euler", "splitting_4"})
    EXPECT_EQ(looks.at(name), others.at(name)) << name;
  std::set<int> unlike;
  for (const auto& [name, look] : looks) unlike.insert(look);
  EXPECT_EQ(unlike.size(), looks.size()) << "two methods share a look";
}

TEST(Looks, OfPeersAreCrossesAndStars) {
  const std::vector<Row> rows = samples::measurement().rows;
  const auto looks = looks_of(rows);
  for (const Row& row : rows)
    EXPECT_EQ(looks.at(row.method) % kPlotMarks >= kFirstPeerLook, row.is_peer()) << row.method;
}

TEST(WorkCount, IsOfConstraintRowsWhereThereAreSome) {
  for (const ProblemRows& problem : by_problem(samples::measurement().rows))
    EXPECT_EQ(work_count(problem).name,
              problem.family == "stack" ? "constraint rows" : "force evaluations")
        << problem.problem;
}

TEST(ByMethod, SortsTheLargestStepFirst) {
  for (const ProblemRows& problem : by_problem(samples::measurement().rows)) {
    std::size_t rows = 0;
    for (const MethodRows& c : by_method(problem)) {
      rows += c.rows.size();
      for (std::size_t i = 1; i < c.rows.size(); ++i) EXPECT_GE(c.rows[i - 1].step, c.rows[i].step);
    }
    EXPECT_EQ(rows, problem.rows.size()) << "rows were lost";
  }
}

TEST(MethodWords, ReadAsWords) {
  EXPECT_EQ(method_words("explicit_euler"), "explicit Euler");
  EXPECT_EQ(method_words("soft:16"), "soft contacts (16 sub-steps)");
  EXPECT_EQ(method_words("soft:1"), "soft contacts (1 sub-step)");
  EXPECT_EQ(method_words("impulse:100"), "impulses (100 sweeps)");
  EXPECT_EQ(method_words("impulse"), "impulses");
  EXPECT_EQ(method_words("Bullet"), "Bullet");
}

ProblemRows problem_of(std::vector<Row> rows) { return {"p", "p", "plain", std::move(rows)}; }

TEST(Notes, DefineTheNormAndNameWhoIsMeasuredOtherwise) {
  Row own = samples::row("dormand_prince:adaptive", 0.1, 1e-9, 1e-3, 100);
  own.norms[0] = {"depth", 0.1, "units", "deepest overlap"};
  const std::vector<std::string> notes = notes_on(problem_of({own}));
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0], "“depth” (units): deepest overlap.");
  EXPECT_NE(notes[1].find("without the world's step"), std::string::npos);
  EXPECT_TRUE(notes_on(problem_of({})).empty());
}

TEST(Notes, TellHowGoodTheReferenceIs) {
  Row fine = samples::row("velocity_verlet", 0.005, 1e-9, 0.002, 2060);
  fine.reference_error = 3e-4;
  EXPECT_EQ(fine.error(), 3e-4);
  EXPECT_NE(notes_on(problem_of({fine})).back().find("is itself off by about 3e-4"),
            std::string::npos);
}

TEST(Notes, TellWhatAnEvaluationCostsWhatWasHeldAgainstAndWhatWasLeftOut) {
  Row a = samples::row("velocity_verlet", 0.1, 1e-3, 2e-3, 1000);
  a.reference = "closed form; period 3 s; looked at 21 times in 9 s";
  Row b = samples::row("runge_kutta_4", 0.1, 1e-4, 1e-3, 4000), c = b;
  c.status = Status::left_out;
  c.processor = {};
  c.counted = {};
  const std::vector<std::string> notes = notes_on(problem_of({a, b, c}));
  ASSERT_EQ(notes.size(), 3u);
  EXPECT_EQ(notes[0], "Reference: closed form; period 3 s; looked at 21 times in 9 s.");
  EXPECT_EQ(notes[1],
            "For each evaluation of the forces the longest run of a method takes 0.25 µs "
            "(Runge–Kutta 4) to 2 µs "
            "(velocity Verlet): each bears its share of the step.");
  EXPECT_EQ(notes[2], "1 of 3 runs were left out as too long.");
}

TEST(EqualMethods, AgreeInEveryRunThatTheyShare) {
  std::vector<Row> rows;
  for (const char* name : {"velocity_verlet", "runge_kutta_4", "explicit_euler"})
    for (const double h : {0.1, 0.05, 0.025})
      rows.push_back(samples::row(name, h, h * h, 1e-4 / h, 100));
  rows[4].norms[0].value *= 1 + 1e-12;  // by rounding
  rows[7].norms[0].value *= 1.01;
  EXPECT_EQ(equal_methods(problem_of(rows)),
            (std::vector<std::vector<std::string>>{{"velocity_verlet", "runge_kutta_4"}}));
  EXPECT_TRUE(equal_methods(problem_of({rows[0], rows[3]})).empty()) << "one run says little";
  rows[5].status = Status::diverged;
  EXPECT_TRUE(equal_methods(problem_of(rows)).empty());
}

}  // namespace
}  // namespace lantern::report
