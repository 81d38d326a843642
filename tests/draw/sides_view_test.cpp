// What stands at the same place of two sides can be compared.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "draw/layout_check.hpp"
#include "draw/page.hpp"
#include "draw/sample_frames.hpp"
#include "frame/parts/panels.hpp"

namespace lantern::draw {
namespace {

std::vector<Box<2>> boxes_of(const DrawList& list, const std::string& text) {
  std::vector<Box<2>> boxes;
  for (const LabelBox& label : list.labels)
    if (label.text == text) boxes.push_back(label.box);
  return boxes;
}

TEST(SidesView, EachHasItsTitleAndItsCounts) {
  const DrawList list = samples::page_of(samples::sided({samples::ghosts(4), samples::ghosts(3)}));
  const auto a = boxes_of(list, "side a"), b = boxes_of(list, "side b");
  ASSERT_EQ(a.size(), 1u);
  ASSERT_EQ(b.size(), 1u);
  EXPECT_EQ(a[0].lo.y, b[0].lo.y);
  const auto nodes = boxes_of(list, "nodes"), pairs = boxes_of(list, "candidate pairs");
  ASSERT_EQ(nodes.size(), 2u) << "under its side, and nowhere else";
  ASSERT_EQ(pairs.size() + boxes_of(list, "candidate pair").size(), 2u);
  EXPECT_EQ(nodes[0].lo.y, nodes[1].lo.y);
  EXPECT_NEAR(nodes[0].lo.x - a[0].lo.x, nodes[1].lo.x - b[0].lo.x, 1e-9);
}

TEST(SidesView, AnEndingShowsTheCountsOfSidesLarge) {
  Frame frame = samples::sided({samples::ghosts(4), samples::ghosts(3)});
  frame.sides[0].counts = {{"nodes", 13022}};
  frame.sides[1].counts = {{"nodes", 1}};
  for (const Frame& side : frame.sides)
    frame.headline.push_back(side.get<FrameSide>().name + ".nodes");
  EXPECT_FALSE(says(samples::page_of(frame), "nodes, " + frame.sides[0].get<FrameSide>().name));
  frame.ending = true;
  const DrawList list = samples::page_of(frame);
  EXPECT_TRUE(says(list, "nodes, " + frame.sides[0].get<FrameSide>().name));
  EXPECT_TRUE(says(list, "node, " + frame.sides[1].get<FrameSide>().name));
  EXPECT_TRUE(says(list, "13\u2009022"));
  EXPECT_EQ(boxes_of(list, "nodes").size(), 1u) << "under the first side, once";
  for (Frame& side : frame.sides) side.add<FrameSide>().name += " under settings with a long name";
  frame.headline.clear();
  for (const Frame& side : frame.sides)
    frame.headline.push_back(side.get<FrameSide>().name + ".nodes");
  EXPECT_TRUE(says(samples::page_of(frame), frame.sides[0].get<FrameSide>().name))
      << "the caption keeps its room";
}

TEST(SidesView, ANumberMayHaveWordsOfItsOwn) {
  Frame frame = samples::sided({samples::ghosts(4), samples::ghosts(3)});
  frame.sides[0].counts = {{"nodes", 9}, {"pairs", 1}};
  frame.sides[1].counts = {{"nodes", 1}, {"pairs", 5}};
  const std::string first = frame.sides[0].get<FrameSide>().name + ".nodes";
  frame.headline = {first, "pairs"};
  frame.words = {{first, "square/squares of the first"}, {"pairs", "pair left/pairs left"}};
  DrawList list = samples::page_of(frame);
  EXPECT_EQ(boxes_of(list, "squares of the first").size(), 1u) << "under its side alone";
  EXPECT_EQ(boxes_of(list, "node").size(), 1u);
  const auto one = boxes_of(list, "pair left"), many = boxes_of(list, "pairs left");
  ASSERT_EQ(one.size(), 1u);
  ASSERT_EQ(many.size(), 1u);
  const auto a = boxes_of(list, "squares of the first"), b = boxes_of(list, "node");
  EXPECT_NEAR(one[0].lo.x - a[0].lo.x, many[0].lo.x - b[0].lo.x, 1e-9) << "one below the other";
  frame.ending = true;
  EXPECT_EQ(boxes_of(samples::page_of(frame), "squares of the first").size(), 2u)
      << "at the foot, too, and nothing is said behind it";
}

TEST(SidesView, AChartUnderOnePanelEachHasTwoFifthsOfTheHeight) {
  Frame frame = samples::sided({samples::ghosts(4), samples::ghosts(3)});
  const Panel world = panel_named("world"), chart = panel_named("chart");
  frame.panels = {world, chart};
  for (Frame& side : frame.sides) side.panels = {world};
  frame.add<FrameChart>().y_name = "depth";
  frame.add<FrameChart>().series = {{.name = "a", .points = {{0, 1}, {1, 2}}}};
  const DrawList list = samples::page_of(frame);
  const auto above = boxes_of(list, "side a"), heading = boxes_of(list, "depth");
  ASSERT_TRUE(above.size() == 1 && heading.size() == 1);
  double lowest = 0;
  for (const LabelBox& label : list.labels)
    if (label.box.hi.y < 760) lowest = std::max(lowest, label.box.hi.y);
  EXPECT_GT(lowest - heading[0].lo.y, 0.38 * (lowest - above[0].lo.y)) << "but for its rims";
}

TEST(SidesView, CountersThatAreOffAreNotUnderTheSides) {
  Frame frame = samples::sided({samples::ghosts(4), samples::ghosts(3)});
  frame.display.counters = false;
  EXPECT_FALSE(says(samples::page_of(frame), "nodes"));
}

TEST(SidesView, OneScaleHoldsForAll) {
  const Frame frame = samples::sided({samples::ghosts(4), samples::ghosts(2)});
  const DrawList list = samples::page_of(frame);
  std::vector<Box<2>> worlds;
  for (const KeyedRun& run : list.runs)
    if (run.key.ends_with("world/rim"))
      worlds.push_back(std::get<RectShape>(list.shapes[run.first]).box);
  ASSERT_EQ(worlds.size(), 2u);
  EXPECT_NEAR(worlds[1].size().x, worlds[0].size().x, 1e-9);
  EXPECT_NEAR(worlds[1].lo.y, worlds[0].lo.y, 1e-9);
}

TEST(SidesView, WhatOneSideDoesAloneStandsUnderIt) {
  Frame frame = samples::sided({samples::ghosts(4), samples::ghosts(3)});
  frame.caption.clear();
  frame.sides[1].caption = "Blue is stored.";
  const DrawList list = samples::page_of(frame);
  const auto words = boxes_of(list, "Blue is stored."), title = boxes_of(list, "side b");
  ASSERT_EQ(words.size(), 1u);
  EXPECT_NEAR(words[0].lo.x, title[0].lo.x, 3);
  frame.sides[1].add<FrameSide>().held = true;
  EXPECT_FALSE(says_part(samples::page_of(frame), "Blue is stored.")) << "it does nothing now";
  frame.sides[1].time = 1.5;
  EXPECT_TRUE(says(samples::page_of(frame), "·  1.50 s"));
  EXPECT_TRUE(says(samples::page_of(frame), "·  0.00 s")) << "the clocks differ: both are said";
}

TEST(SidesView, AChartSpansThem) {
  const auto named = samples::sides();
  const auto found =
      std::ranges::find(named, "sides with a chart", &samples::Named::value_type::first);
  const DrawList list = samples::page_of(found->second);
  EXPECT_EQ(std::ranges::count_if(
                list.labels, [](const LabelBox& label) { return label.text.starts_with("time"); }),
            1);
}

TEST(SidesView, KeysBeginWithTheSide) {
  DrawList list;
  list.prefix = "eager/";
  { const DrawList::Scope shown(list, "tree/node/1.3", "world/cell/1.3"); }
  EXPECT_EQ(list.runs[0].key, "eager/tree/node/1.3");
  EXPECT_EQ(list.runs[0].from, "eager/world/cell/1.3");
  EXPECT_EQ(list.runs[1].key, "") << "what is the page's is no side's";
  const DrawList page = samples::page_of(samples::sided({samples::ghosts(4), samples::ghosts(3)}));
  for (const KeyedRun& run : page.runs)
    EXPECT_FALSE(run.key.starts_with("world/") || run.key.starts_with("tree/")) << run.key;
  EXPECT_EQ(page.prefix, "");
}

TEST(SidesView, CountsTheLayoutsOfEach) {
  Work work;
  draw_frame(samples::sided({samples::ghosts(4), samples::ghosts(3)}), page_for(1600, 900), work);
  EXPECT_EQ(work.world_layouts, 2u);
  EXPECT_EQ(work.tree_layouts, 2u);
}

}  // namespace
}  // namespace lantern::draw
