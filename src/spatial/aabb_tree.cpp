// How an AABB tree follows its bodies, and finds which of them overlap.
#include "spatial/aabb_tree.hpp"

#include <algorithm>

namespace lantern::spatial {

// --- mending ---

// Whether the body may stay in its leaf as it is. Without a margin the leaf's box must be its own,
// so that pairs can be found by leaves alone.
template <int D>
bool AabbTree<D>::suits(const Node& leaf, const Item<D>& item) const {
  if (margin_ > 0) return leaf.holds(item.box);
  const Node own = Node::leaf(item, 0);
  bool same = true;
  for (int i = 0; i < D; ++i) same = same & (own.lo[i] == leaf.lo[i]) & (own.hi[i] == leaf.hi[i]);
  return same;
}

template <int D>
void AabbTree<D>::update(std::span<const Item<D>> items, const EventWatch& watch) {
  bool same = items.size() == bodies();
  for (std::size_t i = 0; i < items.size(); ++i) {
    require_valid(items[i]);
    same = same && items[i].id == i;
  }
  std::size_t out = 0;
  for (std::size_t i = kRoot; i < nodes_.size() && same; ++i) {
    if (!nodes_[i].is_leaf()) continue;
    same = nodes_[i].link < items.size();
    out += same && !suits(nodes_[i], items[nodes_[i].link]);
  }
  if (!same || items.empty()) return build(items);
  box_tests_ = items.size();
  reinserted_ = refitted_ = 0;
  if (out == 0) return listed_ ? void() : list();
  // To insert one costs some hundred times as much as to mend a node.
  constexpr std::size_t kFew = 64;
  constexpr double kMuchWorse = 1.3;
  const bool automatic = following_ == Following::automatic;
  listed_ = false;
  if (following_ == Following::reinsert || (automatic && kFew * out < items.size()))
    take_out_and_put_back(items, watch);
  else if (!(mend_all(kRoot, items) <= kMuchWorse * cost_) && automatic)
    build_of_leaves();
  list();
}

template <int D>
void AabbTree<D>::take_out_and_put_back(std::span<const Item<D>> items, const EventWatch& watch) {
  if (watch) tell_leaving(kRoot, items, watch);
  left_.clear();
  if (!keep_those_that_suit(kRoot, items)) nodes_[kRoot] = Node{};
  NoObserver nobody;
  for (const BodyId body : left_) {
    const Node leaf = Node::leaf(items[body], margin_);
    watch ? put(leaf, watch) : put(leaf, nobody);
  }
  reinserted_ = left_.size();
}

// While all are still in the tree.
template <int D>
void AabbTree<D>::tell_leaving(NodeHandle at, std::span<const Item<D>> items,
                               const EventWatch& watch) const {
  const Node& node = nodes_[at];
  if (!node.is_leaf()) {
    tell_leaving(node.link, items, watch);
    tell_leaving(node.link + 1, items, watch);
  } else if (!suits(node, items[node.link])) {
    watch({Event::Kind::leave, handle_of(at), node.link, 0, 0});
  }
}

// Takes the others out of the branch. False if none is left in it.
template <int D>
bool AabbTree<D>::keep_those_that_suit(NodeHandle at, std::span<const Item<D>> items) {
  Node& node = nodes_[at];
  ++box_tests_;
  if (node.is_leaf()) {
    const bool stays = suits(node, items[node.link]);
    if (!stays) append(left_, node.link);
    return stays;
  }
  const NodeHandle first = node.link;
  const bool one = keep_those_that_suit(first, items), two = keep_those_that_suit(first + 1, items);
  if (one && two) {
    node.enclose(nodes_[first], nodes_[first + 1]);
    return true;
  }
  if (one || two) node = nodes_[one ? first : first + 1];
  append(free_, first);
  return one || two;
}

// Every leaf stays where it is. The areas of the inner nodes.
template <int D>
double AabbTree<D>::mend_all(NodeHandle at, std::span<const Item<D>> items) {
  Node& node = nodes_[at];
  ++box_tests_;
  if (node.is_leaf()) {
    const Item<D>& item = items[node.link];
    if (suits(node, item)) return 0;
    node = Node::leaf(item, margin_);
    ++refitted_;
    return 0;
  }
  const double below = mend_all(node.link, items) + mend_all(node.link + 1, items);
  node.enclose(nodes_[node.link], nodes_[node.link + 1]);
  return below + node.area();
}

// --- pairing ---

// From the first leaf to the last, so that what lies below a node stands side by side. The place
// behind the last.
template <int D>
template <class BoxOf>
std::uint32_t AabbTree<D>::put_into(BoxTable<D>& table, NodeHandle at, std::uint32_t place,
                                    BoxOf& box_of) {
  const Node& node = nodes_[at];
  if (node.is_leaf()) {
    table.set(place, node.link, box_of(node));
    return place + 1;
  }
  return put_into(table, node.link + 1, put_into(table, node.link, place, box_of), box_of);
}

template <int D>
void AabbTree<D>::list() {
  const std::size_t places = table_.places();
  table_.resize(bodies());
  const auto own = [](const Node& leaf) { return leaf.box(); };
  if (bodies() > 0) put_into(table_, kRoot, 0, own);
  allocations_ += table_.places() != places;
  listed_ = true;
}

template <int D>
std::uint64_t AabbTree<D>::pair(std::span<const Item<D>> exact, FoundPairs& found) {
  if (!listed_) list();
  if (margin_ > 0 && bodies() > 0) {
    const std::size_t places = exact_.places();
    exact_.resize(bodies());
    const auto true_box = [&](const Node& leaf) -> const Box<D>& { return exact[leaf.link].box; };
    put_into(exact_, kRoot, 0, true_box);
    allocations_ += exact_.places() != places;
  }
  const BoxTable<D>& table = margin_ > 0 ? exact_ : table_;
  RunScanner<D> runs(table, table, exact, found);
  if (bodies() > 0) pair_within({kRoot, 0}, table, runs);
  runs.finish();
  return runs.compared();
}

template <int D>
void AabbTree<D>::pair_within(const AabbSpot& at, const BoxTable<D>& table,
                              RunScanner<D>& runs) const {
  const Node& node = nodes_[at.node];
  if (node.bodies() <= kAabbBlock) {
    const std::uint32_t end = at.first + node.bodies();
    for (std::uint32_t i = at.first; i < end; ++i) runs.add(i, i + 1, end);
    return;
  }
  const AabbSpot one = child(at, 0), two = child(at, 1);
  pair_within(one, table, runs);
  pair_within(two, table, runs);
  pair_between(one, two, table, runs);
}

template <int D>
void AabbTree<D>::pair_between(const AabbSpot& of_a, const AabbSpot& of_b, const BoxTable<D>& table,
                               RunScanner<D>& runs) const {
  const Node &a = nodes_[of_a.node], &b = nodes_[of_b.node];
  if (!a.reaches(b)) return;
  if (a.bodies() <= kAabbBlock && b.bodies() <= kAabbBlock) {
    for (std::uint32_t i = of_a.first; i < of_a.first + a.bodies(); ++i) {
      bool reaches = true;
      for (int axis = 0; axis < D; ++axis)
        reaches = reaches & (table.lo(axis)[i] <= b.hi[axis]) & (b.lo[axis] <= table.hi(axis)[i]);
      if (reaches) runs.add(i, of_b.first, of_b.first + b.bodies());
    }
    return;
  }
  for (const NodeHandle which : {0u, 1u})
    a.bodies() >= b.bodies() ? pair_between(child(of_a, which), of_b, table, runs)
                             : pair_between(of_a, child(of_b, which), table, runs);
}

template void AabbTree<2>::update(std::span<const Item<2>>, const EventWatch&);
template void AabbTree<3>::update(std::span<const Item<3>>, const EventWatch&);
template void AabbTree<2>::list();
template void AabbTree<3>::list();
template std::uint64_t AabbTree<2>::pair(std::span<const Item<2>>, FoundPairs&);
template std::uint64_t AabbTree<3>::pair(std::span<const Item<3>>, FoundPairs&);

}  // namespace lantern::spatial
