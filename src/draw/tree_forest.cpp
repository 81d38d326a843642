// A structure for what never moves beside the one for what does: two trees in one panel.
#include <algorithm>
#include <numeric>

#include "draw/panels.hpp"

namespace lantern {
namespace {

constexpr double kTreeHeading = 30;
constexpr double kBetween = 24;      // between two trees side by side
constexpr double kWideEnough = 1.5;  // aspect from which trees stand side by side

// The nodes below each root, numbered anew.
std::vector<Frame> trees_of(const Frame& frame) {
  std::vector<Frame> trees;
  std::vector<std::pair<std::size_t, std::uint32_t>> places;  // tree, and place in it
  for (const FrameNode& node : frame.nodes) {
    const bool root = node.parent == kNone;
    if (root) {
      trees.push_back({});
      Frame& tree = trees.back();
      tree.structure = frame.structure;
      tree.dimension = frame.dimension;
      tree.bounds = frame.bounds;
      tree.bodies = frame.bodies;
      tree.textures = frame.textures;
    }
    const std::size_t at = root ? trees.size() - 1 : places[node.parent].first;
    FrameNode copy = node;
    if (!root) copy.parent = places[node.parent].second;
    places.emplace_back(at, static_cast<std::uint32_t>(trees[at].nodes.size()));
    trees[at].nodes.push_back(std::move(copy));
  }
  return trees;
}

double share_of(const Frame& tree, bool beside) {
  std::size_t leaves = 0;
  std::uint32_t rows = 0;
  for (const FrameNode& node : tree.nodes) {
    leaves += node.leaf;
    rows = std::max(rows, node.depth + 1);
  }
  return beside ? std::min(static_cast<double>(leaves), 16.0) : std::min(rows, 6u);
}

// In parts by what each tree needs, but none below a quarter of an even part.
std::vector<Box<2>> cut(const std::vector<Frame>& trees, const Box<2>& area) {
  const Vec<2> size = area.size();
  const bool beside = size.x > kWideEnough * size.y;
  const int axis = beside ? 0 : 1;
  std::vector<double> shares;
  for (const Frame& tree : trees) shares.push_back(share_of(tree, beside));
  const double even =
      std::accumulate(shares.begin(), shares.end(), 0.0) / static_cast<double>(trees.size());
  for (double& share : shares) share = std::max(share, (beside ? 0.6 : 0.7) * even);
  return split(area, axis, shares, kBetween);
}

void draw_forest(const Frame& frame, const Box<2>& area, DrawList& list, Labels& labels) {
  constexpr std::size_t kMostTrees = 4;
  std::vector<Frame> trees = trees_of(frame);
  if (trees.size() > kMostTrees) trees.resize(kMostTrees);
  const std::vector<Box<2>> boxes = cut(trees, area);
  const TextStyle style{kLabel, Weight::semibold, Role::quiet_ink};
  for (std::size_t i = 0; i < trees.size(); ++i) {
    const bool of_static = trees[i].nodes[0].of_static;
    const Box<2>& box = boxes[i];
    const std::string heading =
        shortened(of_static ? "static: never moves" : "dynamic", box.size().x - 8, style);
    labels.add(heading, {{box.lo.x + 4, box.lo.y + 20}, 0}, style, box);
    if (i > 0 && boxes[0].lo.x < box.lo.x) {
      const double x = box.lo.x - kBetween / 2;
      list.crisp_line({x, box.lo.y}, {x, box.hi.y}, {Role::rule, 1.6});
    } else if (i > 0) {
      const double y = box.lo.y - kBetween / 2;
      list.crisp_line({box.lo.x, y}, {box.hi.x, y}, {Role::rule, 1.6});
    }
    draw_one_tree(trees[i], {box.lo + Vec<2>(0, kTreeHeading), box.hi}, list, labels);
  }
}

}  // namespace

void draw_tree(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels) {
  const double facts = draw_tree_facts(frame, panel, labels);
  Box<2> diagram = panel;
  diagram.hi.y -= facts + 4;
  if (frame.structure == StructureKind::sort_and_sweep && frame.nodes.empty())
    return draw_sweep(frame, shrunk(diagram, 6), list, labels);
  const auto roots = std::count_if(frame.nodes.begin(), frame.nodes.end(),
                                   [](const FrameNode& node) { return node.parent == kNone; });
  if (roots > 1) return draw_forest(frame, diagram, list, labels);
  draw_one_tree(frame, diagram, list, labels);
}

}  // namespace lantern
