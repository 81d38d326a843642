// The director: what a script brings about, step by step.
#include "run/director.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "scenario/directing.hpp"

namespace lantern::run {
namespace {

Scenario scenario(const std::string& text) { return parse_scenario(text, "test.toml"); }

constexpr const char* kTwoBodies = R"(
title = "Two"
[world]
size = [16, 16]
time_step = 0.5
[structure]
kind = "quadtree"
capacity = 1
[[body]]
name = "a"
radius = 1
position = [4, 4]
velocity = [2, 0]
[[body]]
name = "b"
radius = 1
position = [12, 4]
)";

TEST(Director, RunsTimeAndFollowsABody) {
  const auto frames = frames_of(scenario(std::string(kTwoBodies) + R"(
[[step]]
do = "insert"
bodies = ["a", "b"]
[[step]]
do = "run"
seconds = 2
expect = { position = { a = [8, 4] } }
)"),
                                Pace::step);
  ASSERT_EQ(frames.size(), 5u) << "one of the insertion, one a time step";
  EXPECT_DOUBLE_EQ(frames.back().time, 2);
  EXPECT_EQ(frames.back().bodies[0].position, Vec<3>(8, 4, 0));
}

TEST(Director, ReportsEachUnmetExpectationOnce) {
  const Scenario s = scenario(std::string(kTwoBodies) + R"(
[[step]]
do = "insert"
bodies = ["a", "b"]
expect = { pairs = 9, bodies = 2 }
[[step]]
do = "run"
seconds = 2
always = { bodies = 3 }
)");
  Work work;
  const DirectorReport report = direct(s, Pace::step, work, [](const Frame&) { return true; });
  ASSERT_EQ(report.unmet.count(), 2u) << "the second fails on 4 frames, and is reported once";
  EXPECT_NE(report.unmet.told()[0].message.find("expected pairs = 9, found 0"), std::string::npos);
  EXPECT_GT(report.unmet.told()[0].where.line, 1);
  EXPECT_FALSE(report.unmet.told()[0].source_line.empty());
  EXPECT_EQ(report.expectations, 6u);
}

TEST(Director, ABodyThatMovesOutOfTheWorldIsKept) {
  const auto frames = frames_of(scenario(std::string(kTwoBodies) + R"(
[[step]]
do = "insert"
bodies = ["a", "b"]
[[step]]
do = "move"
body = "a"
to = [100, 4]
expect = { bodies = 2, pairs = 0, in_leaves = { a = 1 } }
[[step]]
do = "move"
body = "b"
to = [101, 4]
expect = { bodies = 2, pairs = 1, overlaps = 1 }
)"),
                                Pace::step);
  EXPECT_EQ(frames.back().pairs.size(), 1u);
}

TEST(Director, StopsWhenTheSinkHasEnough) {
  const Scenario s = shipped("pong_bsp");
  Work work;
  int seen = 0;
  direct(s, Pace::step, work, [&](const Frame&) { return ++seen < 5; });
  EXPECT_EQ(seen, 5);
}

TEST(Director, OverflowOfAPositionIsRefusedWithItsPlace) {
  Scenario s = scenario(std::string(kTwoBodies) + R"(
[[step]]
do = "insert"
bodies = ["a"]
[[step]]
do = "run"
seconds = 2
)");
  s.bodies[0].velocity = Vec<3>(1e308, 0, 0);  // more than the language lets through
  Work work;
  try {
    direct(s, Pace::step, work, [](const Frame&) { return true; });
    FAIL() << "no position can be 2e308";
  } catch (const ScenarioError& e) {
    EXPECT_NE(std::string(e.what()).find("'a'"), std::string::npos) << e.what();
  }
}

TEST(Director, OfOneListNothingIsSaidAsOfATree) {
  const std::string text = world_text("size = [9, 9]",
                                      "[structure]\nkind = \"sort_and_sweep\"\n"
                                      "[[body]]\nname = \"a\"\nradius = 1\nposition = [2, 2]\n"
                                      "[[body]]\nname = \"b\"\nradius = 1\nposition = [6, 6]\n"
                                      "[[step]]\ndo = \"insert\"\nbodies = [\"a\", \"b\"]\n");
  const std::vector<Frame> frames = frames_of(parse_scenario(text, "list.toml"), Pace::event);
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[0].caption, "Sort and sweep lists a: 1 in all.");
  EXPECT_EQ(frames[1].caption, "Sort and sweep lists b: 2 in all.");
}

// A line may have thousands, and each quotes it.
TEST(Director, TellsTheFirstThatDoNotHoldAndCountsAll) {
  std::string text =
      "title = \"x\"\n[world]\nsize = [8, 8]\n[[pattern]]\nname = \"d\"\nradius = 0.1\n"
      "count = 80\n[[step]]\ndo = \"insert\"\nbodies = [\"d\"]\nexpect = { velocity = { ";
  for (int i = 1; i <= 80; ++i) text += (i > 1 ? ", d" : "d") + std::to_string(i) + " = [1, 0]";
  Work work;
  const DirectorReport report =
      direct(good(text + " } }\n"), Pace::step, work, [](const Frame&) { return true; });
  EXPECT_EQ(report.unmet.count(), 80u);
  EXPECT_EQ(report.unmet.told().size(), 50u);
  const std::vector<Diagnostic> list = report.unmet.list("that do not hold");
  ASSERT_EQ(list.size(), 51u);
  EXPECT_EQ(list.back().message, "30 more that do not hold");
}

}  // namespace
}  // namespace lantern::run
