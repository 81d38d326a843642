// Every number of a caption has a referent on its page.
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "draw/page.hpp"
#include "run/director.hpp"

namespace lantern::draw {
namespace {

namespace fs = std::filesystem;

// What captions tell and pages do not show yet. An entry that is no longer needed fails, too.
const std::map<std::string, std::set<std::string>> kUnshown = {};

// The counts and measures that the frame's caption quotes and nothing on its page depicts.
std::vector<std::string> unshown_numbers(const Frame& frame, const DrawList& list) {
  std::vector<std::string> unshown;
  for (const std::string& name : frame.told)
    if (!list.referents.contains(name)) unshown.push_back(name);
  return unshown;
}

std::vector<std::string> shipped_scenarios() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(LANTERN_ROOT) / "scenarios"))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

class EveryPage : public testing::TestWithParam<std::string> {};

// The last frame of each step: its caption's numbers are the same ones on all of its frames.
TEST_P(EveryPage, ShowsTheNumbersThatItsCaptionTells) {
  const std::string name = GetParam();
  const auto scenario =
      run::load_scenario((fs::path(LANTERN_ROOT) / "scenarios" / (name + ".toml")).string());
  std::set<std::string> unshown;
  Frame last;
  const auto look = [&] {
    if (last.told.empty()) return;
    Work work;
    const DrawList list = draw_frame(last, page_for(1600, 900), work);
    for (const std::string& number : unshown_numbers(last, list)) unshown.insert(number);
  };
  Work work;
  run::direct(scenario, scenario.pace, work, [&](const Frame& frame) {
    if (frame.step != last.step) look();
    last = frame;
    return true;
  });
  look();
  const auto known = kUnshown.find(name);
  EXPECT_EQ(unshown, known == kUnshown.end() ? std::set<std::string>() : known->second);
}

INSTANTIATE_TEST_SUITE_P(Scenarios, EveryPage, testing::ValuesIn(shipped_scenarios()),
                         [](const auto& each) { return each.param; });

TEST(Told, WhatNothingDepictsIsFound) {
  Frame frame;
  frame.told = {"nodes", "stale"};
  DrawList list;
  list.referents = {"nodes"};
  EXPECT_EQ(unshown_numbers(frame, list), std::vector<std::string>{"stale"});
}

}  // namespace
}  // namespace lantern::draw
