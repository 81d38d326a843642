// What a scenario leaves out is left out for a true reason.
#include "scenario/needs.hpp"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "scenario/parsing.hpp"
#include "scenario/reference.hpp"

namespace lantern::test {
namespace {

Scenario scenario(const std::string& name) {
  return good(read_text(std::string(LANTERN_ROOT "/scenarios/") + name + ".toml"));
}

const Need& need(const Needs& needs, const std::string& stage) {
  const auto found = std::find_if(needs.listed.begin(), needs.listed.end(),
                                  [&](const Need& n) { return n.stage == stage; });
  EXPECT_NE(found, needs.listed.end()) << stage;
  return *found;
}

TEST(Needs, OfAStandingTree) {
  const Needs needs = needs_of(scenario("ghost_quadtree"));
  EXPECT_TRUE(needs.world && needs.structure && needs.pairs && needs.world_panel &&
              needs.tree_panel);
  EXPECT_FALSE(needs.motion || needs.atlas || needs.atlas_panel);
  EXPECT_EQ(need(needs, "world").reason, "4 bodies");
  EXPECT_EQ(need(needs, "motion").reason, "no step lets time pass");
}

TEST(Needs, OfAMovingScene) {
  const Needs needs = needs_of(scenario("pong_bsp"));
  EXPECT_TRUE(needs.motion);
  EXPECT_EQ(need(needs, "motion").reason, "ball moves, and 2 s pass");
  EXPECT_EQ(need(needs, "structure").reason, "brute_force, then bsp");
}

TEST(Needs, OfAnAtlas) {
  const Needs needs = needs_of(scenario("kdtree_atlas"));
  EXPECT_FALSE(needs.world || needs.motion || needs.structure || needs.pairs || needs.world_panel);
  EXPECT_TRUE(needs.atlas && needs.atlas_panel && needs.tree_panel);
}

TEST(Needs, NameWhatTheProductHasAndThisSceneDoesNot) {
  for (const char* name : {"ghost_quadtree", "pong_bsp", "kdtree_atlas"})
    for (const char* stage : {"rotation", "forces", "springs and joints", "static structure",
                              "narrow phase", "contact solver", "friction", "sleeping", "queries",
                              "level", "chart", "memory panel", "3D camera"})
      EXPECT_FALSE(need(needs_of(scenario(name)), stage).used) << stage;
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

TEST(Needs, PanelsAreDerivedUnlessGiven) {
  using Panels = std::vector<Panel>;
  EXPECT_EQ(scenario("ghost_quadtree").panels, (Panels{Panel::world, Panel::tree}));
  EXPECT_EQ(scenario("kdtree_atlas").panels, (Panels{Panel::atlas, Panel::tree}));
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
