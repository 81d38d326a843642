// The panel of a structure: its trees, and under them what it was told and what it counts. A
// structure for what never moves beside the one for what does makes two trees; sort and sweep has
// none and shows its intervals.
#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "draw/body_shapes.hpp"
#include "draw/font.hpp"
#include "draw/panels.hpp"
#include "draw/tree_layout.hpp"

namespace lantern::draw {
namespace {

// One fact of the lines under the diagram: words, or a number and what it counts.
struct Fact {
  std::string words;
  std::optional<std::int64_t> number = std::nullopt;
  std::string widest = {};  // that the words can get
  std::int64_t most = 0;    // that the number can get
  bool said = true;         // otherwise only its place is kept
};

// Does the caption say it, "12 nodes"?
bool says(const std::string& caption, const std::string& fact) {
  for (std::size_t at = caption.find(fact); at != std::string::npos;
       at = caption.find(fact, at + 1))
    if (at == 0 || caption[at - 1] == ' ') return true;
  return false;
}

// Counts first, each in its place on all frames of the group; then what the tree was told, where
// that is new.
std::vector<Fact> facts_of(const Frame& frame, const Staging& staging,
                           const std::string& settings) {
  std::vector<Fact> facts;
  if (!frame.side.empty()) return facts;  // its title and its counts say it
  const std::pair<const char*, const char*> counted[] = {
      {"nodes", "node"}, {"leaves", "leaf"}, {"entries", "entry"}};
  for (const auto& [many, one] : counted)
    if (const auto n = frame.count(many)) {
      const std::string words = *n == 1 ? one : many;
      facts.push_back({words, n, many, staging.most(many),
                       !says(frame.caption, fmt::format("{} {}", *n, words))});
    }
  for (std::size_t at = 0; at < settings.size();) {
    const std::size_t comma = std::min(settings.find(", ", at), settings.size());
    facts.push_back({.words = settings.substr(at, comma - at)});
    at = comma + 2;
  }
  return facts;
}

constexpr double kFactLine = 32;
constexpr double kFactGap = 26;

// Lays the facts out in lines and draws them when `labels` is given; gives the number of lines.
// Counts have cells for two digits at least, so that nothing moves while a small tree grows;
// settings that do not stand beside them begin a line.
int lay_out_facts(const std::vector<Fact>& facts, const Box<2>& panel, double top, Labels* labels) {
  const TextStyle style{kLabel, Weight::regular, Role::quiet_ink};
  constexpr double kSpace = 6;
  double x = panel.lo.x;
  int line = 0;
  for (const Fact& fact : facts) {
    double number = 0;  // room for it
    if (fact.number) {
      const auto digits =
          static_cast<std::int64_t>(std::to_string(std::max(*fact.number, fact.most)).size());
      number = Labels::number_width(std::max<std::int64_t>(2, digits), style) + kSpace;
    }
    const std::string words = shortened(fact.words, panel.size().x, style);
    const double width = number + text_width(fact.widest.empty() ? words : fact.widest, style);
    if (x > panel.lo.x && x + width > panel.hi.x) {
      x = panel.lo.x;
      ++line;
    }
    if (labels && fact.said) {
      const double y = top + line * kFactLine + 23;
      if (fact.number) labels->add_number(*fact.number, {x + number - kSpace, y}, style, panel);
      labels->add(words, {{x + number, y}, 0}, style, panel);
    }
    x += width + kFactGap;
  }
  return facts.empty() ? 0 : line + 1;
}

// The same room on all frames of the group, for the longest of their facts.
double height_of_facts(const Staging& staging, const Box<2>& panel) {
  return staging.once<double>("facts", panel, [&] {
    int lines = 0;
    for (const Frame* frame : staging.frames()) {
      const std::string settings = staging.tells_settings(*frame) ? frame->settings : "";
      const std::vector<Fact> facts = facts_of(*frame, staging, settings);
      lines = std::max(lines, lay_out_facts(facts, panel, 0, nullptr));
    }
    return lines * kFactLine;
  });
}

constexpr double kTreeHeading = 34;
constexpr double kBetween = 24;      // between two trees side by side
constexpr double kWideEnough = 1.5;  // aspect from which trees stand side by side

// The nodes of one of the frame's trees, numbered anew.
std::vector<FrameNode> nodes_of_tree(const Frame& frame, bool of_static) {
  std::vector<FrameNode> nodes;
  std::vector<std::uint32_t> places;
  for (const FrameNode& node : frame.nodes) {
    places.push_back(static_cast<std::uint32_t>(nodes.size()));
    if (node.of_static != of_static) continue;
    FrameNode& copy = nodes.emplace_back(node);
    if (node.parent != kNone) copy.parent = places[node.parent];
  }
  return nodes;
}

double share_of(const UnionTree& tree, bool beside) {
  return beside ? std::min(tree.leaves(), 16u) : std::min(tree.rows(), 6u);
}

// In parts by what each tree needs, but none below a quarter of an even part.
std::vector<Box<2>> cut(const std::vector<UnionTree>& trees, const Box<2>& area) {
  const Vec<2> size = area.size();
  const bool beside = size.x > kWideEnough * size.y;
  const int axis = beside ? 0 : 1;
  std::vector<double> shares;
  for (const UnionTree& tree : trees) shares.push_back(share_of(tree, beside));
  const double even =
      std::accumulate(shares.begin(), shares.end(), 0.0) / static_cast<double>(trees.size());
  for (double& share : shares) share = std::max(share, (beside ? 0.6 : 0.7) * even);
  return split(area, axis, shares, kBetween);
}

TreeStage stage_of(const UnionTree& tree, const Staging& staging, const Box<2>& diagram) {
  std::vector<TreeOfFrame> trees;
  for (const Frame* frame : staging.frames())
    trees.push_back({nodes_of_tree(*frame, tree.of_static), frame->hits});
  const bool atlas = !staging.frames()[0]->textures.empty();
  return stage_tree(tree, trees, atlas, shrunk(diagram, 6));
}

void draw_staged_tree(const Frame& frame, const UnionTree& tree, const Staging& staging,
                      const Box<2>& diagram, DrawList& list, Labels& labels) {
  const auto& stage = staging.once<TreeStage>(tree.of_static ? "static tree" : "tree", diagram,
                                              [&] { return stage_of(tree, staging, diagram); });
  if (staging.trees().size() == 1) return draw_one_tree(frame, tree, stage, list, labels);
  Frame part = frame;
  part.nodes = nodes_of_tree(frame, tree.of_static);
  draw_one_tree(part, tree, stage, list, labels);
}

void draw_forest(const Frame& frame, const Staging& staging, const Box<2>& area, DrawList& list,
                 Labels& labels) {
  const std::vector<UnionTree>& trees = staging.trees();
  const std::vector<Box<2>> boxes = cut(trees, area);
  const TextStyle style{kLabel, Weight::semibold, Role::quiet_ink};
  for (std::size_t i = 0; i < trees.size(); ++i) {
    const Box<2>& box = boxes[i];
    const std::string heading =
        shortened(trees[i].of_static ? "static: never moves" : "dynamic", box.size().x - 8, style);
    labels.add(heading, {{box.lo.x + 4, box.lo.y + 23}, 0}, style, box);
    if (i > 0 && boxes[0].lo.x < box.lo.x) {
      const double x = box.lo.x - kBetween / 2;
      list.crisp_line({x, box.lo.y}, {x, box.hi.y}, {Role::rule, 1.6});
    } else if (i > 0) {
      const double y = box.lo.y - kBetween / 2;
      list.crisp_line({box.lo.x, y}, {box.hi.x, y}, {Role::rule, 1.6});
    }
    draw_staged_tree(frame, trees[i], staging, {box.lo + Vec<2>(0, kTreeHeading), box.hi}, list,
                     labels);
  }
}

constexpr double kLeastBand = 22, kMostBand = 44;
constexpr double kAxisHeading = 34, kAxis = 16;

// In the order of their lower ends; ids break ties.
std::vector<const FrameBody*> swept(const Frame& frame, int axis) {
  std::vector<const FrameBody*> order;
  for (const FrameBody& body : frame.bodies)
    if (!is_half_space(body)) order.push_back(&body);
  std::ranges::stable_sort(order, {}, [&](const FrameBody* b) { return b->box.lo[axis]; });
  return order;
}

// One row a body, in the order in which the sweep meets them; the rows of bodies that the step is
// about are lit. Of many bodies as many are drawn as have room, and the rest is counted.
void draw_sweep(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels) {
  const int axis = frame.sweep_axis;
  const Box<2> world{{frame.bounds.lo[axis], 0}, {frame.bounds.hi[axis], 1}};
  std::vector<const FrameBody*> order = swept(frame, axis);
  const double length = world.size().x;
  if (order.empty() || !(length > 0) || panel.size().y < kAxisHeading + 2 * kMostBand) return;
  const TextStyle heading{kLabel, Weight::semibold, Role::quiet_ink};
  const TextStyle note{kLeastLabel, Weight::regular, Role::quiet_ink};
  labels.add(
      shortened(fmt::format("intervals along {}, sorted", "xyz"[axis]), panel.size().x, heading),
      {{panel.lo.x, panel.lo.y + 20}, 0}, heading, panel);
  Box<2> area{panel.lo + Vec<2>(kMostBand, kAxisHeading), panel.hi - Vec<2>(14, kAxis + 26)};
  const auto most = static_cast<std::size_t>(std::max(1.0, area.size().y / kLeastBand));
  const std::size_t all = order.size();
  if (all > most) order.resize(most);
  const double row = std::min(kMostBand, area.size().y / static_cast<double>(order.size()));
  area.hi.y = area.lo.y + row * static_cast<double>(order.size());
  const auto x_of = [&](double at) {
    const double share = (at - world.lo.x) / length;
    return area.lo.x + (share > 0 ? std::min(share, 1.0) : 0) * area.size().x;
  };
  for (std::size_t i = 0; i < order.size(); ++i) {
    const FrameBody& body = *order[i];
    const double y = area.lo.y + (static_cast<double>(i) + 0.5) * row;
    const double from = x_of(body.box.lo[axis]), to = x_of(body.box.hi[axis]);
    if (body.lit)
      list.rect({{panel.lo.x, y - row / 2 + 1}, {area.hi.x + 8, y + row / 2 - 1}}, Role::lit_fill,
                {}, 4);
    // A thin line down to where the sweep meets it.
    list.crisp_line({from, y}, {from, area.hi.y}, {Role::rule, 1.4, 4});
    const double half = std::min(0.3 * row, 9.0);
    list.rect({{from, y - half}, {std::max(to, from + 3), y + half}},
              body.dimmed ? Role::panel : body_role(body.color),
              {body.lit ? Role::lit : Role::body_line, 1.6, 0}, 2);
    const double icon = std::min(0.42 * row, 15.0);
    draw_character(body, Box<2>::around({panel.lo.x + icon + 3, y}, Vec<2>(icon)), false, list);
  }
  list.crisp_line({area.lo.x, area.hi.y + 4}, {area.hi.x, area.hi.y + 4}, {Role::ink, 2.0});
  const double below = area.hi.y + kAxis + 12;
  labels.try_add(std::string(1, "xyz"[axis]), {{{area.hi.x, below}, 1}}, note, panel);
  if (all > order.size())
    labels.try_add(fmt::format("and {} more", all - order.size()), {{{area.lo.x, below}, 0}}, note,
                   panel);
}

}  // namespace

void draw_tree(const Frame& frame, const Staging& staging, const Box<2>& panel, DrawList& list,
               Labels& labels) {
  const double height = height_of_facts(staging, panel);
  const std::string settings = staging.tells_settings(frame) ? frame.settings : "";
  lay_out_facts(facts_of(frame, staging, settings), panel, panel.hi.y - height, &labels);
  Box<2> diagram = panel;
  diagram.hi.y -= height + 4;
  if (frame.structure == StructureKind::sort_and_sweep && frame.nodes.empty())
    return draw_sweep(frame, shrunk(diagram, 6), list, labels);
  if (staging.trees().size() > 1) return draw_forest(frame, staging, diagram, list, labels);
  for (const UnionTree& tree : staging.trees())
    draw_staged_tree(frame, tree, staging, diagram, list, labels);
}

}  // namespace lantern::draw
