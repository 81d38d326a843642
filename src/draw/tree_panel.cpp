// The panel of a structure: its trees, and under them what it was told and what it counts. A
// structure for what never moves beside the one for what does makes two trees; sort and sweep has
// none and shows its intervals.
#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

#include "draw/font.hpp"
#include "draw/panels.hpp"

namespace lantern::draw {
namespace {

// One fact of the line under the diagram: words, or a number and what it counts.
struct Fact {
  std::string words;
  std::optional<std::int64_t> number = std::nullopt;
  std::string widest = {};  // that the words can get
  bool first_count = false;
};

struct Spacing {
  double gap = 0;             // between two facts
  bool counts_apart = false;  // counts begin a line of their own
};

std::vector<Fact> facts_of(const Frame& frame) {
  std::vector<Fact> facts;
  if (!frame.side.empty()) return facts;  // its title and its counts say it
  const std::size_t told = frame.display.settings ? frame.settings.size() : 0;
  for (std::size_t at = 0; at < told;) {
    const std::size_t comma = std::min(frame.settings.find(", ", at), frame.settings.size());
    facts.push_back({.words = frame.settings.substr(at, comma - at)});
    at = comma + 2;
  }
  const std::pair<const char*, const char*> counted[] = {
      {"nodes", "node"}, {"leaves", "leaf"}, {"entries", "entry"}};
  for (const auto& [many, one] : counted)
    if (const auto n = frame.count(many))
      facts.push_back({*n == 1 ? one : many, n, many, facts.empty() || !facts.back().number});
  return facts;
}

constexpr double kFactLine = 30;

// Lays the facts out in lines and draws them when `labels` is given; gives the number of lines.
// Counts have cells for two digits at least, so that nothing moves while a small tree grows.
int lay_out_facts(const std::vector<Fact>& facts, const Box<2>& panel, const Spacing& spacing,
                  double top, Labels* labels) {
  const TextStyle style{kLabel, Weight::regular, Role::quiet_ink};
  constexpr double kSpace = 6;
  double x = panel.lo.x;
  int line = 0;
  for (const Fact& fact : facts) {
    double number = 0;  // room for it
    if (fact.number) {
      const auto digits = static_cast<std::int64_t>(std::to_string(*fact.number).size());
      number = Labels::number_width(std::max<std::int64_t>(2, digits), style) + kSpace;
    }
    const std::string words = shortened(fact.words, panel.size().x, style);
    const double width = number + text_width(fact.widest.empty() ? words : fact.widest, style);
    const bool counts_begin = spacing.counts_apart && fact.first_count;
    if (x > panel.lo.x && (counts_begin || x + width > panel.hi.x)) {
      x = panel.lo.x;
      ++line;
    }
    if (labels) {
      const double y = top + line * kFactLine + 20;
      if (fact.number) labels->add_number(*fact.number, {x + number - kSpace, y}, style, panel);
      labels->add(words, {{x + number, y}, 0}, style, panel);
    }
    x += width + spacing.gap;
  }
  return facts.empty() ? 0 : line + 1;
}

// One line if there is room for it, however narrow; otherwise counts begin a line of their own.
Spacing spacing_of(const std::vector<Fact>& facts, const Box<2>& panel) {
  constexpr double kGaps[] = {34, 28, 22, 18, 14};
  const int least = lay_out_facts(facts, panel, {14, true}, 0, nullptr);
  for (const bool apart : {false, true})
    for (const double gap : kGaps)
      if (lay_out_facts(facts, panel, {gap, apart}, 0, nullptr) <= (apart ? least : 1))
        return {gap, apart};
  return {14, true};
}

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
      Frame& tree = trees.emplace_back();
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
  const std::vector<Fact> facts = facts_of(frame);
  for (const char* name : {"nodes", "leaves", "entries"})  // the facts
    if (frame.count(name)) list.referents.emplace(name);
  const Spacing spacing = spacing_of(facts, panel);
  const double height = lay_out_facts(facts, panel, spacing, 0, nullptr) * kFactLine;
  lay_out_facts(facts, panel, spacing, panel.hi.y - height, &labels);
  Box<2> diagram = panel;
  diagram.hi.y -= height + 4;
  if (frame.structure == StructureKind::sort_and_sweep)
    return draw_sweep(frame, shrunk(diagram, 6), list, labels);
  if (std::ranges::count(frame.nodes, kNone, &FrameNode::parent) > 1)
    return draw_forest(frame, diagram, list, labels);
  draw_one_tree(frame, diagram, list, labels);
}

}  // namespace lantern::draw
