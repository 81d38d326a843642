#include "report/sentences.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "report/claims.hpp"
#include "report/sample_rows.hpp"

namespace lantern::report {
namespace {

using samples::row;

ProblemRows problem(std::vector<Row> rows) {
  return {"oscillator", "oscillator", "plain", std::move(rows)};
}

Row peer(const std::string& name, double error, double seconds) {
  Row r = row(name, 0.01, error, seconds, 0);
  r.version = "1.2";
  return r;
}

Row failed(const std::string& name, Status status) {
  Row r = row(name, 0.01, 1, 1, 10);
  r.status = status;
  return r;
}

TEST(Sentence, NamesTheCheapestInSecondsAndWhoNeverGetsThere) {
  EXPECT_EQ(sentence(problem({row("velocity_verlet", 0.01, 1e-5, 0.0004, 1030),
                              row("velocity_verlet", 0.005, 4e-7, 0.0008, 2060),
                              row("runge_kutta_4", 0.05, 3e-8, 0.0011, 824),
                              row("explicit_euler", 0.005, 0.2, 0.0007, 2060)})),
            "The cheapest method under 1e-6 is velocity Verlet: 0.8 ms at h = 0.005 s, 2060 force "
            "evaluations; explicit Euler does not get there even at the finest step.");
}

TEST(Sentence, CountsWorkWhereNothingWasTimed) {
  EXPECT_EQ(sentence(problem({row("velocity_verlet", 0.005, 4e-7, 0, 2060),
                              row("runge_kutta_4", 0.05, 3e-8, 0, 824)})),
            "The cheapest method under 1e-6 is Runge–Kutta 4: at h = 0.05 s, 824 force "
            "evaluations.");
}

TEST(Sentence, TakesTheNextPowerOfTenThatSomebodyMeets) {
  EXPECT_EQ(sentence(problem({row("velocity_verlet", 0.005, 2e-4, 0.001, 2060),
                              row("explicit_euler", 0.005, 0.5, 0.001, 2060)})),
            "The cheapest method under 0.001 is velocity Verlet: 1 ms at h = 0.005 s, 2060 force "
            "evaluations; explicit Euler does not get there even at the finest step.");
  for (const double least : {1e-9, 1e-6})
    EXPECT_EQ(error_bound(problem({row("a", 1, least, 1, 1)})), 1e-6) << least;
  EXPECT_EQ(error_bound(problem({row("a", 1, 1.0000001e-6, 1, 1)})), 1e-5);
  EXPECT_EQ(error_bound(problem({row("a", 1, 0.5, 1, 1)})), 1.0);
  EXPECT_EQ(error_bound(problem({row("a", 1, 37, 1, 1)})), 100.0);
  EXPECT_FALSE(error_bound(problem({})));
}

TEST(Sentence, TellsOfTies) {
  EXPECT_EQ(
      sentence(
          problem({row("velocity_verlet", 0.1, 0, 0, 100), row("runge_kutta_4", 0.1, 0, 0, 100),
                   row("implicit_midpoint", 0.1, 1e-9, 0, 200)})),
      "The cheapest methods under 1e-6 are velocity Verlet and Runge–Kutta 4, equally: at h = "
      "0.1 s, 100 force evaluations.");
}

Row timed(const std::string& name, double error, double seconds, double spread) {
  Row r = row(name, 0.01, error, seconds, 100);
  r.timing.lower_quartile = seconds - 0.5 * spread;
  r.timing.upper_quartile = seconds + 0.5 * spread;
  r.timing.least = seconds - spread;
  return r;
}

Row timed_peer(const std::string& name, double error, double seconds, double spread) {
  Row r = timed(name, error, seconds, spread);
  r.version = "1.2";
  r.counted = {};
  return r;
}

TEST(Sentence, MethodsWithinTheirSpreadAreEquals) {
  const std::vector<Row> rows = {timed("velocity_verlet", 1e-7, 2.03e-3, 1e-4),
                                 timed("runge_kutta_4", 1e-8, 2e-3, 1e-5),
                                 timed("implicit_midpoint", 1e-9, 2.2e-3, 1e-5)};
  EXPECT_EQ(
      sentence(problem(rows)),
      "The cheapest methods under 1e-6 are Runge–Kutta 4 with 2 ms at h = 0.01 s and velocity "
      "Verlet with 2.03 ms at h = 0.01 s, which cost the same within the spread.")
      << "30 µs apart, where repeats are 100 µs apart, is no win";
  EXPECT_EQ(short_sentence(problem(rows)),
            "The cheapest methods under 1e-6 are Runge–Kutta 4 and velocity Verlet, equally: 2 ms "
            "at h = 0.01 s.");
  EXPECT_EQ(sentence(problem({timed("velocity_verlet", 1e-7, 2.03e-3, 2e-5),
                              timed("runge_kutta_4", 1e-8, 2e-3, 2e-5)})),
            "The cheapest method under 1e-6 is Runge–Kutta 4: 2 ms at h = 0.01 s, 100 force "
            "evaluations.")
      << "30 µs apart, where repeats are 20 µs apart, is one";
}

TEST(Sentence, AMethodThatIsNeverAsFastIsNoEqualHoweverWideItsSpread) {
  Row disturbed = timed("runge_kutta_4", 1e-8, 7e-4, 7e-4);
  disturbed.timing.least = 3e-4;
  EXPECT_TRUE(sentence(problem({timed("velocity_verlet", 1e-7, 6e-5, 1e-6), disturbed}))
                  .starts_with("The cheapest method under 1e-6 is velocity Verlet: 60 µs"));
}

TEST(Sentence, PeersWithinTheSpreadAreEqualsToo) {
  EXPECT_EQ(sentence(problem({timed("velocity_verlet", 1e-7, 2.03e-3, 1e-4),
                              timed("runge_kutta_4", 1e-7, 4e-3, 1e-4),
                              timed_peer("ODE", 1e-7, 2e-3, 1e-4)})),
            "The cheapest under 1e-6 are the peer ODE with 2 ms at h = 0.01 s and velocity Verlet "
            "with 2.03 ms at h = 0.01 s, which cost the same within the spread.");
  EXPECT_EQ(
      sentence(problem(
          {timed("velocity_verlet", 1e-7, 4e-3, 1e-4), timed("runge_kutta_4", 1e-7, 4.02e-3, 1e-4),
           timed_peer("ODE", 1e-7, 2e-3, 1e-4), timed_peer("DART", 1e-7, 2.01e-3, 1e-4)})),
      "The cheapest under 1e-6 are the peer ODE with 2 ms at h = 0.01 s and the peer DART "
      "with 2.01 ms at h = 0.01 s, which cost the same within the spread; of Lantern's "
      "methods, velocity Verlet with 4 ms at h = 0.01 s and Runge–Kutta 4 with 4.02 ms at h "
      "= 0.01 s, which cost the same within the spread.");
}

// Error and time of a run.
Row own_at(double error, double seconds) { return row("velocity_verlet", 0.1, error, seconds, 9); }
Row peer_at(const char* name, double error, double seconds) {
  return timed_peer(name, error, seconds, 0);
}

TEST(Front, SaysAtWhichErrorsAPeerIsTheQuickest) {
  EXPECT_EQ(front_words(problem({own_at(1e-6, 1), own_at(1e-3, 0.1), peer_at("ODE", 1e-3, 0.2)})),
            "At every error the quickest run is one of Lantern's.");
  const ProblemRows mixed =
      problem({own_at(1e-6, 1), own_at(1e-3, 0.1), peer_at("ODE", 1e-5, 0.5),
               peer_at("ODE", 1e-4, 0.2), peer_at("Box2D", 1e-2, 0.01), peer_at("ODE", 0.1, 0.02)});
  EXPECT_EQ(front_words(mixed),
            "A peer's run is the quickest at errors from 1e-5 to 0.001 (ODE) and 0.01 on (Box2D).");
  EXPECT_EQ(notes_on(mixed)[0], front_words(mixed));
  const std::vector<PeerRange> several =
      peer_ranges(problem({own_at(1, 1), peer_at("A", 1e-3, 0.3), peer_at("B", 1e-2, 0.2)}));
  ASSERT_EQ(several.size(), 1u);
  EXPECT_EQ(several[0].names, (std::vector<std::string>{"A", "B"}));
  EXPECT_EQ(front_words(problem({own_at(1, 1)})), "") << "there is nothing to compare";
  std::vector<Row> by_turns;
  for (int i = 1; i <= 4; ++i) {
    by_turns.push_back(own_at(std::pow(0.1, 2 * i), i));
    by_turns.push_back(peer_at("A", std::pow(0.1, 2 * i + 1), i + 0.5));
  }
  EXPECT_EQ(
      front_words(problem(by_turns)),
      "Peers' runs (A) and Lantern's are the quickest by turns at errors from 1e-9 to 0.01, a "
      "peer's in 4 stretches.");
}

TEST(Front, ACollapsedRunIsNeverOnIt) {
  Row fallen = peer_at("Box2D", 1e-9, 1e-3);
  fallen.status = Status::collapsed;
  EXPECT_EQ(front_words(problem({own_at(1e-3, 0.1), fallen, peer_at("ODE", 1e-2, 0.3)})),
            "At every error the quickest run is one of Lantern's.");
  EXPECT_EQ(sentence(problem({fallen})), "No run got to its end: 1 collapsed.");
}

TEST(Sentence, OfManyEqualsTheFirstAreNamed) {
  std::vector<Row> rows;
  for (const char* name : {"a", "b", "c", "d", "e", "f"})
    rows.push_back(timed(name, 1e-7, 1e-3, 1e-4));
  EXPECT_EQ(short_sentence(problem(rows)),
            "The cheapest methods under 1e-6 are a and 5 others, equally: 1 ms at h = 0.01 s.");
  EXPECT_NE(sentence(problem(rows)).find("and 3 others, which cost the same"), std::string::npos);
}

TEST(Sentence, OfOutcomesThatAreCountedSaysWhoIsExact) {
  EXPECT_EQ(sentence(problem({row("impulse", 0.1, 0, 0.002, 10), row("soft", 0.1, 0, 0.004, 10),
                              row("soft:16", 0.1, 2, 0.001, 10)})),
            "The cheapest method without an error is impulses: 2 ms at h = 0.1 s, 10 force "
            "evaluations; soft contacts (16 sub-steps) do not get there even at the finest step.")
      << "an outcome that is right is not 'under 1e-6'";
  EXPECT_EQ(sentence(problem({row("impulse", 0.1, 1, 0.002, 10), row("soft", 0.1, 7, 0.001, 10)})),
            "The cheapest method with 1 wrong at most is impulses: 2 ms at h = 0.1 s, 10 force "
            "evaluations; soft contacts do not get there even at the finest step.");
}

TEST(Sentence, SaysItIfAPeerIsCheaper) {
  EXPECT_EQ(
      sentence(problem({row("velocity_verlet", 0.005, 4e-7, 0.002, 2060), peer("ODE", 1e-7, 0.001),
                        row("runge_kutta_4", 0.1, 4e-7, 0.003, 2060)})),
      "The cheapest under 1e-6 is ODE 1.2, a peer: 1 ms at h = 0.01 s; of Lantern's methods, "
      "velocity Verlet: 2 ms at h = 0.005 s, 2060 force evaluations.");
}

TEST(Sentence, SaysItIfOnlyPeersGetThere) {
  EXPECT_EQ(
      sentence(problem({row("explicit_euler", 0.005, 0.1, 0.002, 2060), peer("ODE", 1e-7, 0.001)})),
      "No method of Lantern gets under 1e-6; the cheapest peer that does is ODE 1.2: 1 ms at "
      "h = 0.01 s.");
  EXPECT_EQ(sentence(problem({peer("ODE", 1e-7, 0.001), peer("DART", 1e-3, 0.002)})),
            "Only peers were run; the cheapest peer under 1e-6 is ODE 1.2: 1 ms at h = 0.01 s.");
}

TEST(Sentence, OfOneMethodIsNotOfTheCheapest) {
  EXPECT_EQ(sentence(problem({row("explicit_euler", 0.005, 0.004, 0.002, 2060)})),
            "Explicit Euler gets under 0.01 with 2 ms at h = 0.005 s, 2060 force evaluations.");
}

TEST(Sentence, SaysHowRunsFailedIfAllDid) {
  EXPECT_EQ(sentence(problem({failed("a", Status::diverged), failed("b", Status::diverged),
                              failed("c", Status::refused)})),
            "No run got to its end: 2 diverged and 1 refused.");
  EXPECT_EQ(sentence(problem({})), "No run has an error that could be compared.");
  Row bare = row("a", 1, 1, 1, 1);
  bare.norms.clear();
  EXPECT_EQ(sentence(problem({bare})), "No run has an error that could be compared.");
}

TEST(Sentence, CountsThoseThatNeverGetThereIfTheyAreMany) {
  std::vector<Row> rows = {row("velocity_verlet", 0.005, 4e-7, 0.002, 2060)};
  for (const char* name : {"a", "b", "c", "d"}) rows.push_back(row(name, 0.1, 1, 1, 1));
  EXPECT_TRUE(sentence(problem(rows))
                  .ends_with("; 4 of Lantern's methods do not get there within the runs made."))
      << "they were run at one step of 0.1 s, and another method at 0.005 s";
  for (const char* name : {"a", "b", "c", "d"}) rows.push_back(row(name, 0.005, 1, 1, 1));
  EXPECT_NE(sentence(problem(rows))
                .find("; 4 of Lantern's methods do not get there even at the finest step"),
            std::string::npos);
  EXPECT_EQ(short_sentence(problem(rows)),
            "The cheapest method under 1e-6 is velocity Verlet: 2 ms at h = 0.005 s.");
}

TEST(Sentence, ClaimsNothingOfAMethodWhoseFinestRunWasNotMade) {
  const Row good = row("velocity_verlet", 0.005, 4e-7, 0.002, 2060);
  Row coarse = row("explicit_euler", 0.01, 0.2, 0.002, 1030), fine = coarse;
  fine.step = 0.005;
  for (const auto& [status, words] :
       {std::pair(Status::left_out, "; explicit Euler does not get there within the runs made."),
        std::pair(Status::refused, "; explicit Euler does not get there within the runs made."),
        std::pair(Status::diverged,
                  "; explicit Euler does not get there even at the finest step.")}) {
    fine.status = status;
    EXPECT_TRUE(sentence(problem({good, coarse, fine})).ends_with(words))
        << to_string(status) << ": " << sentence(problem({good, coarse, fine}));
  }
  EXPECT_EQ(sentence(problem({coarse, peer("ODE", 1e-7, 0.001)})).substr(0, 37),
            "No method of Lantern gets under 1e-6;");
  fine.status = Status::left_out;
  EXPECT_TRUE(sentence(problem({coarse, fine, peer("ODE", 1e-7, 0.001)}))
                  .starts_with("No method of Lantern gets under 1e-6 within the runs made;"));
}

TEST(Sentence, MethodsWithEqualErrorsAreToldAsEqual) {
  std::vector<Row> rows;
  for (const char* name : {"velocity_verlet", "runge_kutta_4", "explicit_euler"})
    for (const double h : {0.1, 0.05, 0.025}) rows.push_back(row(name, h, h * h, 1e-4 / h, 100));
  rows[4].norms[0].value *= 1 + 1e-12;  // by rounding
  rows[7].norms[0].value *= 1.01;
  EXPECT_TRUE(
      sentence(problem(rows)).ends_with("; velocity Verlet and Runge–Kutta 4 give equal errors."))
      << sentence(problem(rows));
  EXPECT_EQ(equal_methods(problem(rows)),
            (std::vector<std::vector<std::string>>{{"velocity_verlet", "runge_kutta_4"}}));
  EXPECT_TRUE(equal_methods(problem({rows[0], rows[3]})).empty()) << "one run says little";
  rows[5].status = Status::diverged;
  EXPECT_TRUE(equal_methods(problem(rows)).empty());
}

TEST(Sentence, NoErrorBelowThatOfTheReferenceIsClaimed) {
  Row fine = row("velocity_verlet", 0.005, 1e-9, 0.002, 2060);
  fine.reference_error = 3e-4;
  EXPECT_EQ(fine.error(), 3e-4);
  EXPECT_TRUE(sentence(problem({fine})).starts_with("Velocity Verlet gets under 0.001"));
  EXPECT_NE(notes_on(problem({fine}))[0].find("is itself off by about 3e-4"), std::string::npos);
}

TEST(Notes, DefineTheNormAndNameWhoIsMeasuredOtherwise) {
  Row own = row("dormand_prince", 0.1, 1e-9, 1e-3, 100);
  own.norms[0] = {"depth", 0.1, "units", "deepest overlap"};
  const std::vector<std::string> notes = notes_on(problem({own}));
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0], "“depth” (units): deepest overlap.");
  EXPECT_NE(notes[1].find("without the world's step"), std::string::npos);
  EXPECT_TRUE(notes_on(problem({})).empty());
}

TEST(Sentence, AnErrorThatIsNotFiniteMeetsNothing) {
  EXPECT_EQ(error_bound(problem({row("a", 1, std::nan(""), 1, 1)})), std::nullopt);
  EXPECT_EQ(error_bound(problem({row("a", 1, HUGE_VAL, 1, 1), row("b", 1, 1e-8, 1, 1)})), 1e-6);
}

TEST(Figures, AreShort) {
  EXPECT_EQ(seconds_text(0.0008), "0.8 ms") << "as the reader of a bench thinks";
  EXPECT_EQ(seconds_text(12.34), "12.3 s");
  EXPECT_EQ(seconds_text(41.2e-6), "41.2 µs");
  EXPECT_EQ(seconds_text(3e-9), "3 ns");
  EXPECT_EQ(figure(1e-6), "1e-6");
  EXPECT_EQ(figure(3.217e-9), "3.22e-9");
  EXPECT_EQ(figure(0.0123), "0.0123");
  EXPECT_EQ(figure(2060), "2060");
  EXPECT_EQ(figure(0), "0");
  EXPECT_EQ(figure(std::nan("")), "?");
}

}  // namespace
}  // namespace lantern::report
