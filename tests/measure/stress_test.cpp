// The stress cases: each keeps its bound, gives the same figure again, and none can crash the rest.
#include "measure/stress.hpp"

#include <bit>
#include <cmath>
#include <filesystem>
#include <ostream>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

namespace lantern::measure {

// Else a case is shown as bytes, among them addresses.
void PrintTo(const StressCase& one, std::ostream* out) { *out << one.name; }

namespace {

class EveryCase : public testing::TestWithParam<StressCase> {};

TEST_P(EveryCase, KeepsItsBound) {
  const StressOutcome first = run_case(GetParam());
  EXPECT_TRUE(first.result.good) << GetParam().what << " " << first.result.figure << " "
                                 << first.result.unit << ", bound " << first.result.bound << ": "
                                 << first.result.detail;
  if (GetParam().group != "extreme input") return;  // the others take longer
  const StressOutcome again = run_case(GetParam());
  EXPECT_EQ(std::bit_cast<std::uint64_t>(first.result.figure),
            std::bit_cast<std::uint64_t>(again.result.figure))
      << "the same input gave another figure";
  EXPECT_EQ(first.result.detail, again.result.detail);
}

// Under sanitizers what counts is extreme input; how exact long runs are, the release build tells.
#ifdef __SANITIZE_ADDRESS__
constexpr bool kRunsAll = false;
#else
constexpr bool kRunsAll = true;
#endif

std::vector<StressCase> quick_cases() {
  std::vector<StressCase> quick;
  for (const StressCase& one : stress_cases())
    if (!one.slow && (kRunsAll || one.group == "extreme input")) quick.push_back(one);
  return quick;
}

INSTANTIATE_TEST_SUITE_P(Stress, EveryCase, testing::ValuesIn(quick_cases()),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(Stress, CasesHaveNamesGroupsAndSentences) {
  const std::set<std::string_view> groups{"extreme input", "stiff", "stability",
                                          "energy", "laws", "bars"};
  std::set<std::string_view> names, seen;
  for (const StressCase& one : stress_cases()) {
    EXPECT_TRUE(names.insert(one.name).second) << one.name << " is there twice";
    EXPECT_EQ(one.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"),
              std::string_view::npos)
        << one.name;
    EXPECT_TRUE(groups.contains(one.group)) << one.name << ": " << one.group;
    seen.insert(one.group);
    EXPECT_EQ(one.what.substr(one.what.size() - 1), ".") << one.name << " has no sentence";
    EXPECT_NE(one.run, nullptr) << one.name;
  }
  EXPECT_EQ(seen, groups);
}

TEST(Stress, AFigureBeyondItsBoundFails) {
  EXPECT_TRUE(at_most(2, 2, "m").good);
  EXPECT_FALSE(at_most(2, 2.0000001, "m").good);
  EXPECT_TRUE(at_least(2, 2, "m").good);
  EXPECT_FALSE(at_least(2, 1.9999999, "m").good);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(at_most(2, nan, "m").good) << "what is no number keeps no bound";
  EXPECT_FALSE(at_least(2, nan, "m").good);
  const StressCase broken{"broken", "bars", "One is at most nothing.",
                          [] { return at_most(0, 1, "m"); }};
  EXPECT_FALSE(run_case(broken).result.good);
  EXPECT_EQ(run_case(broken).result.figure, 1);
}

// Every file of scenarios/stress/ is a case.
TEST(Stress, ScenariosAreCases) {
  std::set<std::string_view> names;
  for (const StressCase& one : stress_cases()) names.insert(one.name);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(LANTERN_ROOT "/scenarios/stress")) {
    EXPECT_TRUE(names.contains(entry.path().stem().string())) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 15u);
}

TEST(Stress, WhatIsThrownIsAFailedCase) {
  const StressCase throws{"throws", "bars", "It throws.",
                          []() -> StressResult { throw std::runtime_error("no such luck"); }};
  const StressOutcome outcome = run_case(throws);
  EXPECT_FALSE(outcome.result.good);
  EXPECT_EQ(outcome.result.detail, "no such luck");
  EXPECT_TRUE(std::isnan(outcome.result.figure));
}

}  // namespace
}  // namespace lantern::measure
