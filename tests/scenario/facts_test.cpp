// The lecture's facts, figure by figure, in the scenarios that show them.
#include <algorithm>

#include <gtest/gtest.h>

#include "frame/parts/atlas.hpp"
#include "scenario/directing.hpp"

namespace lantern::run {
namespace {

TEST(Facts, Pong) {
  const auto frames = frames_of("pong_bsp");
  EXPECT_GE(std::count_if(frames.begin(), frames.end(),
                          [](const Frame& f) {
                            return f.event == "right" || f.event == "across" || f.event == "left";
                          }),
            3);
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
  EXPECT_EQ(pairs, (std::vector<std::int64_t>{1, 2, 1, 3, 1}));
}

TEST(Facts, GhostsAreTheSameByStepAndByEvent) {
  const auto steps = frames_of("ghost_quadtree");
  const auto events = frames_of("ghost_quadtree", Pace::event);
  EXPECT_GT(events.size(), steps.size());
  for (const Frame& step : steps) {
    if (step.event == "split") continue;  // the step's own events
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
  Scenario ghosts = shipped("ghost_quadtree");
  for (Step& step : ghosts.steps) step.pace.reset(), step.events.clear();
  const auto events = frames_of(ghosts, Pace::event);
  EXPECT_EQ(at(events, "split").caption, "The root holds 3, but its limit is 2, so it must split.");
  for (const char* event : {"test", "store", "split", "hand_down"}) at(events, event);
}

TEST(Facts, CoincidentBodiesSplitDownToTheLimit) {
  const auto frames = frames_of("coincident_max_depth");
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
  EXPECT_LT(*at(frames, "parted").count("nodes"), 10) << "the tree is small again";
}

TEST(Facts, AtlasFitsAndRefuses) {
  const auto frames = frames_of("kdtree_atlas");
  const Frame& first = at(frames, "first");
  EXPECT_EQ(node(first, "A").box.size(), Vec<3>(200, 300, 0));
  const Frame& second = at(frames, "second");
  const FrameNode& b = node(second, "B");
  EXPECT_EQ(second.nodes[b.parent].parent, 0u) << "B goes to the right child, which is cut";
  EXPECT_EQ(second.nodes[b.parent].slot, 1u);
  EXPECT_EQ(node(second, "free C").parent, b.parent);
  EXPECT_TRUE(node(second, "free C").bodies.empty()) << "C is free";
  const Frame& last = frames.back();
  EXPECT_GE(*last.count("textures"), 32);
  EXPECT_EQ(last.count("refused"), 1);
  EXPECT_NE(last.caption.find("banner"), std::string::npos) << "the refused texture is named";
  for (const Frame& frame : frames)
    EXPECT_EQ(*frame.count("used_area") + *frame.count("free_area"), 512 * 512);
  for (const FrameTexture& s : last.get<FrameTextures>().textures)
    for (const FrameTexture& t : last.get<FrameTextures>().textures)
      EXPECT_FALSE(s.packed && t.packed && s.id < t.id && s.x < t.x + t.width &&
                   t.x < s.x + s.width && s.y < t.y + t.height && t.y < s.y + s.height)
          << s.name << " and " << t.name << " overlap";
}

}  // namespace
}  // namespace lantern::run
