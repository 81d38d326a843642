// What frames show of structures: the leaves' array, what never moves, who sleeps, what is stale;
// and the chart.
#include <set>

#include <gtest/gtest.h>

#include "frame/parts/panels.hpp"
#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

const std::string kCrowd = R"([[pattern]]
name = "pillar"
static = true
count = 12
half_size = [0.8, 0.8]
[[pattern]]
name = "ghost"
count = 9
radius = 0.7
speed = 3
)";
const std::string kInsertCrowd = "do = \"insert\"\nbodies = [\"pillar\", \"ghost\"]";

std::vector<Frame> crowd(const std::string& structure, const std::vector<std::string>& script,
                         const std::string& head = "") {
  return frames_of(good(head + world_text("size = [32, 18]\ntime_step = 0.0625",
                                          "[structure]\n" + structure + kCrowd + steps(script))));
}

TEST(Pictures, LeavesShareAnArrayButNoSlot) {
  for (const std::string split : {"", "split_static = true\n"}) {
    const auto frames =
        crowd("kind = \"quadtree\"\n" + split, {kInsertCrowd, "do = \"run\"\nseconds = 1"},
              "panels = [\"world\", \"memory\"]\n");
    for (const Frame& frame : frames) {
      std::set<std::uint32_t> taken;
      std::size_t leaves = 0;
      for (const FrameNode& n : frame.nodes) {
        if (!n.leaf || n.of_static) {
          EXPECT_EQ(n.first, kNone) << "only leaves of what moves lie in the pictured array";
          continue;
        }
        if (n.first == kNone) continue;
        ++leaves;
        EXPECT_LE(n.bodies.size(), n.room);
        EXPECT_LE(n.first + n.room, frame.get<FrameStructure>().array_size);
        for (std::uint32_t i = 0; i < n.room; ++i)
          EXPECT_TRUE(taken.insert(n.first + i).second) << "two leaves share a slot";
      }
      EXPECT_GT(leaves, 0u);
    }
  }
  EXPECT_EQ(crowd("kind = \"quadtree\"\n", {kInsertCrowd})[0].get<FrameStructure>().array_size, 0u)
      << "without the panel nobody asks";
}

// Then there is no engine that could remember any.
TEST(Pictures, NobodyRemembersCollisionsWithoutBodies) {
  const std::string level = "[level]\nloops = [[[1, 1], [31, 1], [31, 17], [1, 17]]]\n";
  for (const std::string& scene : {std::string(), level}) {
    const auto frames =
        frames_of(good("panels = [\"world\", \"collisions\"]\n" +
                       world_text("size = [32, 18]\ncontacts = \"lecture\"", scene + kShow)));
    ASSERT_EQ(frames.size(), 1u);
    EXPECT_FALSE(frames[0].find<FrameCollisions>());
  }
}

TEST(Pictures, WhatNeverMovesIsBuiltOnce) {
  const auto of_moving = [](const Frame& frame) {
    std::int64_t n = 0;
    for (const FrameNode& node : frame.nodes)
      if (node.leaf && !node.of_static) n += std::ssize(node.bodies);
    return n;
  };
  for (const std::string kind : {"brute_force", "quadtree", "sort_and_sweep", "grid"}) {
    const auto frames = crowd("split_static = true\nkind = \"" + kind + "\"\n",
                              {kInsertCrowd, "do = \"run\"\nseconds = 1"});
    std::int64_t made = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      EXPECT_EQ(frames[i].count("static_builds"), 1) << kind << ", frame " << i;
      EXPECT_EQ(frames[i].count("dynamic_builds"), std::int64_t(i) + 1) << kind;
      // A grid keeps each body once, and draws the cells it reaches.
      if (i == 0)
        made = kind == "grid" ? std::ssize(frames[i].bodies) : *frames[i].count("entries");
      else
        made += kind == "grid" ? 9 : of_moving(frames[i]);
      EXPECT_EQ(frames[i].count("entries_in_all"), made) << kind << ", frame " << i;
      for (const FrameNode& n : frames[i].nodes)
        for (const std::string& name : names(frames[i], n.bodies))
          EXPECT_EQ(name.starts_with("pillar"), n.of_static) << name;
    }
  }
  const auto moved = crowd("split_static = true\nkind = \"quadtree\"\n",
                           {kInsertCrowd, "do = \"run\"\nseconds = 0.5",
                            "do = \"move\"\nbody = \"pillar1\"\nto = [3, 3]"});
  EXPECT_EQ(moved.back().count("static_builds"), 2) << "a pillar was moved by the script";
}

TEST(Pictures, TwoStructuresMissNoPairThatOneFinds) {
  const std::vector<std::string> script{kInsertCrowd, "do = \"run\"\nseconds = 2"};
  const auto touching = [](const Frame& frame) {
    std::set<std::pair<BodyId, BodyId>> pairs;
    for (const FramePair& p : frame.pairs) {
      const FrameBody &a = frame.bodies[p.pair.a], &b = frame.bodies[p.pair.b];
      if (overlap(a.box, b.box) && !(a.is_static && b.is_static)) pairs.insert({a.id, b.id});
    }
    return pairs;
  };
  const auto one = crowd("kind = \"brute_force\"\n", script);
  std::size_t met = 0;
  for (const std::string kind : {"quadtree", "kd_tree", "sort_and_sweep", "grid"}) {
    const auto two = crowd("split_static = true\nkind = \"" + kind + "\"\n", script);
    ASSERT_EQ(two.size(), one.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(touching(two[i]), touching(one[i])) << kind << ", frame " << i;
      met += touching(one[i]).size();
    }
  }
  EXPECT_GT(met, 0u) << "nothing overlaps: the test says nothing";
}

TEST(Pictures, NodesSleepWhenAllBelowThemDo) {
  const auto frames = frames_of(good(
      world_text("size = [32, 18]\nmay_sleep = true",
                 "[structure]\nkind = \"quadtree\"\ncapacity = 1\nmax_depth = 4\n[[pattern]]\n"
                 "name = \"p\"\ncount = 14\nradius = 0.6\n" +
                     steps({"do = \"insert\"\nbodies = [\"p\"]", "do = \"sleep\"\nbodies = [\"p\"]",
                            "do = \"wake\"\nbodies = [\"p7\"]"}))));
  const auto sleeping = [](const Frame& frame) {
    std::int64_t n = 0;
    for (const FrameNode& node : frame.nodes) n += !node.awake;
    return n;
  };
  EXPECT_EQ(frames[1].count("asleep"), 14);
  EXPECT_EQ(sleeping(frames[1]), std::int64_t(frames[1].nodes.size())) << "all sleep";
  EXPECT_TRUE(frames[1].pairs.empty()) << "two sleepers are a pair";
  const Frame& one = frames[2];
  EXPECT_TRUE(one.nodes[0].awake) << "the root holds the one that woke";
  EXPECT_GT(sleeping(one), 0);
  for (const FrameNode& n : one.nodes) {
    bool holds = false;
    for (const std::string& name : names(one, n.bodies)) holds = holds || name == "p7";
    EXPECT_TRUE(!n.leaf || n.awake == holds) << n.label;
  }
  for (const FramePair& p : one.pairs)
    EXPECT_TRUE(one.bodies[p.pair.a].name == "p7" || one.bodies[p.pair.b].name == "p7");
}

TEST(Pictures, AKdTreeIsStaleUntilItIsRebuilt) {
  const auto frames =
      crowd("kind = \"kd_tree\"\ncapacity = 1\n",
            {kInsertCrowd, "do = \"move\"\nbody = \"ghost1\"\nto = [40, 40]\nrebuild = false",
             "do = \"rebuild\""});
  EXPECT_EQ(frames[0].count("stale"), 0);
  EXPECT_EQ(frames[1].count("stale"), 1);
  EXPECT_EQ(frames[2].count("stale"), 0);
}

TEST(Pictures, LinesHaveAPointForEachPlot) {
  const std::string chart = "[chart]\nx = \"bodies\"\ny = [\"pairs\", \"all_pairs\"]\n";
  const auto frames = frames_of(good(
      world_text("size = [32, 18]",
                 "[structure]\nkind = \"brute_force\"\n" + kCrowd + chart +
                     steps({"do = \"insert\"\nbodies = [\"pillar\"]\nplot = \"a\"", "do = \"show\"",
                            "do = \"insert\"\nbodies = [\"ghost\"]\nplot = \"b\""}))));
  ASSERT_EQ(frames[2].get<FrameChart>().series.size(), 2u);
  EXPECT_EQ(frames[1].get<FrameChart>().series[0].points.size(), 1u)
      << "a step without plot added a point";
  EXPECT_EQ(frames[2].get<FrameChart>().series[1].name, "all_pairs");
  EXPECT_EQ(frames[2].get<FrameChart>().series[1].points,
            (std::vector<Vec<2>>{Vec<2>(12, 66), Vec<2>(21, 210)}));
  EXPECT_TRUE(frames[2].get<FrameChart>().bars.empty());
}

TEST(Pictures, BarsOfOnePartStandTogether) {
  const auto frames = frames_of(good(world_text(
      "size = [32, 18]",
      "[structure]\nkind = \"brute_force\"\n" + kCrowd + "[chart]\nbars = \"pairs\"\n" +
          steps({"do = \"insert\"\nbodies = [\"ghost\"]\nplot = \"all\"\npart = \"few\"",
                 "do = \"rebuild\"\nkind = \"quadtree\"\nplot = \"tree\"",
                 "do = \"insert\"\nbodies = [\"pillar\"]\nplot = \"tree\"\npart = \"many\""}))));
  const std::vector<FrameBar>& bars = frames.back().get<FrameChart>().bars;
  ASSERT_EQ(bars.size(), 3u);
  EXPECT_EQ(bars[0].label, "all");
  EXPECT_EQ(bars[0].value, 36) << "nine ghosts";
  EXPECT_EQ(bars[1].value, double(*frames[1].count("pairs")));
  EXPECT_EQ(bars[0].group, bars[1].group);
  EXPECT_NE(bars[1].group, bars[2].group) << "a new part begins a new group";
  EXPECT_TRUE(frames.back().get<FrameChart>().series.empty());
}

}  // namespace
}  // namespace lantern::run
