// The bars of what kinds of structures do for the same bodies.
#include <gtest/gtest.h>

#include "draw/layout_check.hpp"
#include "draw/sample_frames.hpp"
#include "frame/parts/panels.hpp"

namespace lantern::draw {
namespace {

using frame::FrameComparison;

Frame frame_of(std::initializer_list<const char*> worlds) {
  using enum StructureKind;
  Frame frame;
  frame.title = "Which structure for which world?";
  frame.dimension = 3;
  frame.bounds = {Vec<3>(0.0), Vec<3>(64.0)};
  frame.panels = {panel_named("comparison")};
  FrameComparison& told = frame.add<FrameComparison>();
  for (const char* const world : worlds)
    told.rows.push_back({.name = world,
                         .answer = "A grid, for all bodies are alike.",
                         .machine = {},
                         .bodies = 1200,
                         .marks = {{Box<3>::around(Vec<3>(9.0), Vec<3>(1.0))}},
                         .cells = {{brute_force, {.pair = 5'000'000}},
                                   {quadtree, {.build = 60'000, .renew = 60'000, .pair = 40'000}},
                                   {octree, {.build = 150'000, .renew = 150'000, .pair = 50'000}},
                                   {grid, {.build = 1'200, .renew = 1'200, .pair = 48'800}},
                                   {aabb_tree, {.build = 120'000, .renew = 0, .pair = 150'000}}}});
  return frame;
}

double length_of(const DrawList& list, const std::string& bar) {
  for (const KeyedRun& run : list.runs)
    if (run.key == "comparison/bar/" + bar)
      return std::get<RectShape>(list.shapes[run.first]).box.size().x;
  return -1;
}

std::size_t plates(const DrawList& list, Role fill) {
  std::size_t n = 0;
  for (const DrawShape& shape : list.shapes)
    if (const auto* rect = std::get_if<RectShape>(&shape))
      n += rect->fill == fill && rect->stroke.role == Role::lit;
  return n;
}

TEST(Comparison, HasABarForEachStructureAsLongAsItsWork) {
  const DrawList list = samples::page_of(frame_of({"stadium"}));
  const double unit = length_of(list, "stadium/quadtree");
  EXPECT_GT(unit, 100);
  EXPECT_NEAR(length_of(list, "stadium/octree"), 2 * unit, 1e-9);
  EXPECT_NEAR(length_of(list, "stadium/grid"), 0.5 * unit, 1e-9);
  EXPECT_NEAR(length_of(list, "stadium/AABB tree"), 1.5 * unit, 1e-9);
  EXPECT_NEAR(length_of(list, "stadium/brute force"), 2 * unit, 1e-9) << "it is cut";
  EXPECT_EQ(plates(list, Role::lit_fill), 1u) << "the grid's";
  EXPECT_EQ(plates(list, Role::none), 1u) << "the quadtree's, the best of the lecture's own";
}

TEST(Comparison, SaysWhatIsBuiltOnceOnlyOfWhatNeverMoves) {
  Frame frame = frame_of({"stadium"});
  EXPECT_FALSE(says(samples::page_of(frame), "built once"));
  frame.add<FrameComparison>().rows[0].marks[0].is_static = true;
  EXPECT_TRUE(says(samples::page_of(frame), "built once"));
}

TEST(Clock, HasTheTimesThatAreKnownOfAllWorldsInOneScale) {
  Frame frame = frame_of({"stadium", "tower"});
  frame.panels = {panel_named("clock")};
  for (FrameComparison::Row& row : frame.add<FrameComparison>().rows) {
    row.machine = "a desk";
    row.cells[0].micros = row.name == "tower" ? 240 : 300;  // brute force
    row.cells[1].micros = 120;                              // the quadtree
    row.cells[3].micros = 60;                               // the grid
  }
  const DrawList list = samples::page_of(frame);
  EXPECT_TRUE(says(list,
                   "microseconds a step; filled: least of all; ringed: least of the lecture's; "
                   "processor time, a desk"));
  const double unit = length_of(list, "stadium/grid");
  EXPECT_GT(unit, 20);
  EXPECT_NEAR(length_of(list, "tower/grid"), unit, 1e-9);
  EXPECT_NEAR(length_of(list, "stadium/quadtree"), 2 * unit, 1e-9);
  EXPECT_EQ(length_of(list, "stadium/octree"), -1) << "nobody knows";
  EXPECT_EQ(plates(list, Role::lit_fill), 2u) << "a grid's in each world";
  expect_laid_out(list, {{0, 0}, list.page}, 24, "the clock");
}

TEST(Comparison, IsOfTheNewestWorldUntilTheEndingHasAll) {
  Frame frame = frame_of({"stadium", "tower", "town", "crowds", "birds and whales", "swarm"});
  EXPECT_FALSE(says(samples::page_of(frame), "tower"));
  expect_laid_out(samples::page_of(frame), {{0, 0}, {1600, 900}}, 24, "one world");
  frame.ending = true;
  const DrawList list = samples::page_of(frame);
  for (const FrameComparison::Row& row : frame.get<FrameComparison>().rows) {
    EXPECT_TRUE(says(list, row.name));
    EXPECT_GT(length_of(list, row.name + "/grid"), 0) << "the best";
    EXPECT_GT(length_of(list, row.name + "/quadtree"), 0) << "the best of the lecture's own";
    EXPECT_GT(length_of(list, row.name + "/brute force"), 0);
    EXPECT_EQ(length_of(list, row.name + "/octree"), -1);
  }
  expect_laid_out(list, {{0, 0}, list.page}, 24, "all worlds");
}

}  // namespace
}  // namespace lantern::draw
