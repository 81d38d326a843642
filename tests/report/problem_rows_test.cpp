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
  ASSERT_TRUE(floor);
  EXPECT_EQ(rows[floor->first - 1].error() > 1e-4 && rows[floor->first].error() == 1e-4, true);
  EXPECT_EQ(floor->last, 8u);
  EXPECT_EQ(floor->largest, 1e-4);
  EXPECT_FALSE(observed_floor(power(2, 1, 0, 9))) << "it falls to its end";
  EXPECT_FALSE(observed_floor(power(0, 1, 0, 9))) << "it never fell";
}

TEST(Floor, IsNotOneSlowStep) {
  std::vector<Row> rows = power(4, 1, 0, 6);
  rows[5].norms[0].value = rows[4].norms[0].value / 2;
  EXPECT_FALSE(observed_floor(rows)) << "it may fall on";
  rows[5].norms[0].value = rows[4].norms[0].value;
  EXPECT_TRUE(observed_floor(rows));
}

// Noise must not hide it, nor runs that were left out at its end.
TEST(Floor, OfNoiseIsToldByItsLargestError) {
  std::vector<Row> rows = power(8, 1e3, 0, 11);
  const double noise[] = {1.7e-14, 1.4e-13, 8.1e-14, 5.1e-13, 4.7e-13, 2.4e-13};
  for (std::size_t i = 0; i < 6; ++i) rows[i + 4].norms[0].value = noise[i];
  rows[10].status = Status::left_out;
  const auto floor = observed_floor(rows);
  ASSERT_TRUE(floor);
  EXPECT_EQ(floor->first, 4u);
  EXPECT_EQ(floor->last, 9u);
  EXPECT_EQ(floor->largest, 5.1e-13);
  EXPECT_EQ(
      notes_on({"p", "p", "plain", rows})[0],
      "Dashed: rounding, 2⁻⁵² √steps as a random walk; and the largest error of the runs from "
      "0.00625 s on: 5.1e-13 (m).");
}

TEST(Floor, MayEndOnAnErrorThatIsSmallByChance) {
  std::vector<Row> rows = power(5, 1, 0, 8);
  const double noise[] = {2.9e-13, 4.8e-13, 8.1e-14};
  for (std::size_t i = 0; i < 3; ++i) rows[i + 5].norms[0].value = noise[i];
  const auto floor = observed_floor(rows);
  ASSERT_TRUE(floor);
  EXPECT_EQ(floor->first, 5u);
  EXPECT_EQ(floor->largest, 4.8e-13);
}

TEST(Order, ThatIsOnItsWayIsToldByItsEnds) {
  std::vector<Row> rows = power(4, 1, 0, 6);
  for (Row& row : rows) row.norms[0].value *= 1 + 8 * row.step;
  const auto found = observed_order(rows);
  ASSERT_TRUE(found && found->trend);
  EXPECT_EQ(found->words(), "4.36→4.03");
}

// Runs of a method at steps that halve, each twice as long as the one before.
std::vector<Row> runs_of(const std::string& method, const std::vector<double>& errors,
                         double seconds, double half = 0.01) {
  std::vector<Row> rows;
  for (const double error : errors) {
    Row& row = rows.emplace_back(samples::row(method, 0.1 / seconds, error, seconds, 1));
    row.processor.low = (1 - half) * seconds;
    row.processor.high = (1 + half) * seconds;
    seconds *= 2;
  }
  return rows;
}
std::string quickest_of(const std::vector<std::vector<Row>>& methods) {
  ProblemRows problem{"p", "p", "plain", {}};
  for (const std::vector<Row>& rows : methods)
    problem.rows.insert(problem.rows.end(), rows.begin(), rows.end());
  return who_is_quickest(problem);
}
bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// The share grows with the accuracy: both ends of it are told.
TEST(WhoIsQuickest, IsReadBetweenRuns) {
  EXPECT_EQ(quickest_of({runs_of("velocity_verlet", {1, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5}, 1),
                         runs_of("runge_kutta_4", {1, 1e-2, 1e-4}, 2)}),
            "At given steps, read between neighbouring runs: at an error of 0.1 velocity Verlet "
            "costs 0.71 of what Runge–Kutta 4 costs; at an error of 0.01 Runge–Kutta 4 and "
            "velocity Verlet tie; at errors of 0.001 to 1e-4 Runge–Kutta 4 costs 0.5 to 0.71 of "
            "what velocity Verlet costs.");
}

TEST(WhoIsQuickest, IsNotToldOfWhomLargerStepsMightMakeQuicker) {
  const auto quick = runs_of("exact", {1, 0.09}, 1), open = runs_of("lecture", {0.09, 0.01}, 10);
  EXPECT_TRUE(says(quickest_of({quick, open}), "cannot be told"));
  EXPECT_TRUE(says(quickest_of({open, runs_of("exact", {1, 0.09}, 40)}),
                   "at an error of 0.1 the lecture's solver costs at most 0.1"))
      << quickest_of({open, runs_of("exact", {1, 0.09}, 40)});
}

// Between the step that fails and the one that does not there may be one that takes half as long.
TEST(WhoIsQuickest, KnowsHowMuchLessASmallerStepMayCost) {
  std::vector<Row> failing = runs_of("explicit_euler", {1, 0.09}, 1);
  failing[0].status = Status::diverged;
  EXPECT_TRUE(says(quickest_of({failing, runs_of("exact", {0.3, 0.1}, 0.6)}), "tie"));
  EXPECT_TRUE(says(quickest_of({failing, runs_of("exact", {0.3, 0.1}, 0.4)}),
                   "exact turning costs at most 0.8 of what explicit Euler costs"));
}

// Runs that were left out vouch for nothing, and say nothing against a larger step.
TEST(WhoIsQuickest, IsElseWhoIsOffLeastAtTheLargestStep) {
  auto exact = runs_of("exact", {1e-15, 0, 2e-15}, 1), one = runs_of("impulse", {0, 0, 0}, 1);
  exact[2].status = one[1].status = Status::left_out;
  one[0].processor.median = 3;
  EXPECT_EQ(
      quickest_of({runs_of("lecture", {0.3, 0.4, 0.2}, 1), exact, one}),
      "At steps of up to 0.1 s that were run, exact turning in 1 s at the largest step and "
      "impulses in 3 s are off by at most 1e-15, the next, the lecture's solver, by up to 0.4.");
}

TEST(WhoIsQuickest, TakesASmallerStepThatIsQuicker) {
  auto costly = runs_of("exact", {1, 1e-9, 1e-10, 1e-11}, 1);
  costly[1].processor = costly[3].processor;
  EXPECT_TRUE(says(quickest_of({costly, runs_of("splitting_2", {1, 1e-9, 1e-10}, 8)}),
                   "exact turning costs 0.12 to 0.46 of what"));
}

TEST(WhoIsQuickest, IsTheCheapestRightOutcomeWhereErrorsAreCounted) {
  EXPECT_EQ(quickest_of({runs_of("exact", {3, 0, 0}, 1), runs_of("lecture", {9, 7, 0}, 1)}),
            "At given steps, by the cheapest run: for a right outcome exact turning and the "
            "lecture's solver tie.");
  EXPECT_EQ(quickest_of({runs_of("exact", {3, 0, 0}, 1), runs_of("lecture", {9, 9, 7, 0}, 1)}),
            "At given steps, by the cheapest run: for a right outcome exact turning costs at most "
            "0.5 of what the lecture's solver costs.");
}

TEST(WhoIsQuickest, IsATieWhereAnotherMeasurementMightRankOtherwise) {
  const auto a = runs_of("velocity_verlet", {1, 0.1}, 1);
  for (const auto& b : {runs_of("exact", {1, 0.1}, 1.5, 0.4), runs_of("exact", {1, 0.1}, 1.05, 0)})
    EXPECT_TRUE(says(quickest_of({a, b}), " tie.")) << quickest_of({a, b});
  auto few = runs_of("exact", {1, 0.1}, 3);
  few[1].processor.repeats = 5;
  EXPECT_TRUE(says(quickest_of({a, few}), " tie.")) << "five repeats rank nobody";
  few[1].processor.repeats = 6;
  EXPECT_FALSE(says(quickest_of({a, few}), " tie."));
}

// A tie does not carry over: b ties with a and with c, whom a beats.
TEST(WhoIsQuickest, IsAheadOnlyIfEachOfATieIs) {
  const auto a = runs_of("velocity_verlet", {1, 0.1}, 1, 0.06),
             b = runs_of("exact", {1, 0.1}, 1.1, 0.06),
             c = runs_of("runge_kutta_4", {1, 0.1}, 1.2, 0.06),
             d = runs_of("runge_kutta_4", {1, 0.1}, 9);
  EXPECT_FALSE(says(quickest_of({a, b, c}), "ahead of the others"));
  EXPECT_TRUE(says(quickest_of({a, b, d}), "ahead of the others"));
}

TEST(WhoIsQuickest, NamesAllOfTheNextThatTie) {
  EXPECT_TRUE(says(quickest_of({runs_of("exact", {1, 0.1}, 1), runs_of("lecture", {1, 0.1}, 4),
                                runs_of("impulse", {1, 0.1}, 4.1), runs_of("soft", {1, 0.1}, 9)}),
                   "exact turning costs 0.25 of what impulses or the lecture's solver costs."));
}

// The ends of a range are not the least and the largest share in it.
TEST(WhoIsQuickest, TellsTheLeastAndTheLargestShare) {
  EXPECT_TRUE(says(quickest_of({runs_of("exact", {1, 1e-1, 1e-2, 1e-3}, 1),
                                runs_of("lecture", {1, 1e-1, 0.99e-1, 1e-2, 1e-3}, 1.25)}),
                   "costs 0.4 to 0.8 of what"))
      << quickest_of({runs_of("exact", {1, 1e-1, 1e-2, 1e-3}, 1),
                      runs_of("lecture", {1, 1e-1, 0.99e-1, 1e-2, 1e-3}, 1.25)});
}

// An error may be small by chance, on a floor or where it changes its sign.
TEST(WhoIsQuickest, TrustsNoErrorThatSmallerStepsDoNotBearOut) {
  EXPECT_TRUE(says(quickest_of({runs_of("kahan_li_8", {1e-1, 1e-3, 1.7e-14, 5e-13, 2e-13}, 1),
                                runs_of("dormand_prince", {1e-1, 1e-3, 1.7e-14, 5e-13, 2e-13}, 3)}),
                   "1e-12 Kahan"));
  const auto lucky = runs_of("exact", {1, 1e-9, 0.2, 0.02}, 1);
  EXPECT_TRUE(says(quickest_of({lucky, runs_of("velocity_verlet", {1, 0.1}, 1)}),
                   "at an error of 0.1 velocity Verlet costs"));
}

TEST(WhoIsQuickest, HoldsStepsOfAWorldBesideEachOtherAlone) {
  const auto a = runs_of("velocity_verlet", {1, 0.05}, 1), b = runs_of("exact", {1, 0.05}, 2),
             adaptive = runs_of("dormand_prince:adaptive", {1, 1e-9}, 1e-3);
  EXPECT_FALSE(says(quickest_of({a, b, adaptive}), "Dormand"));
  EXPECT_TRUE(says(quickest_of({a, adaptive}), "cannot be told"));
}

TEST(WhoIsQuickest, IsNotToldOfOneMethodOrWithoutTimes) {
  EXPECT_TRUE(says(quickest_of({runs_of("exact", {1, 0.05}, 1)}), "cannot be told"));
  auto untimed = runs_of("exact", {1, 0.05}, 1);
  for (Row& row : untimed) row.processor = {};
  EXPECT_TRUE(says(quickest_of({untimed, runs_of("a", {1, 0.05}, 1)}), "cannot be told"));
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
  ASSERT_EQ(notes.size(), 3u);
  EXPECT_EQ(notes[0], "“depth” (units): deepest overlap.");
  EXPECT_NE(notes[2].find("pay for no world's step"), std::string::npos);
  EXPECT_TRUE(notes_on(problem_of({})).empty());
}

TEST(Notes, TellHowGoodTheReferenceIs) {
  Row fine = samples::row("velocity_verlet", 0.005, 1e-9, 0.002, 2060);
  fine.reference_error = 3e-4;
  EXPECT_EQ(fine.error(), 3e-4);
  EXPECT_NE(notes_on(problem_of({fine}))[0].find("is itself off by about 3e-4"), std::string::npos);
}

TEST(Notes, TellWhoIsOneMethodAndWhoseStepsAreTakenInParts) {
  std::vector<Row> rows;
  for (const char* name : {"velocity_verlet", "semi_implicit_euler"})
    for (const double h : {0.1, 0.05})
      rows.push_back(samples::row(name, h, h * h, 1e-3, h == 0.1 ? 80 : 40)),
          rows.back().counted.steps = 20;
  const std::vector<std::string> notes = notes_on(problem_of(rows));
  EXPECT_TRUE(says(notes[0], "again: 2 to 4 (velocity Verlet), 2 to 4 (semi-implicit Euler)."));
  EXPECT_EQ(
      notes.back(),
      "velocity Verlet and semi-implicit Euler are run as one method here, of which the order "
      "is, whatever its name: they are off by the same in every run.");
}

TEST(Notes, TellWhatAnEvaluationCostsWhatWasHeldAgainstAndWhatWasLeftOut) {
  Row a = samples::row("velocity_verlet", 0.1, 1e-3, 2e-3, 1000);
  a.reference = "closed form; period 3 s; looked at 21 times in 9 s";
  Row b = samples::row("runge_kutta_4", 0.1, 1e-4, 1e-3, 4000), c = b;
  c.status = Status::left_out;
  c.processor = {};
  c.counted = {};
  a.counted.steps = 500;
  b.counted.steps = 1000;
  const std::vector<std::string> notes = notes_on(problem_of({a, b, c}));
  ASSERT_EQ(notes.size(), 4u);
  EXPECT_EQ(notes[0], "Reference: closed form; period 3 s; looked at 21 times in 9 s.");
  EXPECT_EQ(notes[1],
            "In runs that are ok forces are evaluated so often in a step, more where it is taken "
            "in parts or solved again: 2 (velocity Verlet), 4 (Runge–Kutta 4).");
  EXPECT_EQ(notes[2],
            "An evaluation at given steps, with its share of the step, takes 0.25 µs (Runge–Kutta "
            "4) to 2 µs "
            "(velocity Verlet) in the longest runs.");
  EXPECT_EQ(notes[3], "1 of 3 runs was left out as too long.");
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
