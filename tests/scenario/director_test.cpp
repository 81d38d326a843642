// The director: every frame tells the truth about the engine, and the lecture's facts hold.
#include "scenario/director.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include <gtest/gtest.h>

namespace lantern {
namespace {

std::vector<Frame> frames_of(const Scenario& scenario, Pace pace) {
  Work work;
  std::vector<Frame> frames;
  direct(scenario, pace, work, [&](const Frame& frame) {
    frames.push_back(frame);
    return true;
  });
  return frames;
}

std::vector<Frame> frames_of(const std::string& name, Pace pace = Pace::step) {
  return frames_of(load_scenario(LANTERN_ROOT "/scenarios/" + name + ".toml"), pace);
}

std::vector<std::string> all_scenarios() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(LANTERN_ROOT "/scenarios"))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

// The first frame of this event.
const Frame& at(const std::vector<Frame>& frames, const std::string& event) {
  const auto found = std::find_if(frames.begin(), frames.end(),
                                  [&](const Frame& frame) { return frame.event == event; });
  EXPECT_NE(found, frames.end()) << "no frame of event " << event;
  return found == frames.end() ? frames.front() : *found;
}

const FrameNode& node(const Frame& frame, const std::string& label) {
  for (const FrameNode& n : frame.nodes)
    if (n.label == label) return n;
  ADD_FAILURE() << "no node " << label;
  return frame.nodes.front();
}

std::set<std::string> bodies_in(const Frame& frame, const std::string& label) {
  std::set<std::string> names;
  for (const BodyId id : node(frame, label).bodies)
    for (const FrameBody& body : frame.bodies)
      if (body.id == id) names.insert(body.name);
  return names;
}

using Names = std::set<std::string>;

// --- the truth of every frame ---

class EveryFrame : public testing::TestWithParam<std::tuple<std::string, Pace>> {
 protected:
  std::vector<Frame> frames() const {
    return frames_of(std::get<0>(GetParam()), std::get<1>(GetParam()));
  }
};

TEST_P(EveryFrame, MissesNoPairThatOverlaps) {
  for (const Frame& frame : frames()) {
    if (frame.structure == StructureKind::none || frame.event == "hand_down") continue;
    std::set<Pair> listed;
    for (const FramePair& p : frame.pairs) listed.insert(p.pair);
    EXPECT_EQ(listed.size(), frame.pairs.size()) << "a pair is listed twice on " << frame.index;
    const bool settled = frame.event != "split" && frame.event != "store" &&
                         frame.event != "test" && frame.event != "miss" &&
                         frame.event != "make_child" && frame.event != "depth_limit" &&
                         frame.event != "no_progress";
    if (!settled) continue;  // in the midst of an insertion some bodies are in no leaf yet
    for (const FrameBody& a : frame.bodies)
      for (const FrameBody& b : frame.bodies)
        EXPECT_TRUE(a.id >= b.id || !overlap(a.box, b.box) || listed.contains({a.id, b.id}))
            << a.name << " and " << b.name << " overlap, but are no pair on " << frame.index;
  }
}

TEST_P(EveryFrame, CountsWhatItLists) {
  for (const Frame& frame : frames()) {
    if (frame.nodes.empty()) continue;
    std::int64_t leaves = 0, depth = 0, entries = 0, tests = 0;
    for (const FrameNode& n : frame.nodes) {
      leaves += n.leaf;
      depth = std::max<std::int64_t>(depth, n.depth);
      const auto k = static_cast<std::int64_t>(n.bodies.size());
      entries += k;
      tests += k * (k - 1) / 2;
    }
    EXPECT_EQ(frame.count("nodes"), std::int64_t(frame.nodes.size()));
    EXPECT_EQ(frame.count("leaves"), leaves);
    EXPECT_EQ(frame.count("depth"), depth);
    if (frame.structure == StructureKind::none) continue;
    EXPECT_EQ(frame.count("entries"), entries);
    EXPECT_EQ(frame.count("pair_tests"), tests);
    EXPECT_EQ(frame.count("pairs"), std::int64_t(frame.pairs.size()));
  }
}

TEST_P(EveryFrame, HasAUniqueWholeTree) {
  for (const Frame& frame : frames()) {
    std::set<std::string> ways;
    for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
      const FrameNode& n = frame.nodes[i];
      EXPECT_EQ(n.id, i);
      if (i == 0) {
        EXPECT_EQ(n.parent, kNone);
        continue;
      }
      ASSERT_LT(n.parent, i) << "a parent must stand before its child";
      EXPECT_FALSE(frame.nodes[n.parent].leaf);
      EXPECT_EQ(n.depth, frame.nodes[n.parent].depth + 1);
      EXPECT_TRUE(ways.insert(std::to_string(n.parent) + "." + std::to_string(n.slot)).second);
    }
  }
}

TEST_P(EveryFrame, SaysSomethingAndIsNumbered) {
  const auto all = frames();
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].index, i);
    EXPECT_FALSE(all[i].caption.empty()) << "frame " << i << " is silent";
    EXPECT_FALSE(all[i].event.empty());
    EXPECT_EQ(all[i].caption.find('{'), std::string::npos) << all[i].caption;
  }
}

TEST_P(EveryFrame, IsTheSameOnASecondRun) {
  const auto first = frames();
  const auto second = frames();
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(to_json(first[i]), to_json(second[i]));
}

INSTANTIATE_TEST_SUITE_P(Scenarios, EveryFrame,
                         testing::Combine(testing::ValuesIn(all_scenarios()),
                                          testing::Values(Pace::step, Pace::event)),
                         [](const auto& each) {
                           return std::get<0>(each.param) +
                                  (std::get<1>(each.param) == Pace::step ? "_step" : "_event");
                         });

// --- the lecture's facts, figure by figure ---

TEST(Facts, Pong) {
  const auto frames = frames_of("pong_bsp");
  EXPECT_GE(std::count_if(frames.begin(), frames.end(),
                          [](const Frame& f) {
                            return f.event == "right" || f.event == "across" || f.event == "left";
                          }),
            60);
  const Frame& split = at(frames, "split");
  EXPECT_EQ(node(split, "root").plane_name, "net");
  EXPECT_EQ(bodies_in(split, "back"), Names({"blue bat"}));
  EXPECT_EQ(bodies_in(split, "front"), (Names{"red bat", "ball"}));
  std::vector<std::int64_t> pairs;
  for (const Frame& frame : frames) {
    EXPECT_EQ(frame.count("all_pairs"), 3);
    if (frame.structure == StructureKind::bsp &&
        (pairs.empty() || pairs.back() != *frame.count("pairs")))
      pairs.push_back(*frame.count("pairs"));
  }
  EXPECT_EQ(pairs, (std::vector<std::int64_t>{1, 2, 1}));
}

TEST(Facts, GhostsAreTheSameByStepAndByEvent) {
  const auto steps = frames_of("ghost_quadtree");
  const auto events = frames_of("ghost_quadtree", Pace::event);
  EXPECT_GT(events.size(), 2 * steps.size());
  for (const Frame& step : steps) {
    const Frame& same = at(events, step.event);
    EXPECT_EQ(same.hash, step.hash) << step.event;
    EXPECT_EQ(same.caption, step.caption);
  }
  const Frame& four = at(steps, "four");
  EXPECT_EQ(bodies_in(four, "1.3"), Names({"pink"}));
  EXPECT_EQ(bodies_in(four, "1.4"), Names({"pink"}));
  EXPECT_EQ(bodies_in(four, "1.1"), Names({"blue"}));
  EXPECT_EQ(bodies_in(four, "1.2"), Names({"red"}));
  EXPECT_EQ(bodies_in(four, "4"), Names({"player"}));
}

TEST(Facts, EventsAreToldInWords) {
  const auto events = frames_of("ghost_quadtree", Pace::event);
  EXPECT_EQ(at(events, "split").caption, "The root holds 3, its limit is 2: it splits.");
  for (const char* event : {"test", "store", "split", "hand_down"}) at(events, event);
}

TEST(Facts, CoincidentBodiesSplitDownToTheLimit) {
  const auto frames = frames_of("coincident_max_depth");
  std::uint32_t deepest_split = 0;
  for (const Frame& frame : frames)
    if (frame.event == "split") deepest_split = std::max(deepest_split, frame.nodes.back().depth);
  EXPECT_GE(deepest_split, 1u);
  std::vector<std::int64_t> nodes;
  for (const char* event : {"limit_2", "limit_4", "limit_6", "limit_8"}) {
    const Frame& frame = at(frames, event);
    nodes.push_back(*frame.count("nodes"));
    EXPECT_EQ(frame.count("pairs"), 3);
    EXPECT_GE(*frame.count("pair_tests"), 3);
    for (const FrameNode& n : frame.nodes)
      EXPECT_TRUE(!n.leaf || n.bodies.size() <= 2 || n.depth == *frame.count("depth"))
          << "a full leaf above the limit";
  }
  EXPECT_TRUE(std::is_sorted(nodes.begin(), nodes.end()));
  EXPECT_GT(nodes.back(), 100 * nodes.front());
  EXPECT_LT(*at(frames, "apart").count("nodes"), 10) << "the tree is small again";
}

TEST(Facts, AtlasFitsAndRefuses) {
  const auto frames = frames_of("kdtree_atlas");
  const Frame& first = at(frames, "first");
  EXPECT_EQ(node(first, "A").box.size(), Vec<3>(200, 300, 0));
  const Frame& second = at(frames, "second");
  const FrameNode& b = node(second, "B");
  EXPECT_EQ(second.nodes[b.parent].parent, 0u) << "B goes to the right child, which is cut";
  EXPECT_EQ(second.nodes[b.parent].slot, 1u);
  EXPECT_EQ(node(second, "C").parent, b.parent);
  EXPECT_TRUE(node(second, "C").bodies.empty()) << "C is free";
  const Frame& last = frames.back();
  EXPECT_GE(*last.count("textures"), 32);
  EXPECT_EQ(last.count("refused"), 1);
  EXPECT_NE(last.caption.find("banner"), std::string::npos) << "the refused texture is named";
  for (const Frame& frame : frames)
    EXPECT_EQ(*frame.count("used_area") + *frame.count("free_area"), 512 * 512);
  for (const FrameTexture& s : last.textures)
    for (const FrameTexture& t : last.textures)
      EXPECT_FALSE(s.packed && t.packed && s.id < t.id && s.x < t.x + t.width &&
                   t.x < s.x + s.width && s.y < t.y + t.height && t.y < s.y + s.height)
          << s.name << " and " << t.name << " overlap";
}

// --- scripts of the tests' own ---

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
  ASSERT_EQ(report.unmet.size(), 2u) << "the second fails on 4 frames, and is reported once";
  EXPECT_NE(report.unmet[0].message.find("expected pairs = 9, found 0"), std::string::npos);
  EXPECT_GT(report.unmet[0].where.line, 1);
  EXPECT_FALSE(report.unmet[0].source_line.empty());
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
  const Scenario s = load_scenario(LANTERN_ROOT "/scenarios/pong_bsp.toml");
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
  s.bodies[0].velocity = Vec<2>(1e308, 0);  // more than the language lets through
  Work work;
  try {
    direct(s, Pace::step, work, [](const Frame&) { return true; });
    FAIL() << "no position can be 2e308";
  } catch (const ScenarioError& e) {
    EXPECT_NE(std::string(e.what()).find("'a'"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace lantern
