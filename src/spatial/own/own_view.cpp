#include "spatial/own/own_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/stop.hpp"
#include "spatial/trees/node_parts.hpp"

namespace lantern::spatial {
namespace {

constexpr std::uint32_t kMostChildren = 4096;
constexpr std::size_t kMostFaults = 3;

std::string text_of(const Box<2>& box) {
  return fmt::format("[{:.6g}, {:.6g}] to [{:.6g}, {:.6g}]", box.lo.x, box.lo.y, box.hi.x,
                     box.hi.y);
}

// "root", "1.3"
template <class Nodes>
std::string way_to(const Nodes& nodes, std::uint32_t node) {
  std::string way;
  for (; nodes[node].parent != kNone; node = nodes[node].parent)
    way = fmt::format("{}{}{}", nodes[node].slot + 1, way.empty() ? "" : ".", way);
  return way.empty() ? "root" : way;
}

// Which quarter of the parent it is, as the lecture counts them; nothing if it is none.
std::optional<std::uint32_t> quarter_of(const Box<2>& child, const Box<2>& parent, double slack) {
  const Vec<2> middle = Halving<2>::middle(parent);
  for (std::uint32_t slot = 0; slot < Halving<2>::kChildren; ++slot) {
    const Box<2> quarter = Halving<2>::child(parent, middle, slot);
    bool same = true;
    for (int i = 0; i < 2; ++i)
      same &= std::abs(child.lo[i] - quarter.lo[i]) <= slack &&
              std::abs(child.hi[i] - quarter.hi[i]) <= slack;
    if (same) return slot;
  }
  return std::nullopt;
}

}  // namespace

// --- taking down ---

// Takes down what the tree tells, node by node, and stops it where it cannot be read as a tree.
class OwnView::Reader {
 public:
  Reader(OwnView& view, const OwnRules& rules, std::size_t bodies)
      : view_(view), nodes_(view.nodes_), rules_(rules), all_bodies_(bodies) {}

  void read(const OwnTree& tree) {
    const NodeSink sink = [this](const OwnNode& told) {
      if (thrown_) std::rethrow_exception(thrown_);  // it was told to end, and goes on
      try {
        take(told);
      } catch (...) {
        thrown_ = std::current_exception();
        throw;
      }
    };
    run_own(
        "visit", 0, [&] { tree.visit(sink); },
        [&](const std::string& words) {
          if (thrown_) std::rethrow_exception(thrown_);
          refuse("visit threw: {}", words);
        });
    if (thrown_) std::rethrow_exception(thrown_);
    if (nodes_.empty()) refuse("visit told no node; it must tell the root at least");
    close_to(0);
    put_in_order();
  }

 private:
  template <class... Args>
  [[noreturn]] void refuse(fmt::format_string<const Args&...> text, const Args&... args) const {
    throw StructureFault(
        {fmt::format("structure '{}': {}", rules_.name, fmt::format(text, args...))});
  }

  void take(const OwnNode& told) {
    stop_if_asked();
    const std::uint32_t parent = parent_of(told);
    // The way to the node that is about to be told. Nodes are numbered as they were told so far.
    const auto where = [&] {
      if (parent == kNone) return std::string("the root");
      return fmt::format("node {}{}", parent == 0 ? "" : way_to(nodes_, parent) + ".",
                         children_[parent] + 1);
    };
    for (int i = 0; i < 2; ++i)
      if (!std::isfinite(told.box.lo[i]) || !std::isfinite(told.box.hi[i]) ||
          told.box.lo[i] > told.box.hi[i])
        refuse("the box of {} goes from {} to {} on axis {}; both must be finite and in this order",
               where(), told.box.lo[i], told.box.hi[i], "xy"[i]);
    if (told.depth > rules_.max_depth)
      refuse(
          "{} lies at depth {}, the limit is {}; does the tree lead back into itself, or not stop "
          "at max_depth?",
          where(), told.depth, rules_.max_depth);
    if (parent != kNone && children_[parent] == kMostChildren)
      refuse("{} has more than {} children; does visit come to an end?", view_.place_of(parent),
             kMostChildren);
    if (nodes_.size() >= rules_.most_entries)
      refuse("more than {} nodes; does visit come to an end?", rules_.most_entries);
    close_to(told.depth);
    Node node{.box = told.box, .parent = parent, .depth = told.depth, .leaf = told.leaf};
    if (parent != kNone) node.slot = children_[parent]++;
    way_.push_back(static_cast<std::uint32_t>(nodes_.size()));
    children_.push_back(0);
    nodes_.push_back(node);
    take_bodies(told, nodes_.back());
  }

  // Of the node that is about to be told: the last one above it.
  std::uint32_t parent_of(const OwnNode& told) const {
    if (nodes_.empty()) {
      if (told.depth != 0)
        refuse("the first node that visit tells has depth {}; it must be the root, at depth 0",
               told.depth);
      return kNone;
    }
    if (told.depth == 0)
      refuse("visit tells a second root after {}; is the tree visited twice?",
             view_.place_of(way_.back()));
    if (told.depth > way_.size())
      refuse("after {}, at depth {}, comes a node of depth {}; it can be {} at most, for a child",
             view_.place_of(way_.back()), way_.size() - 1, told.depth, way_.size());
    const std::uint32_t parent = way_[told.depth - 1];
    if (nodes_[parent].leaf)
      refuse("{} is told as a leaf, but a child of it follows", view_.place_of(parent));
    return parent;
  }

  // Those that were inserted, each once; ascending.
  void take_bodies(const OwnNode& told, Node& node) {
    std::vector<BodyId>& all = view_.bodies_;
    node.first = static_cast<std::uint32_t>(all.size());
    const std::uint32_t place = way_.back();
    if (all.size() + told.bodies.size() > rules_.most_entries)
      refuse("the leaves list more than {} bodies in all", rules_.most_entries);
    for (const BodyId id : told.bodies) {
      if (id < all_bodies_)
        all.push_back(id);
      else
        view_.note(fmt::format("{{n}} lists a body of number {}, which was never inserted, or is "
                               "no longer there",
                               id),
                   place);
    }
    const auto begin = all.begin() + node.first;
    if (!told.leaf && begin != all.end()) {
      view_.note(
          "{n} has children, and lists {0}; bodies belong into leaves, each into every leaf that "
          "it reaches",
          place, {*begin});
      all.resize(node.first);
      return;
    }
    std::sort(begin, all.end());
    const auto twice = std::adjacent_find(begin, all.end());
    if (twice != all.end()) view_.note("{n} lists {0} twice", place, {*twice});
    all.erase(std::unique(begin, all.end()), all.end());
    node.count = static_cast<std::uint32_t>(all.size()) - node.first;
  }

  // Nodes at this depth and below have no more children.
  void close_to(std::size_t depth) {
    for (; way_.size() > depth; way_.pop_back())
      nodes_[way_.back()].end = static_cast<std::uint32_t>(nodes_.size());
  }

  // Where all children of a node are quarters of it, they get the lecture's numbers.
  void name_children(std::uint32_t parent, std::vector<std::uint32_t>& children) {
    std::array<std::uint32_t, Halving<2>::kChildren> quarters;
    quarters.fill(kNone);
    if (children.size() > quarters.size()) return;
    for (const std::uint32_t child : children) {
      const auto slot = quarter_of(nodes_[child].box, nodes_[parent].box, view_.slack_);
      if (!slot || quarters[*slot] != kNone) return;
      quarters[*slot] = child;
    }
    children.clear();
    for (std::uint32_t slot = 0; slot < quarters.size(); ++slot) {
      if (quarters[slot] == kNone) continue;
      nodes_[quarters[slot]].slot = slot;
      children.push_back(quarters[slot]);
    }
  }

  // Children in the order of their numbers, whatever the order in which they were told.
  void put_in_order() {
    std::vector<std::vector<std::uint32_t>> children(nodes_.size());
    for (std::uint32_t i = 1; i < nodes_.size(); ++i) children[nodes_[i].parent].push_back(i);
    for (std::uint32_t i = 0; i < children.size(); ++i) name_children(i, children[i]);
    std::vector<Node> ordered;
    std::vector<std::uint32_t> waiting = {0}, place(nodes_.size());
    while (!waiting.empty()) {
      const std::uint32_t i = waiting.back();
      waiting.pop_back();
      place[i] = static_cast<std::uint32_t>(ordered.size());
      Node node = nodes_[i];
      node.end = place[i] + (node.end - i);
      if (node.parent != kNone) node.parent = place[node.parent];
      ordered.push_back(node);
      waiting.insert(waiting.end(), children[i].rbegin(), children[i].rend());
    }
    nodes_ = std::move(ordered);
    for (std::uint32_t& node : view_.fault_nodes_) node = place[node];
  }

  OwnView& view_;
  std::vector<Node>& nodes_;
  const OwnRules& rules_;
  std::size_t all_bodies_;
  std::vector<std::uint32_t> way_;       // from the root to the last node
  std::vector<std::uint32_t> children_;  // of each node so far
  std::exception_ptr thrown_;            // by us, through the tree's own code
};

// --- looking at it ---

// Holds what a tree tells of itself against what it was told: a tree can be read, and still be
// wrong.
class OwnView::Inspection {
 public:
  // `boxes` are those of the bodies that were inserted, cut to the bounds.
  Inspection(OwnView& view, std::span<const Box<2>> boxes)
      : view_(view), nodes_(view.nodes_), boxes_(boxes), leaves_(boxes.size()) {}

  void inspect(const Box<2>& bounds) {
    inspect_cells(bounds);
    inspect_lists();
    for (BodyId body = 0; body < boxes_.size(); ++body)
      if (is_listed_where_it_reaches(body)) require_covered(body);
    inspect_pairs();
  }

 private:
  Box<2> grown_box(std::uint32_t node) const { return grown(nodes_[node].box, view_.slack_); }
  // What is left away from its borders, by more than what rounding may do; nothing is not valid.
  Box<2> core_of(const Box<2>& box) const { return grown(box, -view_.slack_); }

  void inspect_cells(const Box<2>& bounds) {
    const auto lies_within = [](const Box<2>& box, const Box<2>& outer) {
      return contains(outer, box.lo) && contains(outer, box.hi);
    };
    if (!lies_within(bounds, grown_box(0)))
      view_.note(fmt::format("{{n}} goes from {}, but the world from {}; it must hold the world",
                             text_of(nodes_[0].box), text_of(bounds)),
                 0);
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      const Node& node = nodes_[i];
      if (node.parent != kNone && !lies_within(node.box, grown_box(node.parent)))
        view_.note(fmt::format("{{n}} goes from {}, which is not within its parent, from {}",
                               text_of(node.box), text_of(nodes_[node.parent].box)),
                   i);
      if (!node.leaf) inspect_siblings(i);
      if (!node.leaf && node.end == i + 1)
        view_.note("{n} is told as an inner node, but no child of it follows", i);
    }
  }

  void inspect_siblings(std::uint32_t parent) {
    for (std::uint32_t a = parent + 1; a < nodes_[parent].end; a = nodes_[a].end)
      for (std::uint32_t b = nodes_[a].end; b < nodes_[parent].end; b = nodes_[b].end)
        if (is_valid(core_of(common_part(nodes_[a].box, nodes_[b].box))))
          return view_.note(
              fmt::format("{{n}} overlaps its sibling {}: it goes from {}, the other from {}; "
                          "children must not overlap",
                          way_to(nodes_, a), text_of(nodes_[b].box), text_of(nodes_[a].box)),
              b);
  }

  // Whom leaves list: only who reaches them.
  void inspect_lists() {
    for (std::uint32_t i = 0; i < nodes_.size(); ++i)
      for (const BodyId body : view_.bodies(nodes_[i])) {
        leaves_[body].push_back(i);
        if (!overlap(boxes_[body], grown_box(i)))
          view_.note(fmt::format("{{n}}, from {}, lists {{0}}, which does not reach it: its box "
                                 "goes from {}",
                                 text_of(nodes_[i].box), text_of(boxes_[body])),
                     i, {body});
      }
  }

  // Each leaf that it reaches by more than a border must list it; of those that it only touches,
  // any one will do.
  bool is_listed_where_it_reaches(BodyId body) {
    stop_if_asked();
    const Box<2>& box = boxes_[body];
    if (leaves_[body].empty()) {
      view_.note(fmt::format("no leaf lists {{0}}, whose box goes from {}", text_of(box)), kNone,
                 {body});
      return false;
    }
    for (std::uint32_t i = 0; i < nodes_.size();) {
      const Node& node = nodes_[i];
      if (!overlap(box, node.box)) {
        i = node.end;
        continue;
      }
      const Box<2> core = core_of(node.box);
      if (node.leaf && is_valid(core) && overlap(core, box) &&
          !std::ranges::binary_search(leaves_[body], i)) {
        view_.note(fmt::format("{{n}}, from {}, does not list {{0}}, which reaches it: its box "
                               "goes from {}; listed in {}",
                               text_of(node.box), text_of(box), leaves_of(body)),
                   i, {body});
        return false;
      }
      ++i;
    }
    return true;
  }

  // Leaves that list it must cover it, or a part of it lies nowhere: where a child was not made.
  // What is as thin as rounding is measured along its length only.
  void require_covered(BodyId body) {
    constexpr double kThin = 1000, kMissing = 1e-3;
    const Box<2>& box = boxes_[body];
    const auto measure = [&](const Box<2>& part) {
      double size = is_valid(part) ? 1 : 0;
      for (int i = 0; i < 2; ++i)
        if (box.size()[i] > kThin * view_.slack_) size *= part.size()[i];
      return size;
    };
    double covered = 0;
    for (const std::uint32_t leaf : leaves_[body])
      covered += measure(common_part(box, grown_box(leaf)));
    if (covered < measure(box) * (1 - kMissing))
      view_.note(fmt::format("a part of {{0}} lies in no leaf: its box goes from {}, and it is "
                             "listed in {}, which do not cover it",
                             text_of(box), leaves_of(body)),
                 kNone, {body});
  }

  // What it is all for: the first that is missed is told even if there is much else to tell.
  void inspect_pairs() {
    const auto sweep = make_structure<2>(StructureKind::sort_and_sweep);
    sweep->build(boxes_);
    bool told = false;
    const auto all = [](BodyId) { return true; };
    sweep->compare(all, [&](BodyId a, BodyId b) {
      if (told || !overlap(boxes_[a], boxes_[b]) || share_a_leaf(a, b)) return;
      told = true;
      if (a > b) std::swap(a, b);
      view_.faults_.push_back(
          {fmt::format("{{0}} and {{1}} overlap, but share no leaf: {{0}} is listed in {}, {{1}} "
                       "in {}; their pair is missed",
                       leaves_of(a), leaves_of(b)),
           {a, b}});
      view_.fault_nodes_.push_back(kNone);
    });
  }

  bool share_a_leaf(BodyId a, BodyId b) const {
    return std::ranges::any_of(leaves_[a], [&](std::uint32_t leaf) {
      return std::ranges::binary_search(leaves_[b], leaf);
    });
  }

  std::string leaves_of(BodyId body) const {
    constexpr std::size_t kMost = 4;
    std::string text;
    for (std::size_t i = 0; i < std::min(leaves_[body].size(), kMost); ++i)
      text += (i > 0 ? ", " : "") + way_to(nodes_, leaves_[body][i]);
    if (leaves_[body].size() > kMost)
      text += fmt::format(" and {} more", leaves_[body].size() - kMost);
    return text.empty() ? "no leaf" : text;
  }

  OwnView& view_;
  const std::vector<Node>& nodes_;
  std::span<const Box<2>> boxes_;
  std::vector<std::vector<std::uint32_t>> leaves_;  // that list each body; ascending
};

OwnView::OwnView(const OwnTree& tree, const OwnRules& rules, std::span<const Box<2>> boxes,
                 const OwnView& before) {
  constexpr double kOfTheWorld = 1e-6;
  const Vec<2> size = rules.bounds.size();
  slack_ = kOfTheWorld * std::max(size.x, size.y);
  Reader(*this, rules, boxes.size()).read(tree);
  Inspection(*this, boxes).inspect(rules.bounds);
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    std::string& text = faults_[i].text;
    if (const std::uint32_t node = fault_nodes_[i]; node != kNone)
      text.replace(text.find("{n}"), 3, place_of(node));
    text = fmt::format("structure '{}': {}", rules.name, text);
  }
  keep_handles(before);
}

// "the root", "node 1.3"
std::string OwnView::place_of(std::uint32_t node) const {
  return node == 0 ? "the root" : "node " + way_to(nodes_, node);
}

// "{n}" in the text is the node.
void OwnView::note(std::string text, std::uint32_t node, std::vector<BodyId> bodies) {
  if (faults_.size() >= kMostFaults) return;
  faults_.push_back({std::move(text), std::move(bodies)});
  fault_nodes_.push_back(node);
}

}  // namespace lantern::spatial
