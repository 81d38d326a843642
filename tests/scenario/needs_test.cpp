// What a scenario leaves out is left out for a true reason.
#include "scenario/needs.hpp"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "scenario/parsing.hpp"
#include "scenario/reference.hpp"

namespace lantern::test {
namespace {

Scenario shipped(const std::string& name) {
  return good(read_text(std::string(LANTERN_ROOT "/scenarios/") + name + ".toml"));
}

const Need& need(const Needs& needs, const std::string& stage) {
  const auto found = std::find_if(needs.listed.begin(), needs.listed.end(),
                                  [&](const Need& n) { return n.stage == stage; });
  EXPECT_NE(found, needs.listed.end()) << stage;
  return *found;
}

TEST(Needs, OfAStandingTree) {
  const Needs needs = needs_of(shipped("ghost_quadtree"));
  EXPECT_TRUE(needs.world && needs.structure && needs.pairs && needs.world_panel &&
              needs.tree_panel);
  EXPECT_FALSE(needs.motion || needs.atlas || needs.atlas_panel);
  EXPECT_EQ(need(needs, "world").reason, "4 bodies");
  EXPECT_EQ(need(needs, "motion").reason, "no step lets time pass");
}

TEST(Needs, OfAMovingScene) {
  const Needs needs = needs_of(shipped("pong_bsp"));
  EXPECT_TRUE(needs.motion);
  EXPECT_EQ(need(needs, "motion").reason, "ball moves, and 2 s pass");
  EXPECT_EQ(need(needs, "structure").reason, "brute_force, then bsp");
}

TEST(Needs, OfAnAtlas) {
  const Needs needs = needs_of(shipped("kdtree_atlas"));
  EXPECT_FALSE(needs.world || needs.motion || needs.structure || needs.pairs || needs.world_panel);
  EXPECT_TRUE(needs.atlas && needs.atlas_panel && needs.tree_panel);
}

TEST(Needs, NameWhatTheProductHasAndThisSceneDoesNot) {
  for (const char* name : {"ghost_quadtree", "pong_bsp", "kdtree_atlas"})
    for (const char* stage : {"rotation", "forces", "springs and joints", "static structure",
                              "narrow phase", "contact solver", "friction", "sleeping", "queries",
                              "level", "chart", "memory panel", "3D camera"})
      EXPECT_FALSE(need(needs_of(shipped(name)), stage).used) << stage;
}

TEST(Needs, AreListedAsTheyAre) {
  for (const std::string& text : good_texts()) {
    const Needs needs = needs_of(good(text));
    EXPECT_EQ(need(needs, "rotation").used, needs.rotation);
    EXPECT_EQ(need(needs, "forces").used, needs.forces);
    EXPECT_EQ(need(needs, "springs and joints").used, needs.links);
    EXPECT_EQ(need(needs, "static structure").used, needs.static_structure);
    EXPECT_EQ(need(needs, "narrow phase").used, needs.narrow_phase);
    EXPECT_EQ(need(needs, "contact solver").used, needs.solver);
    EXPECT_EQ(need(needs, "friction").used, needs.friction);
    EXPECT_EQ(need(needs, "sleeping").used, needs.sleeping);
    EXPECT_EQ(need(needs, "queries").used, needs.queries);
    EXPECT_EQ(need(needs, "level").used, needs.level);
    EXPECT_EQ(need(needs, "chart").used, needs.chart);
    EXPECT_EQ(need(needs, "3D camera").used, needs.camera);
    EXPECT_EQ(need(needs, "chart panel").used, needs.chart_panel);
    EXPECT_EQ(need(needs, "memory panel").used, needs.memory_panel);
    EXPECT_EQ(need(needs, "OpenGL").reason, "only for --format png");
    EXPECT_EQ(need(needs, "world").used, needs.world);
    EXPECT_EQ(need(needs, "motion").used, needs.motion);
    EXPECT_EQ(need(needs, "structure").used, needs.structure);
    EXPECT_EQ(need(needs, "candidate pairs").used, needs.pairs);
    EXPECT_EQ(need(needs, "atlas").used, needs.atlas);
    EXPECT_EQ(need(needs, "world panel").used, needs.world_panel);
    EXPECT_EQ(need(needs, "tree panel").used, needs.tree_panel);
    EXPECT_EQ(need(needs, "atlas panel").used, needs.atlas_panel);
    for (const Need& n : needs.listed) EXPECT_FALSE(n.reason.empty()) << n.stage;
  }
}

std::string moving(const std::string& velocity, const std::string& steps) {
  return "title = \"x\"\n[world]\nsize = [9, 9]\n[[body]]\nname = \"a\"\nradius = 1\n"
         "position = [1, 1]\nvelocity = " +
         velocity + "\n" + steps;
}

TEST(Needs, SomethingMovesOnlyWhileItIsThere) {
  const std::string insert = "[[step]]\ndo = \"insert\"\nbodies = [\"a\"]\n";
  const std::string remove = "[[step]]\ndo = \"remove\"\nbodies = [\"a\"]\n";
  const std::string run = "[[step]]\ndo = \"run\"\nseconds = 1\n";
  const auto moves = [](const std::string& text) { return needs_of(good(text)).motion; };
  const auto told = [](const std::string& velocity) {
    return "[[step]]\ndo = \"move\"\nbody = \"a\"\nvelocity = " + velocity + "\n";
  };
  EXPECT_TRUE(moves(moving("[1, 0]", insert + run)));
  EXPECT_FALSE(moves(moving("[1, 0]", run + insert)));
  EXPECT_FALSE(moves(moving("[1, 0]", insert + remove + run)));
  EXPECT_FALSE(moves(moving("[0, 0]", insert + run)));
  EXPECT_TRUE(moves(moving("[0, 0]", insert + told("[0, 1]") + run)));
  EXPECT_FALSE(moves(moving("[1, 0]", insert + told("[0, 0]") + run)));
  EXPECT_TRUE(moves(moving("[1, 0]", insert + told("[0, 0]") + remove + insert + run)))
      << "a body that enters again does so with its own velocity";
  EXPECT_EQ(need(needs_of(good(moving("[0, 0]", insert + run))), "motion").reason,
            "no body ever moves");
}

TEST(Needs, OfASolidSceneWithEverything) {
  const Needs needs = needs_of(good(std::string(kSolid)));
  EXPECT_TRUE(needs.motion && needs.rotation && needs.forces && needs.links && needs.structure &&
              needs.static_structure && needs.narrow_phase && needs.solver && needs.friction &&
              needs.sleeping && needs.queries && needs.chart && needs.camera);
  EXPECT_FALSE(needs.level || needs.atlas);
  EXPECT_EQ(need(needs, "forces").reason, "gravity, springs");
  EXPECT_EQ(need(needs, "springs and joints").reason, "3 springs, 1 joint");
  EXPECT_EQ(need(needs, "contact solver").reason, "soft contacts in small steps");
  EXPECT_EQ(need(needs, "rotation").reason, "ball turns, or may be turned");
  EXPECT_EQ(need(needs, "queries").reason, "1 ray, cull or query");
}

// Each thing is needed for its own reason, and not without it.
TEST(Needs, OfPhysicsAreTrue) {
  const std::string head = "title = \"x\"\n[world]\nsize = [9, 9]\n";
  const auto scene = [&](const std::string& world, const std::string& body,
                         const std::string& rest = "") {
    return needs_of(good(head + world + "[[body]]\nname = \"a\"\nposition = [1, 1]\n" + body +
                         "[[body]]\nname = \"b\"\nposition = [5, 1]\nradius = 1\n" + rest +
                         "[[step]]\ndo = \"insert\"\nbodies = [\"a\", \"b\"]\n"
                         "[[step]]\ndo = \"run\"\nseconds = 1\n"));
  };
  const std::string ball = "radius = 1\n";
  const Needs plain = scene("", ball);
  EXPECT_FALSE(plain.motion || plain.rotation || plain.forces || plain.links || plain.solver ||
               plain.narrow_phase || plain.friction || plain.sleeping || plain.camera);
  EXPECT_EQ(need(plain, "narrow phase").reason, "the world lets bodies pass through each other");
  const Needs falling = scene("gravity = [0, -1]\n", ball);
  EXPECT_TRUE(falling.motion && falling.forces);
  EXPECT_FALSE(falling.rotation) << "gravity turns nothing";
  EXPECT_TRUE(scene("", "radius = 1\nspin = 5\n").rotation);
  EXPECT_TRUE(scene("", "radius = 1\ndrag = 1\n").forces);
  const Needs touching = scene("contacts = \"impulse\"\n", ball);
  EXPECT_TRUE(touching.narrow_phase && touching.solver && touching.friction && touching.rotation);
  EXPECT_FALSE(touching.forces);
  EXPECT_EQ(need(touching, "contact solver").reason, "sequential impulses");
  const Needs smooth = scene("contacts = \"impulse\"\n", "radius = 1\nfriction = 0\n");
  EXPECT_FALSE(smooth.friction);
  EXPECT_EQ(need(smooth, "friction").reason, "no two bodies have friction");
  EXPECT_TRUE(scene("may_sleep = true\n", ball).sleeping);
  const Needs tied = scene("", ball, "[[joint]]\nkind = \"pin\"\na = \"a\"\nb = \"b\"\n");
  EXPECT_TRUE(tied.links && tied.solver && tied.motion);
  EXPECT_FALSE(tied.narrow_phase || tied.forces);
  EXPECT_EQ(need(tied, "contact solver").reason, "for the joints");
  EXPECT_TRUE(scene("", ball, "[[spring]]\na = \"a\"\nb = \"b\"\nstiffness = 1\n").forces);
}

TEST(Needs, OfALevel) {
  const std::string level =
      "title = \"x\"\n[world]\nsize = [12, 8]\n"
      "[level]\nloops = [[[1, 1], [11, 1], [11, 7]]]\n";
  const Needs needs = needs_of(good(level + "[[step]]\ndo = \"show\"\n"));
  EXPECT_FALSE(needs.level);
  EXPECT_EQ(need(needs, "level").reason, "no step compiles it");
  EXPECT_TRUE(needs.world_panel) << "its walls are drawn";
  const Needs compiled = needs_of(good(std::string(level_example())));
  EXPECT_TRUE(compiled.level && compiled.tree_panel);
  EXPECT_EQ(need(compiled, "level").reason, "8 walls");
}

TEST(Needs, PanelsAreDerivedUnlessGiven) {
  using Panels = std::vector<Panel>;
  EXPECT_EQ(shipped("ghost_quadtree").panels, (Panels{Panel::world, Panel::tree}));
  EXPECT_EQ(shipped("kdtree_atlas").panels, (Panels{Panel::atlas, Panel::tree}));
  const std::string ghosts = read_text(LANTERN_ROOT "/scenarios/ghost_quadtree.toml");
  const Scenario given = good("panels = [\"tree\"]\n" + ghosts);
  EXPECT_EQ(given.panels, (Panels{Panel::tree}));
  EXPECT_FALSE(needs_of(given).world_panel);
  EXPECT_EQ(need(needs_of(given), "world panel").reason, "the scenario's panels leave it out");
  EXPECT_EQ(good(moving("[0, 0]", "[structure]\nkind = \"brute_force\"\n[[step]]\ndo = \"show\"\n"))
                .panels,
            (Panels{Panel::world}))
      << "brute force has no tree";
}

}  // namespace
}  // namespace lantern::test
