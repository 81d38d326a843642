#include "draw/tree/tree_layout.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "base/words.hpp"
#include "draw/font.hpp"
#include "draw/panel.hpp"

namespace lantern::draw {
namespace {

// Trees of a few levels may be drawn larger than others.
constexpr double kScales[] = {1.8, 1.65, 1.5, 1.35, 1.2, 1.1, 1.0, 0.88, 0.76, 0.66, 0.57, 0.5};
constexpr double kLargest = 1.2;
constexpr std::uint32_t kFewLevels = 4;
// Of a condensed tree: the first is comfortable, the others are for ways that must be open.
constexpr double kFoldScales[] = {0.6, 0.5, 0.4, 0.3, 0.25};
// Of a tree that is shown whole though its words have no room.
constexpr double kSmallScales[] = {0.8,  0.66, 0.55, 0.48, 0.42,  0.36,  0.31,
                                   0.26, 0.22, 0.19, 0.16, 0.135, 0.115, 0.1};
constexpr double kLeastSmallRow = 17;  // from row to row
constexpr std::size_t kMostBranches = 300;
constexpr double kUnderLeaf = 34;    // for the label under the last row
constexpr double kBetweenRows = 38;  // at least; a leaf's label and an edge's elbow fit in
constexpr double kElbow = 8;         // over a box, clear of the card behind a pile
constexpr double kLeastFan = 34;     // height in which slanting edges are still told apart
constexpr double kLeastHeight = 30;  // of a box
constexpr std::uint32_t kLeastRows = 4;

double width_of(const Branch& branch, const FrameNode& node, bool atlas, const TreeScale& scale,
                const TreeWords& words) {
  if (scale.small) return scale.box_width;
  const BranchText content = text_of(branch, node, atlas, scale, words);
  if (branch.kind == Branch::Kind::levels)  // the text stands beside a line
    return 2 * (text_width(content.text, scale.text, Weight::regular) + 16);
  const auto icons = static_cast<double>(content.icons);
  double width = icons > 0 ? icons * (scale.icon + 5) - 5 : 0;
  if (!content.text.empty())
    width += text_width(content.text, scale.text, Weight::semibold) + (icons > 0 ? 6 : 0);
  return std::max(scale.box_width, width + 0.42 * scale.icon + 6);
}

// The largest count of as many digits, and of two at least.
std::uint32_t widest_count(std::uint32_t count) {
  return count < 100 ? 99 : count < 1000 ? 999 : std::max(count, 9999u);
}

// A tree to be laid out: its nodes, and what the group needs of room for each.
struct Wanted {
  const std::vector<FrameNode>& nodes;
  const std::vector<std::string>& ways;
  const UnionTree& tree;
  bool atlas = false;

  // Room for all that the branch shows on any frame.
  double width(const Branch& branch, const TreeScale& scale, const TreeWords& words) const {
    const FrameNode& node = nodes[branch.node];
    if (branch.kind != Branch::Kind::node || branch.copies > 1) {
      Branch widest = branch;
      if (branch.kind != Branch::Kind::levels) widest.count = widest_count(branch.count);
      return width_of(widest, node, atlas, scale, words);
    }
    const UnionNode* all = tree.find(ways[branch.node]);
    double width = all ? 0 : width_of(branch, node, atlas, scale, words);
    if (all)
      for (const FrameNode& form : all->shown)
        width = std::max(width, width_of(branch, form, atlas, scale, words));
    return width;
  }
};

std::uint32_t row_count(const std::vector<Branch>& branches) {
  return branches.empty() ? 0 : std::ranges::max(branches, {}, &Branch::row).row + 1;
}

// That a panel of this height has room for; on a very low one rows stand closer.
std::uint32_t most_rows(double height) {
  const double rows = (height - kUnderLeaf + kBetweenRows) / (kLeastHeight + kBetweenRows);
  return static_cast<std::uint32_t>(std::clamp(rows, double(kLeastRows), 1000.0));
}

double full_height(double s) { return 50 * s; }

struct Spread {
  std::vector<double> x, widths;
  double width = 0;
};

Spread spread(const std::vector<Branch>& branches, const Wanted& wanted, const TreeScale& scale,
              const TreeWords& words) {
  Spread s;
  std::vector<TidyNode> nodes;
  for (const Branch& branch : branches) {
    nodes.push_back({branch.parent, wanted.width(branch, scale, words)});
    s.widths.push_back(nodes.back().width);
  }
  s.x = tidy_tree(nodes, scale.gap);
  for (std::size_t i = 0; i < s.x.size(); ++i)
    s.width = std::max(s.width, s.x[i] + s.widths[i] / 2);
  return s;
}

// Do they fit at scale `s`, whose measures are those of `rows` rows?
bool fits(const std::vector<Branch>& branches, const Wanted& wanted, const Vec<2>& room, double s,
          std::uint32_t rows, const TreeWords& words = {}, bool small = false) {
  const bool low = small ? rows * kLeastSmallRow + kUnderLeaf <= room.y
                         : row_count(branches) <= most_rows(room.y);
  if (branches.size() > kMostBranches || !low) return false;
  const TreeScale scale(s, rows, room.y, small);
  if (s > kLargest) {
    const double airy = (2 * rows - 1) * full_height(s) + scale.under;
    if (rows > kFewLevels || airy > room.y) return false;
  }
  return spread(branches, wanted, scale, words).width <= room.x;
}

// As many words as there is room for without drawing anything smaller.
TreeWords best_words(const std::vector<Branch>& branches, const Wanted& wanted,
                     const TreeStage& stage) {
  for (const TreeWords words : {TreeWords{true, true}, {false, true}, {true, false}})
    if (fits(branches, wanted, stage.panel.size(), stage.scale, stage.rows, words)) return words;
  return {};
}

// The largest scale at which they fit; 0 if none.
double best_scale(const std::vector<Branch>& branches, const Wanted& wanted, const Vec<2>& room,
                  bool small = false) {
  for (const double s : small ? std::span<const double>(kSmallScales) : kScales)
    if (fits(branches, wanted, room, s, row_count(branches), {}, small)) return s;
  return 0;
}

// Condensed until it fits; on a narrow panel levels are left out one after another.
std::vector<Branch> condensed(const TreeFold& fold, const Wanted& wanted, const TreeStage& stage) {
  std::vector<Branch> branches;
  const Vec<2> room = stage.panel.size();
  const auto has_room = [&](const std::vector<Branch>& tried) {
    return fits(tried, wanted, room, stage.scale, stage.rows);
  };
  for (std::uint32_t rows = std::max(stage.rows, kLeastRows); rows >= kLeastRows; --rows) {
    branches = fold.condensed(rows, has_room);
    if (has_room(branches)) break;
  }
  return branches;
}

// How wide a text centred under each branch may be: it keeps clear of the places of its neighbours'
// labels and of the edges that lead down from them.
std::vector<double> label_rooms(const TreeLayout& layout, const Wanted& wanted,
                                const Box<2>& panel) {
  constexpr double kBesideEdge = 8, kBesideLabel = 4;
  const std::vector<Branch>& branches = layout.branches;
  std::vector<bool> open(branches.size());
  for (const Branch& other : branches)
    if (other.parent != kNone) open[other.parent] = true;
  std::vector<double> rooms;
  for (std::size_t k = 0; k < branches.size(); ++k) {
    const double center = layout.boxes[k].center().x;
    double room = std::min(center - panel.lo.x, panel.hi.x - center);
    for (std::size_t i = 0; i < branches.size(); ++i) {
      if (i == k || branches[i].row != branches[k].row) continue;
      const double away = std::abs(layout.boxes[i].center().x - center);
      if (open[i]) room = std::min(room, away - kBesideEdge);
      if (has_label_below(branches[i], wanted.nodes[branches[i].node], layout.scale))
        room = std::min(room, away / 2 - kBesideLabel);
    }
    rooms.push_back(2 * room);
  }
  return rooms;
}

// Rows as far apart as the panel allows, in its middle. The root stands over the panel's middle
// where the tree does not show all of its nodes: these come and go, and it must stand still.
void place(const Wanted& wanted, const TreeStage& stage, TreeLayout& layout) {
  const Box<2>& panel = stage.panel;
  layout.scale = TreeScale(stage.scale, stage.rows, panel.size().y, stage.small);
  if (stage.alone && !stage.small) layout.words = best_words(layout.branches, wanted, stage);
  const Spread sideways = spread(layout.branches, wanted, layout.scale, layout.words);
  const double around = layout.scale.box_height + layout.scale.under;
  const double most = 190 * std::max(1.0, stage.scale / kLargest);
  const double gaps = std::max(1.0, stage.rows - 1.0);
  const double pitch = std::min(most, (panel.size().y - around) / gaps);
  const double spare = panel.size().y - (stage.rows - 1.0) * pitch - around;
  const double left = panel.center().x - sideways.width / 2;
  const double top = panel.lo.y + std::max(spare / 2, 0.0);
  for (std::size_t i = 0; i < layout.branches.size(); ++i) {
    const bool centred = i == 0 && !stage.whole;
    const Vec<2> center{centred ? panel.center().x : left + sideways.x[i],
                        top + layout.branches[i].row * pitch + layout.scale.box_height / 2};
    layout.boxes.push_back(
        Box<2>::around(center, Vec<2>(sideways.widths[i], layout.scale.box_height) * 0.5));
  }
  std::vector<bool> labelled(row_count(layout.branches));
  for (const Branch& branch : layout.branches)
    if (has_label_below(branch, wanted.nodes[branch.node], layout.scale))
      labelled[branch.row] = true;
  layout.labels_between = !stage.whole && !stage.alone;
  for (const Branch& branch : layout.branches)
    if (branch.row > 0 && labelled[branch.row - 1]) layout.labels_between = true;
  layout.room_between = pitch >= layout.scale.box_height + kBetweenRows - 1;
  layout.last_row = std::max(stage.rows, 1u) - 1;
  layout.room = label_rooms(layout, wanted, panel);
}

std::vector<FrameNode> nodes_of(const UnionTree& tree) {
  std::vector<FrameNode> nodes;
  for (const UnionNode& node : tree.nodes) {
    nodes.push_back(node.node);
    // Somewhere it is a leaf, and then its label needs a place.
    for (const FrameNode& form : node.shown) nodes.back().leaf = nodes.back().leaf || form.leaf;
  }
  return nodes;
}

std::vector<std::string> all_ways(const UnionTree& tree) {
  return mapped(tree.nodes, &UnionNode::way);
}

// The largest scale at which on every frame all that is lit can be seen.
double fold_scale(const UnionTree& tree, const std::vector<TreeOfFrame>& trees, bool atlas,
                  std::uint32_t rows, const Vec<2>& room) {
  const double smallest = std::end(kFoldScales)[-1];
  std::size_t at = 0;
  for (const TreeOfFrame& of : trees) {
    if (of.nodes.empty()) continue;
    const std::vector<std::string> ways = ways_of(of.nodes);
    const Wanted wanted{of.nodes, ways, tree, atlas};
    const std::vector<Branch> least = TreeFold(of.nodes, atlas, of.hits).least(rows);
    // What does not fit at all shall not make the others small.
    if (!fits(least, wanted, room, smallest, rows)) continue;
    while (!fits(least, wanted, room, kFoldScales[at], rows)) ++at;
  }
  return kFoldScales[at];
}

}  // namespace

TreeScale::TreeScale(double s, std::uint32_t rows, double height, bool is_small)
    : small(is_small),
      box_width(std::max(kLeastNode, 84 * s)),
      box_height(std::clamp((height - kUnderLeaf - kBetweenRows * (rows - 1)) / rows, kLeastHeight,
                            std::max(kLeastHeight, full_height(s)))),
      gap(std::max(9.0, 34 * s)),
      icon(std::min(std::max(18.0, 31 * s), box_height - 8)),
      radius(std::max(6.0, 9 * s)),
      text(std::clamp(20 * s, kLeastLabel, 30.0)),
      label(kLeastLabel),
      under(kUnderLeaf) {
  if (!small) return;
  box_width = 84 * s;
  gap = std::max(2.5, 0.3 * box_width);
  box_height = std::clamp(0.5 * (height - under) / rows, 8.0, 1.15 * box_width);
  icon = std::min(box_width, box_height) - 5;
  radius = 0.16 * box_width;
}

std::string short_label(const std::string& label) {
  const std::size_t dot = label.rfind('.');
  return dot == std::string::npos ? std::string() : "…" + node_words(label.substr(dot + 1));
}

bool is_long_way(const std::string& label) { return std::ranges::count(label, '.') > 2; }

bool has_label_below(const Branch& branch, const FrameNode& node, const TreeScale& scale) {
  if (!scale.names_all()) return node.leaf && (branch.mark == Mark::lit || node.over_capacity);
  if (branch.kind == Branch::Kind::folded) return true;
  if (branch.kind != Branch::Kind::node || !node.leaf) return false;
  return !node.label.empty() || branch.copies > 1 || node.over_capacity;
}

std::vector<Vec<2>> TreeLayout::edge(std::size_t branch) const {
  const Box<2>& above = boxes[branches[branch].parent];
  const Vec<2> from{above.center().x, above.hi.y};
  const Vec<2> to{boxes[branch].center().x, boxes[branch].lo.y};
  if (scale.small && from.x != to.x) {
    const double y = std::round(to.y - 0.45 * (to.y - from.y));
    return {from, {from.x, y}, {to.x, y}, to};
  }
  if (!labels_between) return {from, to};
  const double fan = from.y + scale.under;
  if (to.y - fan >= kLeastFan) return {from, {from.x, fan}, to};
  const double elbow = to.y - std::min(kElbow, (to.y - from.y) / 2);
  return {from, {from.x, elbow}, {to.x, elbow}, to};
}

BranchText text_of(const Branch& branch, const FrameNode& node, bool atlas, const TreeScale& scale,
                   const TreeWords& words) {
  const auto times = [&](std::size_t count) {
    return branch.each && words.each ? say("×{} each", count) : fmt::format("×{}", count);
  };
  using Kind = Branch::Kind;
  if (branch.kind == Kind::empties) return {times(branch.count), 0};
  if (branch.kind == Kind::folded)
    return {words.nodes ? say("+{} nodes", branch.count) : fmt::format("+{}", branch.count), 0};
  if (branch.kind == Kind::levels) return {say("{} levels", branch.count), 0};
  if (scale.small) return {};
  if (!node.leaf) {
    if (branch.copies > 1) return {times(branch.copies), 0};
    if (atlas) return {};  // an atlas's inner node shows its cut
    const bool named = node.plane && !node.plane_name.empty();
    const TextStyle style{scale.text, Weight::semibold, Role::ink};
    const std::string text = named ? word(node.plane_name) : node_words(node.label);
    const double width = std::max(1.3 * scale.box_width, named ? 150.0 : 62.0);
    const std::string brief = short_label(node.label);
    const bool use_brief =
        !named && !brief.empty() && (is_long_way(node.label) || text_width(text, style) > width);
    return {shortened(use_brief ? brief : text, width, style), 0};
  }
  if (atlas && node.bodies.empty() && node.label.empty()) {
    std::string free = word("free");
    const double width = text_width(free, scale.text, Weight::regular);
    return {width + 8 <= scale.box_width ? std::move(free) : "", 0};
  }
  const std::size_t most = 4, bodies = node.bodies.size();
  if (bodies <= most) return {"", bodies};
  return {fmt::format("+{}", bodies - (most - 1)), most - 1};
}

TreeStage stage_tree(const UnionTree& tree, const std::vector<TreeOfFrame>& trees, bool atlas,
                     const Box<2>& panel) {
  TreeStage stage{.panel = panel, .alone = trees.size() == 1};
  const Vec<2> room = panel.size();
  if (tree.complete && tree.nodes.size() <= kMostBranches) {
    const std::vector<FrameNode> nodes = nodes_of(tree);
    const std::vector<std::string> ways = all_ways(tree);
    const Wanted wanted{nodes, ways, tree, atlas};
    std::vector<Branch> branches = TreeFold(nodes, atlas, {}).whole();
    double s = best_scale(branches, wanted, room);
    stage.small = s == 0;
    if (stage.small) s = best_scale(branches, wanted, room, true);
    if (s > 0) {
      stage.scale = s;
      stage.rows = tree.rows();
      stage.whole = true;
      stage.all.branches = std::move(branches);
      place(wanted, stage, stage.all);
      return stage;
    }
  }
  stage.small = false;
  stage.rows = std::min(tree.rows(), most_rows(room.y));
  stage.scale = fold_scale(tree, trees, atlas, stage.rows, room);
  return stage;
}

TreeLayout lay_out_tree(const Frame& frame, const UnionTree& tree, const TreeStage& stage) {
  if (frame.nodes.empty()) return {};
  const TreeFold fold(frame);
  const std::vector<std::string> ways = ways_of(frame.nodes);
  const Wanted wanted{frame.nodes, ways, tree, !frame.get<FrameTextures>().textures.empty()};
  TreeLayout layout;
  if (stage.whole) layout = stage.all;
  layout.branches = stage.whole ? fold.whole() : condensed(fold, wanted, stage);
  for (const Branch& branch : layout.branches) layout.ways.push_back(ways[branch.node]);
  if (!stage.whole) {
    place(wanted, stage, layout);
    return layout;
  }
  layout.boxes.clear();
  layout.room.clear();
  for (const std::string& way : layout.ways) {
    const std::uint32_t i = tree.index.at(way);
    layout.boxes.push_back(stage.all.boxes[i]);
    layout.room.push_back(stage.all.room[i]);
  }
  return layout;
}

double tree_size_in(const Staging& staging, const Box<2>& panel) {
  constexpr double kFolded = 0.5;  // a condensed tree uses whatever room it gets, and shows less
  constexpr double kLarge = 1.35;  // scale from which a tree need not grow
  const Vec<2> room = panel.size();
  const double folded = kFolded * std::sqrt(room.x * room.y);
  if (staging.trees().size() != 1) return folded;
  const UnionTree& tree = staging.trees()[0];
  if (!tree.complete || tree.nodes.size() > kMostBranches) return folded;
  const std::vector<FrameNode> nodes = nodes_of(tree);
  const std::vector<std::string> ways = all_ways(tree);
  const Wanted wanted{nodes, ways, tree,
                      !staging.frames()[0]->get<FrameTextures>().textures.empty()};
  const std::vector<Branch> branches = TreeFold(nodes, wanted.atlas, {}).whole();
  const double s = best_scale(branches, wanted, room);
  if (s == 0) return folded;  // or small
  const double width = spread(branches, wanted, TreeScale(1, tree.rows(), room.y), {}).width;
  // Rows come first: where they stand closer than their labels need, the tree is hard to read.
  constexpr double kAround = 16, kFacts = 36;  // margins, and the line of counts under the tree
  const double least = kUnderLeaf + kLeastHeight * tree.rows() + kBetweenRows * (tree.rows() - 1) +
                       kAround + (staging.frames()[0]->get<FrameSide>().name.empty() ? kFacts : 0);
  const double squeezed = std::min(1.0, room.y / least);
  const double size =
      squeezed * squeezed * std::min(s, kLarge) * std::sqrt(width * tree.rows() * 110);
  return std::max(squeezed * squeezed * folded, std::min(size, std::sqrt(room.x * room.y)));
}

}  // namespace lantern::draw
