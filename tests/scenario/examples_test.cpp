// The scenarios and examples of the reference page do what they promise.
#include <string>

#include <gtest/gtest.h>

#include "language/language.hpp"
#include "language/reference.hpp"
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
  expect_kept(std::string(world_example()));
  expect_kept(std::string(atlas_example()));
  expect_kept(std::string(level_example()));
  expect_kept(std::string(map_example()));
}

TEST(Examples, OfTheVerbsGoOnFromTheirScenariosAndKeepTheirPromises) {
  std::string world(world_example()), atlas(atlas_example()), level(level_example());
  for (const TableDoc& verb : language_verbs()) {
    const bool on_atlas = verb.name == "pack" || verb.name == "ask_room" || verb.name == "draw";
    const bool on_level = verb.name == "compile" || verb.name == "locate" || verb.name == "order" ||
                          verb.name == "see";
    std::string& text = on_atlas ? atlas : on_level ? level : world;
    text += "\n" + std::string(verb.example);
    SCOPED_TRACE(verb.name);
    expect_kept(text);
  }
}

}  // namespace
}  // namespace lantern::run
