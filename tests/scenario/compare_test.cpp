// What the step `compare` tells of worlds and structures.
#include <gtest/gtest.h>

#include "frame/parts/panels.hpp"
#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

const std::string kDots = "[[pattern]]\nname = \"dot\"\ncount = 30\nradius = 0.5\nspeed = 2\n";
const std::string kWalls =
    "[[pattern]]\nname = \"wall\"\ncount = 10\nhalf_size = [1, 1]\nstatic = true\n";

std::string compared(const std::string& bodies, const std::string& more = "") {
  return "[[step]]\ndo = \"compare\"\nrow = \"a world\"\nbodies = " + bodies + "\n" + more;
}

TEST(Compare, SetsEveryKindBesideTheOthersWithoutTouchingTheWorld) {
  const std::vector<Frame> frames = frames_of(
      good(world_text("size = [32, 32]", kTree + kDots + kWalls +
                                             compared("[\"dot\", \"wall\"]",
                                                      "verdict = \"{least_work} at best\"\n"
                                                      "expect = { compared_pairs = 735 }\n") +
                                             compared("[\"dot1..dot4\"]"))));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_TRUE(frames[0].bodies.empty());
  const FrameComparison& table = frames[0].get<FrameComparison>();
  ASSERT_EQ(table.rows.size(), 1u);
  const FrameComparison::Row& row = table.rows[0];
  EXPECT_EQ(row.bodies, 40u);
  EXPECT_EQ(row.cells.size(), 7u) << "no octree in 2D";
  EXPECT_EQ(row.answer, std::to_string(row.least()) + " at best");
  EXPECT_EQ(row.cell(StructureKind::brute_force)->work.step(), 735u) << "30 · 29 / 2 + 30 · 10";
  for (const FrameComparison::Cell& cell : row.cells)
    EXPECT_EQ(cell.work.overlaps, row.cells[0].work.overlaps);
  EXPECT_EQ(frames[0].count("least_lecture_work"), row.least(true));
  EXPECT_GT(row.least(true), row.least()) << "the lecture's own are not all";
  EXPECT_EQ(frames[1].get<FrameComparison>().rows.size(), 2u);
  EXPECT_EQ(frames[1].count("compared_bodies"), 4);
}

TEST(Compare, TellsTimesThatTheScriptSaysAndNoOthers) {
  const auto frames =
      frames_of(good(world_text("size = [32, 32]", kTree + kDots +
                                                       compared("[\"dot\"]",
                                                                "times = { grid = 9 }\n"
                                                                "machine = \"a desk\"\n"))));
  const FrameComparison::Row& row = frames.at(0).get<FrameComparison>().rows.at(0);
  EXPECT_EQ(row.machine, "a desk");
  for (const FrameComparison::Cell& cell : row.cells)
    EXPECT_EQ(cell.micros, cell.kind == StructureKind::grid ? 9 : 0);
}

TEST(Compare, RefusesWhatItCannotSetBesideAnother) {
  const std::string world = "title = \"x\"\n[world]\nsize = [32, 32]\n" + kTree + kDots;
  expect_mistakes(world + "[[step]]\ndo = \"compare\"\nrow = \"a\"\nbodies = [\"dot\", @\"dot\"]\n",
                  {"is named twice"});
  std::string many = world;
  for (int i = 0; i < 6; ++i) many += compared("[\"dot\"]");
  expect_mistakes(world + compared("[\"dot\"]", "@times = { grid = 9 }\n"),
                  {"and the 'machine' that took them"});
  expect_mistakes(world + compared("[\"dot\"]", "@machine = \"a desk\"\n"),
                  {"and the 'machine' that took them"});
  expect_mistakes(many + "[[step]]\ndo = @\"compare\"\nrow = \"a\"\nbodies = [\"dot\"]\n",
                  {"more than 6 worlds"});
  expect_mistakes(world + "[[step]]\ndo = \"show\"\nexpect = { @least_work = 1 }\n",
                  {"no step has compared structures yet"});
  expect_mistakes("title = \"x\"\npanels = [@\"comparison\"]\n[world]\nsize = [32, 32]\n" + kTree +
                      kDots + "[[step]]\ndo = \"show\"\n",
                  {"cannot have the panel 'comparison'"});
}

}  // namespace
}  // namespace lantern::run
