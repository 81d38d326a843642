// The panel of a structure: its trees, and under them what it was told and what it counts. A
// structure for what never moves beside the one for what does makes two trees; sort and sweep has
// none and shows its intervals.
#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

#include "base/words.hpp"
#include "draw/panel.hpp"
#include "draw/tree/tree_layout.hpp"
#include "language/panel_rules.hpp"

namespace lantern::draw {
namespace {

// One fact of the lines under the diagram: words, or a number and what it counts.
struct Fact {
  std::string words;
  std::optional<std::int64_t> number = std::nullopt;
  std::string widest = {};  // that the words can get
  std::int64_t most = 0;    // that the number can get
  bool new_line = false;
};

// Counts first, but for those that the foot has, each in its place on all frames of the group;
// then, in lines of their own, what the tree was told, where that is new.
std::vector<Fact> facts_of(const Frame& frame, const Staging& staging, const Box<2>& panel) {
  constexpr double kLeastForSettings = 330;  // height; on a lower one the rows need the room
  std::vector<Fact> facts;
  // Its title and its counts say it; and one list of all bodies is no tree.
  if (!frame.get<FrameSide>().name.empty() || traits_of(frame.structure).has(Setting::axis))
    return facts;
  const std::pair<const char*, const char*> counted[] = {
      {"nodes", "node/nodes"}, {"leaves", "leaf/leaves"}, {"entries", "entry/entries"}};
  for (const auto& [many, forms] : counted)
    if (const auto n = staging.is_headed(many) ? std::nullopt : frame.count(many);
        n && !(has_cells(frame.structure) && many != std::string_view("entries")))
      facts.push_back({noun(forms, *n), *n, noun(forms, kMany), staging.most(many)});
  if (!frame.display.settings || !staging.tells_settings(frame) ||
      panel.size().y < kLeastForSettings)
    return facts;
  const std::string& settings = frame.get<FrameStructure>().settings;
  for (std::size_t at = 0; at < settings.size();) {
    const std::size_t comma = std::min(settings.find(", ", at), settings.size());
    facts.push_back({.words = settings.substr(at, comma - at), .new_line = at == 0});
    at = comma + 2;
  }
  return facts;
}

constexpr double kFactLine = 32;
constexpr double kFactGap = 26;

// Lays the facts out in lines and draws them when `labels` is given; gives the number of lines.
// A count has room for two digits at least, so that the others do not move while a small tree
// grows.
int lay_out_facts(const std::vector<Fact>& facts, const Box<2>& panel, double top, Labels* labels) {
  const TextStyle& style = kQuiet;
  constexpr double kSpace = 6;
  double x = panel.lo.x;
  int line = 0;
  for (const Fact& fact : facts) {
    double number = 0, room = 0;  // width of this one, and of the widest
    if (fact.number) {
      number = Labels::width_of(*fact.number, style) + kSpace;
      room =
          Labels::width_of(std::max({*fact.number, fact.most, std::int64_t{10}}), style) + kSpace;
    }
    const std::string words = shortened(fact.words, panel.size().x, style);
    const double width = room + text_width(fact.widest.empty() ? words : fact.widest, style);
    if (x > panel.lo.x && (fact.new_line || x + width > panel.hi.x)) {
      x = panel.lo.x;
      ++line;
    }
    if (labels) {
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
    for (const Frame* frame : staging.frames())
      lines = std::max(lines, lay_out_facts(facts_of(*frame, staging, panel), panel, 0, nullptr));
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

// In parts by what each tree needs, but none below a quarter of an even part.
std::vector<Box<2>> cut(const std::vector<UnionTree>& trees, const Box<2>& area) {
  const Vec<2> size = area.size();
  const bool beside = size.x > kWideEnough * size.y;
  const int axis = beside ? 0 : 1;
  std::vector<double> shares;
  for (const UnionTree& tree : trees)
    shares.push_back(beside ? std::min(tree.leaves(), 16u) : std::min(tree.rows(), 6u));
  const double even =
      std::accumulate(shares.begin(), shares.end(), 0.0) / static_cast<double>(trees.size());
  for (double& share : shares) share = std::max(share, (beside ? 0.6 : 0.7) * even);
  return split(area, axis, shares, kBetween);
}

TreeStage stage_of(const UnionTree& tree, const Staging& staging, const Box<2>& diagram) {
  std::vector<TreeOfFrame> trees;
  for (const Frame* frame : staging.frames())
    trees.push_back({nodes_of_tree(*frame, tree.of_static), frame->get<FrameFinding>().hits});
  const bool atlas = !staging.frames()[0]->get<FrameTextures>().textures.empty();
  return stage_tree(tree, trees, atlas, shrunk(diagram, 6));
}

void draw_staged_tree(const Frame& frame, const UnionTree& tree, const Staging& staging,
                      const Box<2>& diagram, DrawList& list, Labels& labels) {
  const auto& stage = staging.once<TreeStage>(tree.of_static ? "static tree" : "tree", diagram,
                                              [&] { return stage_of(tree, staging, diagram); });
  const auto draw = [&](const Frame& one) {
    draw_one_tree({one, staging, stage.panel, list, labels}, tree, stage);
  };
  if (staging.trees().size() == 1) return draw(frame);
  Frame part = frame;
  part.nodes = nodes_of_tree(frame, tree.of_static);
  draw(part);
}

void draw_forest(const Frame& frame, const Staging& staging, const Box<2>& area, DrawList& list,
                 Labels& labels) {
  const std::vector<UnionTree>& trees = staging.trees();
  const std::vector<Box<2>> boxes = cut(trees, area);
  const TextStyle style{kLabel, Weight::semibold, Role::quiet_ink};
  for (std::size_t i = 0; i < trees.size(); ++i) {
    const Box<2>& box = boxes[i];
    const std::string heading = shortened(
        word(trees[i].of_static ? "static: never moves" : "dynamic"), box.size().x - 8, style);
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

}  // namespace

void draw_tree(const Frame& frame, const Staging& staging, const Box<2>& panel, DrawList& list,
               Labels& labels) {
  for (const char* name : {"nodes", "leaves", "entries"})  // the facts
    if (frame.count(name)) list.referents.emplace(name);
  const double height = frame.display.facts ? height_of_facts(staging, panel) : 0;
  if (height > 0)
    lay_out_facts(facts_of(frame, staging, panel), panel, panel.hi.y - height, &labels);
  Box<2> diagram = panel;
  diagram.hi.y -= height + 4;
  if (traits_of(frame.structure).has(Setting::axis))
    return draw_sweep({frame, staging, shrunk(diagram, 6), list, labels});
  if (!frame.get<FrameStructure>().grid_levels.empty() && staging.trees().size() < 2)
    return draw_grid({frame, staging, shrunk(diagram, 6), list, labels});
  if (staging.trees().size() > 1) return draw_forest(frame, staging, diagram, list, labels);
  for (const UnionTree& tree : staging.trees())
    draw_staged_tree(frame, tree, staging, diagram, list, labels);
}

PanelEntry tree_panel() {
  return {{.name = "tree",
           .words =
               "the `tree` (of `sort_and_sweep` its intervals, of a `grid` the table of its cells)",
           .needs = "it needs a [structure], a [level] or an [atlas]",
           .possible = language::has_tree,
           .place = 4,
           .by_itself = language::has_nodes},
          {.shows = {{"nodes", [](const Frame& f) { return !f.nodes.empty(); }}}},
          {.draw = draw_tree,
           .size =
               [](const Frame& frame, const Staging& staging, const Box<2>& box) {
                 // A grid's table takes what it gets, whatever the cells of the moment are, and so
                 // do intervals.
                 const bool is_tree = frame.get<FrameStructure>().grid_levels.empty() &&
                                      !traits_of(frame.structure).has(Setting::axis);
                 return is_tree ? tree_size_in(staging, box)
                                : std::sqrt(box.size().x * box.size().y);
               },
           .weight = 1.2,
           .least = 320}};  // four rows and their labels
}

}  // namespace lantern::draw
