#include "draw/tree/tree_fold.hpp"

#include <gtest/gtest.h>

#include "draw/page.hpp"
#include "draw/panel.hpp"
#include "draw/sample_frames.hpp"
#include "draw/tree/tree_layout.hpp"

namespace lantern::draw {
namespace {

using Kind = Branch::Kind;

// The nodes that a diagram stands for, from the leaves up.
std::uint64_t stands_for(const std::vector<Branch>& branches) {
  std::vector<std::uint64_t> nodes(branches.size());
  for (std::size_t i = branches.size(); i-- > 0;) {
    const Branch& b = branches[i];
    if (b.kind == Kind::node) nodes[i] = b.copies * (nodes[i] + 1);
    if (b.kind == Kind::empties) nodes[i] = b.count;
    if (b.kind == Kind::folded) nodes[i] = b.count + (b.copies > 0 ? 1 : 0);
    if (b.parent != kNone) nodes[b.parent] += nodes[i];
  }
  return nodes[0];
}

bool has(const std::vector<Branch>& branches, Kind kind) {
  return std::any_of(branches.begin(), branches.end(),
                     [&](const Branch& b) { return b.kind == kind; });
}

// Of a frame that stands alone.
TreeLayout lay_out_alone(const Frame& frame, const Box<2>& panel) {
  const Staging staging(frame);
  const UnionTree& tree = staging.trees()[0];
  const bool atlas = !frame.get<FrameTextures>().textures.empty();
  return lay_out_tree(
      frame, tree, stage_tree(tree, {{frame.nodes, frame.get<FrameFinding>().hits}}, atlas, panel));
}

std::vector<Frame> trees() {
  std::vector<Frame> frames{samples::crowd(500, 0.8), samples::crowd(5000, 0.2),
                            samples::atlas(60, 60), samples::ghosts(4)};
  for (const std::uint32_t depth : {4, 6, 8, 9}) frames.push_back(samples::coincident(depth));
  return frames;
}

TEST(TreeFold, WholeTreeIsWhole) {
  for (const Frame& frame : trees())
    EXPECT_EQ(stands_for(TreeFold(frame).whole()), frame.nodes.size());
}

TEST(TreeFold, CountsEveryNodeOnce) {
  for (const Frame& frame : trees())
    for (const std::size_t most : {10u, 30u, 90u, 300u}) {
      const auto branches = TreeFold(frame).condensed(
          40, [&](const std::vector<Branch>& tried) { return tried.size() <= most; });
      ASSERT_FALSE(has(branches, Kind::levels));
      EXPECT_EQ(stands_for(branches), frame.nodes.size())
          << frame.title << ": the counts on the marks do not add up";
    }
}

TEST(TreeFold, KeepsTheLitPathOpen) {
  for (const Frame& frame : trees()) {
    std::uint32_t deepest = 0;
    for (const FrameNode& node : frame.nodes)
      if (node.mark == Mark::lit) deepest = std::max(deepest, node.depth);
    if (deepest == 0) continue;
    for (const std::uint32_t rows : {4u, 6u, 9u, 40u}) {
      const auto branches = TreeFold(frame).condensed(
          rows, [](const std::vector<Branch>& b) { return b.size() < 24; });
      EXPECT_TRUE(std::any_of(branches.begin(), branches.end(),
                              [&](const Branch& b) {
                                const FrameNode& node = frame.nodes[b.node];
                                return b.kind == Kind::node && node.mark == Mark::lit &&
                                       node.depth == deepest;
                              }))
          << frame.title << ": what the step is about is folded away, " << rows << " rows";
      for (const Branch& b : branches) EXPECT_LT(b.row, rows);
    }
  }
}

TEST(TreeFold, FoldsEqualSubtreesAndEmptyLeavesOfOneParent) {
  const Frame frame = samples::coincident(4);
  const auto branches = TreeFold(frame).condensed(9, [](const auto&) { return true; });
  EXPECT_TRUE(has(branches, Kind::empties));
  EXPECT_FALSE(has(branches, Kind::folded)) << "all was allowed, so nothing may stay closed";
  EXPECT_TRUE(std::any_of(branches.begin(), branches.end(),
                          [](const Branch& b) { return b.kind == Kind::node && b.copies > 1; }));
}

TEST(TreeLayout, NodesNeverOverlapNorShrinkBelowLegibility) {
  const Box<2> panels[] = {{{0, 0}, {740, 580}}, {{0, 0}, {420, 500}}, {{0, 0}, {1000, 250}}};
  for (const Frame& frame : trees())
    for (const Box<2>& panel : panels) {
      const TreeLayout layout = lay_out_alone(frame, panel);
      ASSERT_FALSE(layout.boxes.empty());
      EXPECT_LE(layout.boxes.size(), 300u) << "the cost of a diagram must not grow with the tree";
      for (std::size_t i = 0; i < layout.boxes.size(); ++i) {
        const Box<2>& box = layout.boxes[i];
        EXPECT_GE(box.size().x, layout.scale.small ? kLeastSmallNode : kLeastNode) << frame.title;
        EXPECT_TRUE(holds(shrunk(panel, -0.01), box)) << frame.title << " leaves its panel";
        for (std::size_t j = i + 1; j < layout.boxes.size(); ++j)
          EXPECT_FALSE(overlap(box, layout.boxes[j])) << frame.title << ": " << i << ", " << j;
      }
    }
}

// Whether the segment comes into the box, in small steps.
bool strikes(const Vec<2>& from, const Vec<2>& to, const Box<2>& box) {
  if (!overlap(Box<2>{glm::min(from, to), glm::max(from, to)}, box)) return false;
  for (int k = 0; k <= 2000; ++k)
    if (holds(box, Box<2>::around(from + (to - from) * (k / 2000.0), Vec<2>(0.0)))) return true;
  return false;
}

void check_edges(const Box<2>& panel) {
  for (const Frame& frame : trees()) {
    DrawList list;
    Labels labels(list);
    draw_tree(frame, Staging(frame), panel, list, labels);
    std::size_t edges = 0;
    for (const DrawShape& shape : list.shapes) {
      if (std::holds_alternative<RectShape>(shape)) break;  // edges come before all boxes
      if (!std::holds_alternative<LineShape>(shape)) continue;
      const auto& edge = std::get<LineShape>(shape);
      ++edges;
      for (const LabelBox& label : list.labels)
        EXPECT_FALSE(strikes(edge.from, edge.to, shrunk(label.box, 1)))
            << frame.title << ": an edge runs through \"" << label.text << '"';
    }
    EXPECT_GT(edges, 0u) << frame.title;
  }
}

TEST(TreeView, EdgesStrikeNoLabel) {
  check_edges({{0, 0}, {740, 580}});
  check_edges({{0, 0}, {740, 260}});
  check_edges({{0, 0}, {740, 220}});
}

TEST(TreeView, CountsStandWhereTheyDidAndInFrontOfNothing) {
  const Box<2> panel{{0, 0}, {740, 580}};
  std::vector<Frame> frames(2, trees()[0]);
  frames[0].counts = {{"nodes", 5}, {"leaves", 4}, {"entries", 7}};
  frames[1].counts = {{"nodes", 125}, {"leaves", 94}, {"entries", 7}};
  frames[0].caption = "These are 5 nodes.";
  const Staging staging(frames);
  double entries = 0;
  for (const Frame& frame : frames) {
    DrawList list;
    Labels labels(list);
    draw_tree(frame, staging, panel, list, labels);
    const auto starts = [&](const std::string& text) {
      const auto found = std::ranges::find(list.labels, text, &LabelBox::text);
      EXPECT_NE(found, list.labels.end()) << text;
      return found == list.labels.end() ? 0 : found->box.lo.x;
    };
    EXPECT_LT(starts(&frame == &frames[0] ? "5" : "125"), panel.lo.x + 3)
        << "they begin at the left";
    EXPECT_GT(starts("nodes"), panel.lo.x);
    if (entries != 0) {
      EXPECT_NEAR(starts("7"), entries, 1e-9);
    }
    entries = starts("7");
  }
}

TEST(TreeLayout, ShowsAllNodesAsSquaresWhereWordsHaveNoRoom) {
  const Frame frame = samples::coincident(4);
  const TreeLayout layout = lay_out_alone(frame, {{0, 0}, {420, 500}});
  EXPECT_TRUE(layout.scale.small);
  EXPECT_EQ(layout.branches.size(), frame.nodes.size());
}

TEST(TreeLayout, SquaresStayWhereTheyAreWhileTheTreeGrows) {
  const std::vector<Frame> frames{samples::coincident(2), samples::coincident(4)};
  const Staging staging(frames);
  const UnionTree& tree = staging.trees()[0];
  const TreeStage stage =
      stage_tree(tree, {{frames[0].nodes, {}}, {frames[1].nodes, {}}}, false, {{0, 0}, {420, 500}});
  const TreeLayout few = lay_out_tree(frames[0], tree, stage),
                   many = lay_out_tree(frames[1], tree, stage);
  ASSERT_TRUE(many.scale.small);
  ASSERT_LT(few.ways.size(), many.ways.size());
  for (std::size_t i = 0; i < few.ways.size(); ++i) {
    const auto same = std::ranges::find(many.ways, few.ways[i]) - many.ways.begin();
    EXPECT_EQ(few.boxes[i].lo, many.boxes[std::size_t(same)].lo) << few.ways[i];
  }
}

TEST(TreeView, LightsTheWholeWayDown) {
  Frame frame = samples::ghosts(4);
  for (FrameNode& node : frame.nodes) node.mark = Mark::quiet;
  const auto lit_edges = [&] {
    DrawList list;
    Labels labels(list);
    draw_tree(frame, Staging(frame), {{0, 0}, {740, 580}}, list, labels);
    std::set<std::string> edges;
    for (std::size_t i = 0; i < list.runs.size(); ++i)
      if (list.runs[i].key.starts_with("tree/edge/") && list.runs[i].first < list.shapes.size())
        if (const auto* line = std::get_if<LineShape>(&list.shapes[list.runs[i].first]))
          if (line->stroke.role == Role::lit) edges.insert(list.runs[i].key);
    return edges.size();
  };
  EXPECT_EQ(lit_edges(), 0u);
  for (std::uint32_t i = 0; i < frame.nodes.size(); ++i) {
    if (frame.nodes[i].depth != 2) continue;
    frame.nodes[i].mark = Mark::lit;
    frame.nodes[frame.nodes[i].parent].mark = Mark::passed;
    break;
  }
  EXPECT_EQ(lit_edges(), 2u);
}

TEST(TreeLayout, SmallTreesAreNotFolded) {
  const TreeLayout layout = lay_out_alone(samples::ghosts(4), {{0, 0}, {740, 580}});
  EXPECT_EQ(layout.branches.size(), 9u);
}

}  // namespace
}  // namespace lantern::draw
