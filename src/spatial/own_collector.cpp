#include "spatial/own_collector.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

#include "base/stop.hpp"
#include "spatial/halving.hpp"

namespace lantern::spatial {
namespace {

std::string child_way(const std::string& parent, std::uint32_t slot) {
  return parent == "root" ? fmt::format("{}", slot + 1) : fmt::format("{}.{}", parent, slot + 1);
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

void OwnCollector::collect(const OwnTree& tree) {
  view_.nodes_.clear();
  const NodeSink sink = [this](const OwnNode& told) {
    if (thrown_) std::rethrow_exception(thrown_);  // it was told to end, and goes on
    try {
      take(told);
    } catch (...) {
      thrown_ = std::current_exception();
      throw;
    }
  };
  std::string own_words = "something that is no std::exception";
  bool threw = true;
  try {
    tree.visit(sink);
    threw = false;
  } catch (const std::exception& e) {
    own_words = e.what();
  } catch (...) {
  }
  if (thrown_) std::rethrow_exception(thrown_);
  if (threw) refuse(fmt::format("visit threw: {}", own_words));
  if (view_.nodes_.empty()) refuse("visit told no node; it must tell the root at least");
  close_to(0);
  put_in_order();
}

void OwnCollector::refuse(const std::string& text) const {
  throw StructureFault({fmt::format("structure '{}': {}", rules_.name, text)});
}

// The way to the node that is about to be told. Nodes are numbered as they were told so far.
std::string OwnCollector::told_way(std::uint32_t parent) const {
  if (parent == kNone) return "the root";
  std::vector<std::uint32_t> slots = {children_[parent]};
  for (std::uint32_t i = parent; view_.nodes_[i].parent != kNone; i = view_.nodes_[i].parent)
    slots.push_back(view_.nodes_[i].slot);
  std::string way = "root";
  for (std::size_t i = slots.size(); i-- > 0;) way = child_way(way, slots[i]);
  return "node " + way;
}

void OwnCollector::take(const OwnNode& told) {
  stop_if_asked();
  const std::uint32_t parent = parent_of(told);
  const auto where = [&] { return told_way(parent); };
  for (int i = 0; i < 2; ++i)
    if (!std::isfinite(told.box.lo[i]) || !std::isfinite(told.box.hi[i]) ||
        told.box.lo[i] > told.box.hi[i])
      refuse(
          fmt::format("the box of {} goes from {} to {} on axis {}; both must be finite and in "
                      "this order",
                      where(), told.box.lo[i], told.box.hi[i], "xy"[i]));
  if (told.depth > rules_.max_depth)
    refuse(
        fmt::format("{} lies at depth {}, the limit is {}; does the tree lead back into itself, "
                    "or not stop at max_depth?",
                    where(), told.depth, rules_.max_depth));
  if (parent != kNone && children_[parent] == OwnView::kMostChildren)
    refuse(fmt::format("{} has more than {} children; does visit come to an end?",
                       parent == 0 ? "the root" : "node " + view_.way_to(parent),
                       OwnView::kMostChildren));
  if (view_.nodes_.size() >= rules_.most_entries)
    refuse(fmt::format("more than {} nodes; does visit come to an end?", rules_.most_entries));
  close_to(told.depth);
  OwnView::Node node{.box = told.box, .parent = parent, .depth = told.depth, .leaf = told.leaf};
  if (parent != kNone) node.slot = children_[parent]++;
  way_.push_back(static_cast<std::uint32_t>(view_.nodes_.size()));
  children_.push_back(0);
  view_.nodes_.push_back(node);
  take_bodies(told, view_.nodes_.back());
}

// Of the node that is about to be told: the last one above it.
std::uint32_t OwnCollector::parent_of(const OwnNode& told) const {
  if (view_.nodes_.empty()) {
    if (told.depth != 0)
      refuse(
          fmt::format("the first node that visit tells has depth {}; it must be the root, at "
                      "depth 0",
                      told.depth));
    return kNone;
  }
  const std::uint32_t last = way_.back();
  const std::string after = last == 0 ? "the root" : "node " + view_.way_to(last);
  if (told.depth == 0)
    refuse(fmt::format("visit tells a second root after {}; is the tree visited twice?", after));
  if (told.depth > way_.size())
    refuse(
        fmt::format("after {}, at depth {}, comes a node of depth {}; it can be {} at most, for "
                    "a child",
                    after, way_.size() - 1, told.depth, way_.size()));
  const std::uint32_t parent = way_[told.depth - 1];
  if (view_.nodes_[parent].leaf)
    refuse(fmt::format("{} is told as a leaf, but a child of it follows",
                       parent == 0 ? "the root" : "node " + view_.way_to(parent)));
  return parent;
}

// Those that were inserted, each once; ascending.
void OwnCollector::take_bodies(const OwnNode& told, OwnView::Node& node) {
  std::vector<BodyId>& all = view_.bodies_;
  node.first = static_cast<std::uint32_t>(all.size());
  const std::uint32_t place = way_.back();
  if (all.size() + told.bodies.size() > rules_.most_entries)
    refuse(fmt::format("the leaves list more than {} bodies in all", rules_.most_entries));
  for (const BodyId id : told.bodies) {
    if (id < all_bodies_)
      all.push_back(id);
    else
      view_.note({fmt::format("{{n}} lists a body of number {}, which was never inserted, or is no "
                              "longer there",
                              id),
                  {},
                  place});
  }
  const auto begin = all.begin() + node.first;
  if (!told.leaf && begin != all.end()) {
    view_.note(
        {"{n} has children, and lists {0}; bodies belong into leaves, each into every leaf "
         "that it reaches",
         {*begin},
         place});
    all.resize(node.first);
    return;
  }
  std::sort(begin, all.end());
  const auto twice = std::adjacent_find(begin, all.end());
  if (twice != all.end()) view_.note({"{n} lists {0} twice", {*twice}, place});
  all.erase(std::unique(begin, all.end()), all.end());
  node.count = static_cast<std::uint32_t>(all.size()) - node.first;
}

// Nodes at this depth and below have no more children.
void OwnCollector::close_to(std::size_t depth) {
  while (way_.size() > depth) {
    view_.nodes_[way_.back()].end = static_cast<std::uint32_t>(view_.nodes_.size());
    way_.pop_back();
  }
}

// Where all children of a node are quarters of it, they get the lecture's numbers.
void OwnCollector::name_children(std::uint32_t parent, std::vector<std::uint32_t>& children) {
  std::array<std::uint32_t, Halving<2>::kChildren> quarters;
  quarters.fill(kNone);
  if (children.size() > quarters.size()) return;
  for (const std::uint32_t child : children) {
    const auto slot = quarter_of(view_.nodes_[child].box, view_.nodes_[parent].box, view_.slack_);
    if (!slot || quarters[*slot] != kNone) return;
    quarters[*slot] = child;
  }
  children.clear();
  for (std::uint32_t slot = 0; slot < quarters.size(); ++slot) {
    if (quarters[slot] == kNone) continue;
    view_.nodes_[quarters[slot]].slot = slot;
    children.push_back(quarters[slot]);
  }
}

// Children in the order of their numbers, whatever the order in which they were told.
void OwnCollector::put_in_order() {
  std::vector<std::vector<std::uint32_t>> children(view_.nodes_.size());
  for (std::uint32_t i = 1; i < view_.nodes_.size(); ++i)
    children[view_.nodes_[i].parent].push_back(i);
  for (std::uint32_t i = 0; i < children.size(); ++i) name_children(i, children[i]);
  std::vector<OwnView::Node> ordered;
  std::vector<std::uint32_t> waiting = {0}, place(view_.nodes_.size());
  while (!waiting.empty()) {
    const std::uint32_t i = waiting.back();
    waiting.pop_back();
    place[i] = static_cast<std::uint32_t>(ordered.size());
    OwnView::Node node = view_.nodes_[i];
    node.end = place[i] + (node.end - i);
    if (node.parent != kNone) node.parent = place[node.parent];
    ordered.push_back(node);
    waiting.insert(waiting.end(), children[i].rbegin(), children[i].rend());
  }
  view_.nodes_ = std::move(ordered);
  for (OwnFault& fault : view_.faults_) fault.node = place[fault.node];
}

}  // namespace lantern::spatial
