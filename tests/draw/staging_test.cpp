// What has not changed does not move, on every frame of every scenario.
#include "draw/staging.hpp"

#include <map>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "draw/labels.hpp"
#include "draw/page.hpp"
#include "draw/sample_frames.hpp"
#include "draw/tree/tree_layout.hpp"
#include "frame/parts/panels.hpp"
#include "scenario/directing.hpp"

namespace lantern::draw {
namespace {

constexpr std::uint32_t kMostLit = 9;  // leaves
const Box<2> kTreePanel{{0, 0}, {700, 560}};

// The frames of a run, cut into the groups that share a layout.
std::vector<std::vector<Frame>> groups_of(const std::string& scenario) {
  std::vector<std::vector<Frame>> groups;
  const std::vector<Frame> frames = run::frames_of(scenario);
  for (std::span<const Frame> rest = frames; !rest.empty();) {
    const std::span<const Frame> group = Staging::first_group(rest);
    groups.emplace_back(group.begin(), group.end());
    rest = rest.subspan(group.size());
  }
  return groups;
}

// Long runs are looked at frame by frame for the first few, then here and there.
bool is_looked_at(std::size_t i) { return i < 10 || i % 37 == 0; }

class EverySequence : public testing::TestWithParam<std::string> {};

// By way: the box of each node that stands for itself, and by which marks the tree is folded.
struct PlacedTree {
  std::map<std::string, Box<2>> boxes;
  std::vector<std::tuple<int, std::string, std::uint32_t>> folding;
};

PlacedTree placed(const Frame& frame, const UnionTree& tree, const TreeStage& stage) {
  PlacedTree found;
  const TreeLayout layout = lay_out_tree(frame, tree, stage);
  for (std::size_t i = 0; i < layout.branches.size(); ++i) {
    const Branch& b = layout.branches[i];
    if (b.kind == Branch::Kind::node) found.boxes[layout.ways[i]] = layout.boxes[i];
    found.folding.emplace_back(static_cast<int>(b.kind), layout.ways[i], b.copies);
  }
  return found;
}

// No folded mark stands for a lit node that is not the mark's own, unless there are more than the
// panel has room for.
void expect_lit_are_open(const Frame& frame, const TreeLayout& layout) {
  const TreeFold fold(frame);
  std::set<std::uint32_t> shown;
  std::vector<bool> open(frame.nodes.size());
  for (const Branch& b : layout.branches) {
    if (b.copies > 1 || b.kind == Branch::Kind::empties || b.kind == Branch::Kind::levels) return;
    if (b.copies == 1) shown.insert(b.node);
  }
  std::uint32_t lit = 0;
  for (std::uint32_t i = 0; i < frame.nodes.size(); ++i)
    lit += frame.nodes[i].leaf && fold.must_be_seen(i);
  if (lit > kMostLit) return;
  for (std::uint32_t i = 0; i < frame.nodes.size(); ++i)
    EXPECT_TRUE(!fold.must_be_seen(i) || shown.contains(i))
        << frame.scenario << ", frame " << frame.index << ": " << frame.nodes[i].label
        << " is lit and folded away";
}

TEST_P(EverySequence, NodesStandStillAndLitOnesAreOpen) {
  for (const std::vector<Frame>& group : groups_of(GetParam())) {
    const Staging staging{std::span<const Frame>(group)};
    if (staging.trees().size() != 1 || !group[0].sides.empty()) continue;
    const UnionTree& tree = staging.trees()[0];
    std::vector<TreeOfFrame> trees;
    for (const Frame& frame : group) trees.push_back({frame.nodes, frame.get<FrameFinding>().hits});
    const TreeStage stage =
        stage_tree(tree, trees, !group[0].get<FrameTextures>().textures.empty(), kTreePanel);
    PlacedTree before;
    for (std::size_t i = 0; i < group.size(); ++i) {
      if (!is_looked_at(i) || group[i].nodes.empty()) continue;
      const PlacedTree now = placed(group[i], tree, stage);
      if (!stage.whole) expect_lit_are_open(group[i], lay_out_tree(group[i], tree, stage));
      for (const auto& [way, box] : now.boxes) {
        const auto was = before.boxes.find(way);
        const bool same = stage.whole || now.folding == before.folding || way == "root";
        if (was == before.boxes.end() || !same) continue;
        EXPECT_TRUE(was->second.lo == box.lo && was->second.hi == box.hi)
            << GetParam() << ", frame " << group[i].index << ": " << way << " moved";
      }
      before = now;
    }
  }
}

// Nothing that is read is too small for the last row, and nothing covers anything.
TEST_P(EverySequence, TypeIsLargeEnoughAndLabelsAreApart) {
  for (const std::vector<Frame>& group : groups_of(GetParam())) {
    const Staging staging{std::span<const Frame>(group)};
    for (std::size_t i = 0; i < group.size(); ++i) {
      if (!is_looked_at(i)) continue;
      Work work;
      const DrawList list = draw_frame(group[i], staging, page_for(1600, 900), work);
      const std::string where = fmt::format("{}, frame {}", GetParam(), group[i].index);
      for (const DrawShape& shape : list.shapes)
        if (const auto* text = std::get_if<TextShape>(&shape)) {
          EXPECT_GE(text->size, 24 - 0.01) << where << ": '" << text->text << "'";
        }
      for (std::size_t a = 0; a < list.labels.size(); ++a) {
        EXPECT_TRUE(holds(shrunk(list.labels[a].panel, -0.01), list.labels[a].box))
            << where << ": '" << list.labels[a].text << "' leaves its panel";
        for (std::size_t b = a + 1; b < list.labels.size(); ++b)
          EXPECT_FALSE(overlap(shrunk(list.labels[a].box, 0.01), shrunk(list.labels[b].box, 0.01)))
              << where << ": '" << list.labels[a].text << "' covers '" << list.labels[b].text
              << "'";
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, EverySequence, testing::ValuesIn(run::all_scenarios()),
                         [](const auto& each) { return each.param; });

TEST(Staging, AGroupEndsWhereItsPanelsOrSettingsChange) {
  Frame a = samples::ghosts(3), b = samples::ghosts(4);
  EXPECT_TRUE(Staging::is_one_group(a, b));
  b.part = "another part";
  EXPECT_TRUE(Staging::is_one_group(a, b)) << "a part alone moves nothing";
  b.add<FrameStructure>().settings = "capacity 9";
  EXPECT_FALSE(Staging::is_one_group(a, b));
  b = a;
  b.panels = {panel_named("world")};
  EXPECT_FALSE(Staging::is_one_group(a, b));
  const std::vector<Frame> frames{a, a, b};
  EXPECT_EQ(Staging::first_group(frames).size(), 2u);
  EXPECT_EQ(Staging::first_group(std::span(frames).subspan(2)).size(), 1u);
}

TEST(Staging, KnowsWhatAnyFrameHas) {
  std::vector<Frame> frames{samples::ghosts(2), samples::ghosts(4)};
  for (Frame& frame : frames) frame.add<FrameChart>().y_name = "pairs";
  frames[0].add<FrameChart>().series = {{"pairs", {{0, 5}}, 0}};
  frames[1].add<FrameChart>().series = {{"pairs", {{2, -1}}, 0}};
  frames[0].index = 0;
  frames[1].index = 1;
  const Staging staging{std::span<const Frame>(frames)};
  ASSERT_EQ(staging.trees().size(), 1u);
  EXPECT_EQ(staging.trees()[0].nodes.size(), frames[1].nodes.size());
  EXPECT_EQ(staging.most("nodes"), 9);
  EXPECT_TRUE(staging.tells_settings(frames[0]));
  EXPECT_FALSE(staging.tells_settings(frames[1]));
  AxisRanges axes;
  for (const Frame& frame : frames) axes.see(frame);
  ASSERT_TRUE(axes.chart() && axes.chart_x());
  EXPECT_EQ(axes.chart_x()->second, 2);
  EXPECT_EQ(*axes.chart(), std::pair(-1.0, 5.0));
}

TEST(Staging, OfManyBodiesOnlyThoseOfTheStoryAreNamed) {
  Frame frame = samples::crowd(9, 0.5);
  for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
    frame.bodies[i].name = fmt::format("crate {}", i);
    frame.bodies[i].lit = i == 3;
  }
  frame.caption = frame.bodies[5].name + " falls";
  for (std::size_t i = 0; i < frame.bodies.size(); ++i)
    EXPECT_EQ(shows_name(frame, frame.bodies[i]), i == 3 || i == 5) << frame.bodies[i].name;
}

}  // namespace
}  // namespace lantern::draw
