// The scenarios and examples of the reference page do what they promise.
#include <string>

#include <gtest/gtest.h>

#include "language/language.hpp"
#include "run/director.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

// Runs the scenario without pixels; every promise in it must hold.
void expect_kept(const std::string& text) {
  const Scenario scenario = good(text);
  Work work;
  const DirectorReport report =
      direct(scenario, scenario.pace, work, [](const Frame&) { return true; });
  EXPECT_TRUE(report.unmet.empty()) << shown(report.unmet.told());
  EXPECT_GT(report.expectations, 0u) << "an example that promises nothing";
}

TEST(Examples, OfScenariosKeepTheirPromises) {
  expect_kept(std::string(example("world")));
  expect_kept(std::string(example("atlas")));
  expect_kept(std::string(example("level")));
  expect_kept(std::string(example("map")));
}

TEST(Examples, OfTheVerbsGoOnFromTheirScenariosAndKeepTheirPromises) {
  for (const TableDoc& verb : language_verbs()) {
    SCOPED_TRACE(verb.name);
    expect_kept(example_up_to(verb.name));
  }
}

}  // namespace
}  // namespace lantern::run
