// Bodies in the sectors of a compiled level, and who sees whom there.
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "frame/parts/level.hpp"
#include "geometry/flat.hpp"
#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"
#include "spatial/pairs.hpp"

namespace lantern::run {
namespace {

// Two rooms whose doors lead the same way into one passage, so that neither sees the other; two
// bodies in one of them, one in the other.
const std::string kRooms =
    "title = \"x\"\n[world]\nsize = [12, 8]\n"
    "[level]\nloops = [[[1, 1], [4, 1], [4, 2], [6, 2], [6, 6], [4, 6], [4, 7], [1, 7], [1, 5], "
    "[5, 5], [5, 3], [1, 3]]]\n"
    "[[body]]\nname = \"imp\"\nlook = \"demon\"\nradius = 0.4\nposition = [2, 1.6]\n"
    "[[body]]\nname = \"kit\"\nlook = \"item\"\nradius = 0.4\nposition = [3, 1.6]\n"
    "[[body]]\nname = \"hound\"\nlook = \"demon\"\nradius = 0.4\nposition = [2, 6.4]\n"
    "[[step]]\ndo = \"insert\"\nbodies = [\"imp\", \"kit\"]\n";
const std::string kCompiled = kRooms + "[[step]]\ndo = \"compile\"\n";

// The part of a convex region that lies within a box.
Polygon clipped_to(Polygon region, const Box<2>& box) {
  for (int axis = 0; axis < 2; ++axis) {
    Vec<2> up{0.0};
    up[axis] = 1;
    region = clipped(region, Plane<2>::through(box.lo, up), true);
    region = clipped(region, Plane<2>::through(box.hi, up), false);
  }
  return region;
}

// Every body is in each leaf whose sector its box reaches, and pairs are those who share one.
void expect_held(const Frame& frame) {
  std::set<Pair> pairs;
  std::uint64_t entries = 0;
  for (const FrameNode& leaf : frame.nodes) {
    if (!leaf.leaf) continue;
    entries += leaf.bodies.size();
    for (const FrameBody& body : frame.bodies) {
      const bool held = std::ranges::count(leaf.bodies, body.id) > 0;
      // The leaf answers for the stone behind its walls, too.
      if (!clipped_to(leaf.region, flat(body.box)).empty()) {
        EXPECT_TRUE(held) << body.name << " reaches sector " << leaf.label;
      }
    }
    for (const BodyId a : leaf.bodies)
      for (const BodyId b : leaf.bodies)
        if (a < b) pairs.insert({a, b});
  }
  EXPECT_EQ(frame.count("entries"), static_cast<std::int64_t>(entries));
  std::set<Pair> found;
  for (const FramePair& p : frame.pairs) found.insert(p.pair);
  EXPECT_EQ(found, pairs);
}

TEST(LevelBodies, LieInTheSectorsThatTheirBoxesReach) {
  for (const char* const name : {"level_demons", "quake_visibility"})
    for (const Frame& frame : frames_of(std::string(name))) {
      if (frame.structure == StructureKind::none) continue;
      SCOPED_TRACE(std::string(name) + " " + frame.event);
      EXPECT_EQ(frame.structure, StructureKind::bsp);
      expect_held(frame);
      EXPECT_EQ(frame.count("leaves"), frame.count("sectors"));
    }
}

TEST(LevelBodies, EnterAndMoveInALevelThatIsCompiled) {
  const std::vector<Frame> frames =
      frames_of(good(kCompiled + "[[step]]\ndo = \"insert\"\nbodies = [\"hound\"]\n"
                                 "[[step]]\ndo = \"move\"\nbody = \"kit\"\nto = [3, 6.4]\n"));
  EXPECT_EQ(frames[0].structure, StructureKind::none);
  EXPECT_EQ(frames[1].count("pairs"), 1);  // the imp and the kit
  EXPECT_EQ(frames[2].count("pairs"), 1);
  EXPECT_EQ(frames[3].count("pairs"), 1);  // the hound and the kit
  EXPECT_NE(frames[2].pairs[0].pair, frames[3].pairs[0].pair);
  for (std::size_t i = 1; i < frames.size(); ++i) expect_held(frames[i]);
}

TEST(LevelBodies, StayInTheStructureThatTheFileNames) {
  std::string text = kCompiled;
  text.insert(text.find("[level]"), "[structure]\nkind = \"quadtree\"\n");
  const std::vector<Frame> frames = frames_of(good(text));
  EXPECT_EQ(frames[1].structure, StructureKind::quadtree);
  EXPECT_TRUE(frames[1].count("sectors").has_value());
}

TEST(LevelBodies, HiddenOnesAreRuledOut) {
  const std::string ask =
      "[[step]]\ndo = \"insert\"\nbodies = [\"hound\"]\n"
      "[[step]]\ndo = \"see\"\neye = [2, 1.6]\n"
      "[[step]]\ndo = \"locate\"\npoint = [2, 1.6]\n";
  const std::vector<Frame> frames = frames_of(good(kCompiled + ask));
  const Frame &seen = frames[3], &here = frames[4];
  for (const Frame* frame : {&seen, &here})
    for (const FrameBody& body : frame->bodies)
      EXPECT_EQ(body.dimmed, body.name == "hound") << body.name << " on " << frame->event;
  EXPECT_EQ(seen.count("bodies_seen"), 2);
  EXPECT_EQ(here.count("bodies_here"), 2);
  std::int64_t lit = 0;
  for (const FrameNode& node : seen.nodes) lit += node.leaf && !node.unseen;
  EXPECT_EQ(seen.count("sectors_seen"), lit);
  EXPECT_FALSE(seen.get<FrameLevel>().portals.empty());
}

TEST(LevelBodies, TheMatrixIsFoundOnceAndFillsRowByRow) {
  std::string text = kCompiled +
                     "[[step]]\ndo = \"see\"\npace = \"event\"\n"
                     "[[step]]\ndo = \"see\"\neye = [2, 1.6]\n";
  text.insert(0, "panels = [\"world\", \"matrix\"]\n");
  const std::vector<Frame> frames = frames_of(good(text));
  std::size_t known = 0;
  for (const Frame& frame : frames) {
    std::size_t now = 0;
    for (const std::string& row : frame.get<FrameMatrix>().rows)
      now += row.size() - static_cast<std::size_t>(std::ranges::count(row, '.'));
    EXPECT_GE(now, known);
    known = now;
  }
  const std::size_t n = frames.back().get<FrameMatrix>().rows.size();
  EXPECT_EQ(known, n * n);
  EXPECT_EQ(at(frames, "portals").count("visible_pairs"), 0);
  EXPECT_EQ(frames.back().count("portals_tested"),
            frames[frames.size() - 2].count("portals_tested"));
  EXPECT_EQ(frames.back().get<FrameMatrix>().lit + 1, frames.back().count("sector"));
}

TEST(LevelBodies, TestsAddUpBuildByBuild) {
  const std::vector<Frame> frames = frames_of(shipped("compile_cost"));
  for (const char* const name : {"quadtree", "first wall", "best wall"}) {
    std::int64_t sum = 0;
    bool compiled = false;
    double time = 0;
    for (const Frame& frame : frames) {
      const Frame& side = *frame.side_named(name);
      if (!side.count("tests_so_far")) continue;
      const bool of_level = side.structure == StructureKind::bsp;
      if (of_level && !compiled) sum += *side.count("side_tests");
      compiled |= of_level;
      const bool built =
          frame.time > time || &frame == &frames[0] || (frame.event == "compiled" && of_level);
      time = frame.time;
      if (built) sum += *side.count("box_tests") + *side.count("pair_tests");
      EXPECT_EQ(side.count("tests_so_far"), sum) << name << " on frame " << frame.index;
    }
  }
}

TEST(LevelBodies, MistakesAreTold) {
  const std::string see = "[[step]]\ndo = @\"see\"\n";
  expect_mistakes(kRooms + see, {"add a step with do = \"compile\" before"});
  expect_mistakes(kCompiled + "[[step]]\ndo = @\"rebuild\"\ncapacity = 3\n",
                  {"takes no other settings"});
  expect_mistakes(kRooms + "expect = { @pairs = 1 }\n", {"there is no structure at this step"});
  expect_mistakes(kCompiled + "expect = { @visible_pairs = 1 }\n",
                  {"no step has asked who sees whom yet"});
  expect_mistakes(kCompiled + "[[step]]\ndo = \"see\"\nexpect = { @bodies_seen = 1 }\n",
                  {"no eye has looked yet"});
  expect_mistakes("panels = [@\"matrix\"]\n" + kCompiled, {"a step with do = \"see\""});
}

}  // namespace
}  // namespace lantern::run
