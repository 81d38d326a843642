#include "report/sentences.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "report/sample_rows.hpp"

namespace lantern {
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
            "evaluations; explicit Euler never gets there.");
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
            "evaluations; explicit Euler never gets there.");
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
                   row("implicit_midpoint", 0.1, 0, 0, 200)})),
      "The cheapest methods under 1e-6 are velocity Verlet and Runge–Kutta 4, equally: at h = "
      "0.1 s, 100 force evaluations.");
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
  EXPECT_TRUE(sentence(problem(rows)).ends_with("; 4 of Lantern's methods never get there."));
  EXPECT_EQ(short_sentence(problem(rows)),
            "The cheapest method under 1e-6 is velocity Verlet: 2 ms at h = 0.005 s.");
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
}  // namespace lantern
