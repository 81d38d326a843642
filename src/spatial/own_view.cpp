#include "spatial/own_view.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "spatial/own_collector.hpp"
#include "spatial/own_inspection.hpp"

namespace lantern::spatial {
namespace {

void replace(std::string& text, std::string_view what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at)) {
    text.replace(at, what.size(), by);
    at += by.size();
  }
}

// "the root", "node 1.3"
std::string place_of(const OwnView& view, std::uint32_t node) {
  return node == 0 ? "the root" : "node " + view.way_to(node);
}

}  // namespace

std::string text_of(const OwnFault& fault, const std::function<std::string(BodyId)>& name_of) {
  std::string text = fault.text;
  for (std::size_t i = 0; i < fault.bodies.size(); ++i)
    replace(text, fmt::format("{{{}}}", i), name_of(fault.bodies[i]));
  return text;
}

StructureFault::StructureFault(OwnFault fault)
    : std::runtime_error(text_of(fault, [](BodyId id) { return fmt::format("body {}", id); })),
      fault_(std::move(fault)) {}

OwnView::OwnView(const OwnTree& tree, const OwnRules& rules, std::span<const Box<2>> boxes,
                 const OwnView& before) {
  constexpr double kOfTheWorld = 1e-6;
  const Vec<2> size = rules.bounds.size();
  slack_ = kOfTheWorld * std::max(size.x, size.y);
  OwnCollector(*this, rules, boxes.size()).collect(tree);
  OwnInspection(*this, rules, boxes).inspect();
  for (OwnFault& fault : faults_) {
    replace(fault.text, "{n}", fault.node == kNone ? "" : place_of(*this, fault.node));
    fault.text = fmt::format("structure '{}': {}", rules.name, fault.text);
  }
  keep_handles(before);
}

void OwnView::note(OwnFault fault) {
  if (faults_.size() < kMostFaults) faults_.push_back(std::move(fault));
}

std::string OwnView::way_to(std::uint32_t node) const {
  std::string way;
  for (; nodes_[node].parent != kNone; node = nodes_[node].parent)
    way = fmt::format("{}{}{}", nodes_[node].slot + 1, way.empty() ? "" : ".", way);
  return way.empty() ? "root" : way;
}

// Nodes at the same place in the tree are the same node to who looks; others take what is free.
void OwnView::keep_handles(const OwnView& before) {
  std::vector<bool> taken(nodes_.size());
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    Node& node = nodes_[i];
    if (node.parent == kNone) {
      node.before = 0;
    } else if (const std::uint32_t above = nodes_[node.parent].before; above != kNone) {
      for (std::uint32_t c = above + 1; c < before.nodes_[above].end; c = before.nodes_[c].end)
        if (before.nodes_[c].slot == node.slot) node.before = c;
    }
    if (node.before == kNone || before.nodes_[node.before].handle >= nodes_.size()) continue;
    node.handle = before.nodes_[node.before].handle;
    taken[node.handle] = true;
  }
  NodeHandle free = 0;
  for (Node& node : nodes_) {
    if (node.before != kNone && before.nodes_[node.before].handle < nodes_.size()) continue;
    while (taken[free]) ++free;
    node.handle = free;
    taken[free] = true;
  }
}

Counters OwnView::counters() const {
  Counters c{.nodes = nodes_.size(), .entries = bodies_.size()};
  for (const Node& node : nodes_) {
    ++(node.leaf ? c.leaves : c.splits);
    c.depth = std::max<std::uint64_t>(c.depth, node.depth);
  }
  return c;
}

std::vector<Event> OwnView::events_since(const OwnView& before, BodyId body,
                                         const OwnRules& rules) const {
  std::vector<Event> events;
  const auto tell = [&](Event::Kind kind, const Node& node, std::uint32_t count) {
    events.push_back({kind, node.handle, body, count, count > 0 ? rules.capacity : 0});
  };
  const auto holds = [&](const OwnView& view, const Node& node) {
    return std::ranges::binary_search(view.bodies(node), body);
  };
  for (const Node& node : nodes_) {
    const Node* old = node.before == kNone ? nullptr : &before.nodes_[node.before];
    if (!old) tell(Event::Kind::make_child, node, 0);
    if (old && old->leaf && !node.leaf) tell(Event::Kind::split, node, old->count + 1);
    if (!node.leaf || !holds(*this, node) || (old && old->leaf && holds(before, *old))) continue;
    tell(Event::Kind::store, node, node.count);
    if (node.count > rules.capacity && node.depth == rules.max_depth)
      tell(Event::Kind::depth_limit, node, node.count);
  }
  return events;
}

}  // namespace lantern::spatial
