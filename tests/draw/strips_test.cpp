// The strips under the panels, and the intervals of a sweep.
#include <algorithm>

#include <gtest/gtest.h>

#include "draw/layout_check.hpp"
#include "draw/sample_frames.hpp"
#include "frame/parts/panels.hpp"

namespace lantern::draw {
namespace {

const Frame& strip(const std::string& name) {
  static const samples::Named all = samples::strips();
  for (const auto& [known, frame] : all)
    if (known == name) return frame;
  throw std::invalid_argument(name);
}

// The extents of rectangles of this fill.
std::vector<Box<2>> rects(const DrawList& list, Role fill) {
  std::vector<Box<2>> found;
  for (const DrawShape& shape : list.shapes)
    if (const auto* rect = std::get_if<RectShape>(&shape); rect && rect->fill == fill)
      found.push_back(rect->box);
  return found;
}

TEST(Pool, NamesTheOwnerOfEachSlotAndMarksThoseReused) {
  Frame frame = strip("strips_pool");
  frame.panels = {panel_named("pool")};
  const DrawList list = samples::page_of(frame);
  for (const FrameNode& node : frame.nodes)
    EXPECT_TRUE(says(list, node.label)) << "slot " << node.pool_slot;
  EXPECT_EQ(rects(list, Role::frustum).size(), 6u + 1) << "and one beside their number";
  EXPECT_EQ(rects(list, Role::free_space).size(), 14 - frame.nodes.size());
  EXPECT_TRUE(says(list, "6 reused"));
  EXPECT_TRUE(says(list, "14 allocations"));
}

TEST(Bytes, AreDrawnToScale) {
  Frame frame = strip("strips_others");
  frame.panels = {panel_named("bytes")};
  const DrawList list = samples::page_of(frame);
  const std::vector<Box<2>> own = rects(list, Role::static_body),
                            boxes = rects(list, Role::lit_fill);
  ASSERT_EQ(own.size(), 2u);
  ASSERT_EQ(boxes.size(), 1u);
  EXPECT_NEAR(own[0].size().x, own[1].size().x, 1e-9);
  EXPECT_NEAR(boxes[0].size().x / own[0].size().x, 32.0 / 17, 1e-9);
}

TEST(Sparkline, StandsStillWhileTimeGoesOn) {
  Frame early = strip("strips_others"), late = early;
  late.add<FrameTrace>().points.push_back({3, 2});
  AxisRanges axes;
  axes.see(late);
  const DrawList before = samples::page_of(early, axes), after = samples::page_of(late, axes);
  const auto line_of = [](const DrawList& list) {
    std::vector<LineShape> lines;
    for (const DrawShape& shape : list.shapes)
      if (const auto* line = std::get_if<LineShape>(&shape); line && line->stroke.width == 2.6)
        lines.push_back(*line);
    return lines;
  };
  const auto short_line = line_of(before), long_line = line_of(after);
  ASSERT_GT(long_line.size(), short_line.size());
  for (std::size_t i = 0; i + 1 < short_line.size(); ++i)  // the last one goes on
    EXPECT_EQ(short_line[i].to, long_line[i].to) << "what was drawn has moved";
}

TEST(Sparkline, HoldsACountUntilItChanges) {
  Frame frame = strip("strips_alone");
  frame.panels = {panel_named("sparkline")};
  frame.display.counters = false;
  frame.add<FrameTrace>() = {"pairs", {{0, 3}, {1, 3}, {2, 0}, {4, 1}}, 4.0};
  const DrawList list = samples::page_of(frame);
  int steps = 0;
  for (const DrawShape& shape : list.shapes)
    if (const auto* line = std::get_if<LineShape>(&shape);
        line && line->stroke.role == Role::pair) {
      EXPECT_TRUE(line->from.x == line->to.x || line->from.y == line->to.y);
      ++steps;
    }
  EXPECT_EQ(steps, 4) << "two level, two upright";
  EXPECT_TRUE(says(list, "candidate pair"));
  EXPECT_FALSE(says(list, "candidate pairs")) << "1 candidate pairs";
}

TEST(Sweep, StandsAtTheLitBodyAndLinksWhatItCompares) {
  const Frame& frame = strip("sweep7");
  const DrawList list = samples::page_of(frame);
  EXPECT_TRUE(says(list, "sorted along x, then swept"));
  for (int i = 1; i <= 7; ++i) EXPECT_TRUE(says(list, std::to_string(i))) << "of the order";
  EXPECT_EQ(rects(list, Role::lit_fill).size(), 1u);
  std::size_t links = 0;
  for (const KeyedRun& run : list.runs)
    links += run.key.starts_with("sweep/") && run.key.find('-') != std::string::npos;
  EXPECT_EQ(links, frame.pairs.size());
}

}  // namespace
}  // namespace lantern::draw
