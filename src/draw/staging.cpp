#include "draw/staging.hpp"

#include <fmt/format.h>

#include "frame/parts/atlas.hpp"

namespace lantern::draw {
namespace {

constexpr std::size_t kMostNodes = 4096;  // of a union; of more no diagram shows any
constexpr std::size_t kIcons = 5;         // more bodies than this need no more room

// Do both need the same room in a diagram?
bool is_shown_alike(const FrameNode& a, const FrameNode& b) {
  const auto digits = [](const FrameNode& n) {
    return n.bodies.size() < kIcons ? n.bodies.size()
                                    : kIcons + std::to_string(n.bodies.size()).size();
  };
  return a.leaf == b.leaf && digits(a) == digits(b) && a.label == b.label &&
         a.plane_name == b.plane_name;
}

// A copy without what a diagram does not show.
FrameNode without_region(const FrameNode& node) {
  FrameNode copy = node;
  copy.region.clear();
  copy.mark = Mark::quiet;
  return copy;
}

void add_form(UnionNode& into, const FrameNode& node) {
  into.node.leaf = into.node.leaf && node.leaf;
  for (const FrameNode& form : into.shown)
    if (is_shown_alike(form, node)) return;
  into.shown.push_back(without_region(node));
}

// Parents before children, row by row, children in order of their slots.
void put_in_order(UnionTree& tree) {
  std::vector<std::vector<std::uint32_t>> children(tree.nodes.size());
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i)
    if (tree.nodes[i].node.parent != kNone) children[tree.nodes[i].node.parent].push_back(i);
  std::vector<std::uint32_t> order{0}, parents{kNone};
  for (std::uint32_t at = 0; at < order.size(); ++at) {
    auto& own = children[order[at]];
    std::ranges::stable_sort(own, {}, [&](std::uint32_t c) { return tree.nodes[c].node.slot; });
    for (const std::uint32_t child : own) {
      order.push_back(child);
      parents.push_back(at);
    }
  }
  std::vector<UnionNode> sorted;
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    UnionNode& node = sorted.emplace_back(std::move(tree.nodes[order[i]]));
    node.node.id = i;
    node.node.parent = parents[i];
    tree.index[node.way] = i;
  }
  tree.nodes = std::move(sorted);
}

// What kind of trees a side has: of two structures it has two.
std::string trees_of(const Frame& side) {
  const bool two = std::ranges::any_of(side.nodes, &FrameNode::of_static);
  return fmt::format("{}{}", to_string(side.structure), two ? ", and a static one" : "");
}

}  // namespace

std::vector<std::string> ways_of(const std::vector<FrameNode>& nodes) {
  std::vector<std::string> ways;
  for (std::uint32_t i = 0; i < nodes.size(); ++i) ways.push_back(way_of(nodes, i));
  return ways;
}

std::uint32_t UnionTree::leaves() const {
  return static_cast<std::uint32_t>(
      std::ranges::count_if(nodes, [](const UnionNode& n) { return n.node.leaf; }));
}

std::uint32_t UnionTree::rows() const {
  return greatest_of<std::uint32_t>(0, nodes, [](const UnionNode& n) { return n.node.depth + 1; });
}

const UnionNode* UnionTree::find(std::string_view way) const {
  const auto found = index.find(way);
  return found == index.end() ? nullptr : &nodes[found->second];
}

std::vector<const Frame*> Staging::each_of(std::span<const Frame> frames) {
  return mapped(frames, [](const Frame& frame) { return &frame; });
}

Staging::Staging(std::vector<const Frame*> frames, const AxisRanges& axes)
    : frames_(std::move(frames)), axes_(axes) {
  std::map<std::string, std::vector<const Frame*>> sides;
  std::string last_settings;
  for (const Frame* each : frames_) {
    const Frame& frame = *each;
    for (const Frame& side : frame.sides) {
      const auto [known, fresh] = structure_of_.try_emplace(side.get<FrameSide>().name);
      if (fresh) known->second = trees_of(side);
      sides[known->second].push_back(&side);
    }
    if (settings_told_.empty() || frame.get<FrameStructure>().settings != last_settings) {
      settings_told_.insert(frame.index);
      last_settings = frame.get<FrameStructure>().settings;
    }
    for (const auto& [name, n] : frame.counts) {
      const auto found = most_.try_emplace(name, n).first;
      found->second = std::max(found->second, n);
    }
    most_leaves_ =
        std::max<std::size_t>(most_leaves_, std::ranges::count_if(frame.nodes, &FrameNode::leaf));
    add_nodes(frame);
  }
  for (UnionTree& tree : trees_) put_in_order(tree);
  std::ranges::stable_sort(trees_, {}, &UnionTree::of_static);
  for (const auto& [structure, own] : sides) sides_.emplace(structure, Staging(own, axes));
}

std::vector<const Frame*> Staging::some_frames(std::size_t most) const {
  const std::size_t all = frames_.size(), some = std::min(all, most);
  std::vector<const Frame*> found;
  for (std::size_t i = 0; i < some; ++i) found.push_back(frames_[i * all / some]);
  return found;
}

bool Staging::is_one_group(const Frame& before, const Frame& next) {
  const bool same_world = before.dimension == next.dimension &&
                          before.bounds.lo == next.bounds.lo && before.bounds.hi == next.bounds.hi;
  const bool other_part = before.part != next.part && (before.get<FrameStructure>().settings !=
                                                           next.get<FrameStructure>().settings ||
                                                       next.find<FrameTextures>());
  const bool same_sides =
      std::ranges::equal(before.sides, next.sides, [](const Frame& a, const Frame& b) {
        return a.get<FrameSide>().name == b.get<FrameSide>().name && is_one_group(a, b);
      });
  return same_world && same_sides && before.panels == next.panels &&
         before.structure == next.structure && !other_part;
}

std::span<const Frame> Staging::first_group(std::span<const Frame> frames) {
  const auto last = std::ranges::adjacent_find(frames, std::not_fn(is_one_group));
  return last == frames.end() ? frames : std::span(frames.begin(), last + 1);
}

const Staging& Staging::of_side(std::string_view side) const {
  const auto found = structure_of_.find(side);
  return found == structure_of_.end() ? *this : sides_.find(found->second)->second;
}

const Staging& Staging::largest_side() const {
  const Staging* largest = this;
  for (const auto& [structure, side] : sides_)
    if (largest == this || side.leaves() > largest->leaves()) largest = &side;
  return *largest;
}

std::uint32_t Staging::leaves() const { return sum_of<std::uint32_t>(trees_, &UnionTree::leaves); }

std::int64_t Staging::most(const std::string& count) const {
  const auto found = most_.find(count);
  return found == most_.end() ? 0 : found->second;
}

void Staging::add_nodes(const Frame& frame) {
  const std::vector<std::string> ways = ways_of(frame.nodes);
  std::vector<std::pair<std::size_t, std::uint32_t>> places;  // tree, and place in it
  for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
    const FrameNode& node = frame.nodes[i];
    std::size_t t = 0;
    if (node.parent != kNone)
      t = places[node.parent].first;
    else
      while (t < trees_.size() && trees_[t].nodes[0].way != ways[i]) ++t;
    if (t == trees_.size()) trees_.emplace_back().of_static = node.of_static;
    UnionTree& tree = trees_[t];
    const auto known = tree.index.find(ways[i]);
    const bool lost = node.parent != kNone && places[node.parent].second == kNone;
    if (known == tree.index.end() && (lost || tree.nodes.size() >= kMostNodes)) {
      tree.complete = false;
      places.emplace_back(t, kNone);
      continue;
    }
    if (known == tree.index.end()) {
      UnionNode& fresh = tree.nodes.emplace_back(UnionNode{without_region(node), ways[i], {}});
      fresh.node.parent = node.parent == kNone ? kNone : places[node.parent].second;
      tree.index.emplace(ways[i], static_cast<std::uint32_t>(tree.nodes.size() - 1));
    }
    places.emplace_back(t, tree.index.find(ways[i])->second);
    add_form(tree.nodes[places.back().second], node);
  }
}

void AxisRanges::see(const frame::Frame& frame) {
  const frame::FrameChart& chart = frame.get<FrameChart>();
  for (const frame::FrameBar& bar : chart.bars) chart_.add(bar.value, chart.logarithmic);
  std::vector<frame::FrameBar>& bars = bars_[chart.part];
  if (chart.bars.size() > bars.size()) bars = chart.bars;
  for (const frame::FrameSeries& series : chart.series)
    for (const Vec<2>& p : series.points) {
      chart_.add(p.y, chart.logarithmic);
      chart_x_.add(p.x, chart.logarithmic && !chart.over_time);
    }
  for (const Vec<2>& p : frame.get<FrameTrace>().points) {
    trace_ = std::max(trace_, p.y);
    double& seconds = seconds_[frame.part];
    seconds = std::max(seconds, p.x);
  }
  for (const frame::Frame& side : frame.sides) see(side);
}

void AxisRanges::forget_names() {
  for (auto& [part, bars] : bars_)
    for (frame::FrameBar& bar : bars) bar.label.clear();
}

const std::vector<frame::FrameBar>& AxisRanges::bars(int part) const {
  static const std::vector<frame::FrameBar> none;
  const auto found = bars_.find(part);
  return found == bars_.end() ? none : found->second;
}

std::optional<double> AxisRanges::seconds_of(const std::string& part) const {
  const auto found = seconds_.find(part);
  return found == seconds_.end() || found->second <= 0 ? std::nullopt
                                                       : std::optional(found->second);
}

}  // namespace lantern::draw
