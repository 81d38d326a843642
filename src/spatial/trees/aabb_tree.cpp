// How an AABB tree is built of all its bodies at once, follows them, and finds which overlap.
#include "spatial/trees/aabb_tree.hpp"

#include "base/check.hpp"

namespace lantern::spatial {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();

// A tree of n bodies may be this much higher than the lowest, so that even boxes within boxes
// within boxes make no chain.
constexpr std::uint32_t kSpareHeight = 8;
std::uint32_t lowest(std::size_t bodies) {
  return static_cast<std::uint32_t>(std::bit_width(bodies - 1));
}

// Twice where its middle lies; a number, however far out the box reaches.
template <int D>
float middle(const AabbNode<D>& leaf, int axis) {
  constexpr float kFar = 1e30f;
  return std::clamp(leaf.lo[axis], -kFar, kFar) + std::clamp(leaf.hi[axis], -kFar, kFar);
}

template <int D>
AabbNode<D> nowhere() {
  AabbNode<D> node;
  std::fill_n(node.lo, D, kInfinite);
  std::fill_n(node.hi, D, -kInfinite);
  return node;
}

struct Spread {
  int axis = 0;
  float from = 0, to = 0;
};

// Of the middles, on the axis on which they lie farthest apart.
template <int D>
Spread widest(std::span<const AabbNode<D>> leaves) {
  float from[D], to[D];
  for (int i = 0; i < D; ++i) from[i] = to[i] = middle(leaves[0], i);
  for (const AabbNode<D>& leaf : leaves)
    for (int i = 0; i < D; ++i) {
      const float at = middle(leaf, i);
      from[i] = std::min(from[i], at);
      to[i] = std::max(to[i], at);
    }
  Spread best{0, from[0], to[0]};
  for (int i = 1; i < D; ++i)
    if (to[i] - from[i] > best.to - best.from) best = {i, from[i], to[i]};
  return best;
}

// By where the middle lies, then by body.
template <int D>
auto before_on(int axis) {
  return [axis](const AabbNode<D>& a, const AabbNode<D>& b) {
    const float x = middle(a, axis), y = middle(b, axis);
    return x < y || (x == y && a.link < b.link);
  };
}

// Whether that many of all may lie on one side.
bool fits(std::size_t one_side, std::size_t all, std::uint32_t height) {
  return lowest(std::max(one_side, all - one_side)) < height;
}

// Of boxes in a row, of which each holds(box) bodies: the first of the upper side of the allowed
// cut that costs least; `otherwise` if none is allowed.
constexpr std::size_t kMostParts = 16;
template <int D, class Holds>
std::size_t best_cut(std::span<const AabbNode<D>> boxes, std::size_t bodies, std::uint32_t height,
                     std::size_t otherwise, Holds&& holds) {
  float behind[kMostParts];
  AabbNode<D> part = nowhere<D>();
  std::size_t count = 0;
  const auto cost_with = [&](const AabbNode<D>& box) {
    part.grow_around(part, box);
    count += holds(box);
    return count > 0 ? part.area() * static_cast<float>(count) : 0;
  };
  for (std::size_t i = boxes.size() - 1; i > 0; --i) behind[i] = cost_with(boxes[i]);
  part = nowhere<D>();
  count = 0;
  float least = kInfinite;
  for (std::size_t i = 1; i < boxes.size(); ++i) {
    const float cost = cost_with(boxes[i - 1]) + behind[i];
    if (cost < least && fits(count, bodies, height)) {
      least = cost;
      otherwise = i;
    }
  }
  return otherwise;
}

// Few leaves: sorted, and every place between two of them tried.
constexpr std::size_t kFew = 8;
template <int D>
std::size_t cut_few(std::span<AabbNode<D>> leaves, int axis, std::uint32_t height) {
  const std::size_t n = leaves.size();
  const auto before = before_on<D>(axis);
  for (std::size_t i = 1; i < n; ++i)
    for (std::size_t j = i; j > 0 && before(leaves[j], leaves[j - 1]); --j)
      std::swap(leaves[j], leaves[j - 1]);
  return best_cut<D>(leaves, n, height, n / 2, [](const AabbNode<D>&) { return 1u; });
}

// Many: counted into bins of equal width.
template <int D>
class Bins {
 public:
  static constexpr int kCount = kMostParts;

  explicit Bins(const Spread& spread)
      : axis_(spread.axis),
        from_(spread.from),
        scale_(static_cast<float>(kCount) / (spread.to - spread.from)) {
    boxes_.fill(nowhere<D>());
  }

  bool is_possible() const { return scale_ < kInfinite; }
  int of(const AabbNode<D>& leaf) const {
    return std::min(static_cast<int>((middle(leaf, axis_) - from_) * scale_), kCount - 1);
  }
  void add(const AabbNode<D>& leaf) {
    AabbNode<D>& box = boxes_[static_cast<std::size_t>(of(leaf))];
    box.grow_around(box, leaf);
    ++box.below;
  }

  // The first bin of the upper side; 0 if no cut is allowed.
  int best(std::size_t n, std::uint32_t height) const {
    return static_cast<int>(
        best_cut<D>(boxes_, n, height, 0, [](const AabbNode<D>& bin) { return bin.below; }));
  }

 private:
  int axis_;
  float from_, scale_;
  std::array<AabbNode<D>, kCount> boxes_;
};

}  // namespace

// Brings the leaves of the one child to the front; how many they are.
template <int D>
std::size_t AabbTree<D>::cut(std::span<Node> leaves, std::uint32_t height) {
  box_tests_ += leaves.size();
  if (leaves.size() == 2) {
    if (leaves[1].link < leaves[0].link) std::swap(leaves[0], leaves[1]);
    return 1;
  }
  const Spread spread = widest<D>(leaves);
  if (leaves.size() <= kFew) return cut_few<D>(leaves, spread.axis, height);
  Bins<D> bins(spread);
  int best = 0;
  if (bins.is_possible()) {
    for (const Node& leaf : leaves) bins.add(leaf);
    best = bins.best(leaves.size(), height);
  }
  auto upper = leaves.begin() + static_cast<std::ptrdiff_t>(leaves.size() / 2);
  if (best == 0)  // at the median
    std::nth_element(leaves.begin(), upper, leaves.end(), before_on<D>(spread.axis));
  else
    upper = std::partition(leaves.begin(), leaves.end(),
                           [&](const Node& leaf) { return bins.of(leaf) < best; });
  return static_cast<std::size_t>(upper - leaves.begin());
}

// Makes the node of these leaves, which are at least one. What lies below blocks is made later, so
// that the nodes above them, through which every walk goes, stand close together.
template <int D>
void AabbTree<D>::grow(NodeHandle at, Leaves leaves, std::uint32_t height) {
  if (leaves.count == 1) {
    nodes_[at] = nodes_[leaves_at_ + leaves.first];
    return;
  }
  if (leaves.count > 1024) stop_if_asked();
  const std::size_t few =
      cut(std::span(nodes_).subspan(leaves_at_ + leaves.first, leaves.count), height);
  LANTERN_CHECK(made_ + 2, <=, leaves_at_ + next_leaf_);
  const NodeHandle first = made_;
  made_ += 2;
  nodes_[first] = nodes_[first + 1] = Node{};
  nodes_[at].link = first;
  const bool is_of_block = leaves.count <= kRowBlock;
  for (const NodeHandle i : {0u, 1u}) {
    const Leaves part =
        i == 0 ? Leaves{leaves.first, few} : Leaves{leaves.first + few, leaves.count - few};
    if (is_of_block || part.count > kRowBlock)
      grow(first + i, part, height - 1);
    else
      append(blocks_, Block{first + i, part, height - 1});
  }
  if (is_of_block) enclose(at);
}

template <int D>
void AabbTree<D>::grow_all(std::size_t leaves) {
  free_.clear();
  blocks_.clear();
  changed();
  cost_ = 0;
  leaves_at_ = nodes_.size() - leaves;
  next_leaf_ = 0;
  made_ = 2;
  nodes_[kRoot] = Node{};
  grow(kRoot, {0, leaves}, lowest(leaves) + kSpareHeight);
  const std::size_t above = made_;
  for (const Block& block : blocks_) {
    next_leaf_ = block.leaves.first;
    grow(block.node, block.leaves, block.height);
  }
  nodes_.resize(made_);
  // Above the blocks children stand behind their parents.
  for (std::size_t i = above; i-- > kRoot && !blocks_.empty();)
    if (nodes_[i].below == 0) enclose(static_cast<NodeHandle>(i));
  for (const Node& node : nodes_) cost_ += node.is_leaf() ? 0 : node.area();
}

template <int D>
void AabbTree<D>::make(Items<D> items) {
  require_all_valid(items);
  require_places(items.size());
  clear();
  if (items.empty()) return;
  make_room(items.size());
  auto leaf = nodes_.end() - std::ssize(items);
  for (const Item<D>& item : items) *leaf++ = Node::leaf(item, margin_);
  grow_all(items.size());
  splits_ = items.size() - 1;
}

// Places for so many leaves at the back, and at the front for the tree of those that wait no more.
// A block of one leaf takes two places before it is reached; but many of them in a row would make
// the tree higher than it may be, so that a sixteenth of the leaves is more than enough.
template <int D>
void AabbTree<D>::make_room(std::size_t leaves) {
  const std::size_t places = std::max(nodes_.size(), 2 * leaves + leaves / 16 + 4 * kRowBlock);
  allocations_ += nodes_.capacity() < places;
  nodes_.resize(places);
}

template <int D>
void AabbTree<D>::build_of_leaves() {
  const std::size_t leaves = bodies(), places = nodes_.size();
  make_room(leaves);
  auto leaf = nodes_.end();
  for (std::size_t i = places; i-- > kRoot;)
    if (nodes_[i].bodies() == 1) *--leaf = nodes_[i];
  grow_all(leaves);
}

template <int D>
void AabbTree<D>::require_places(std::size_t count) const {
  if (count > Node::kMostBodies)
    throw Refused("AABB tree: {} bodies are more than it can hold, {}", count, Node::kMostBodies);
}

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
bool AabbTree<D>::update(Items<D> items, const EventWatch& watch) {
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
  if (!same || items.empty()) {
    make(items);
    return true;
  }
  box_tests_ = items.size();
  reinserted_ = refitted_ = 0;
  if (out == 0) return true;
  // To insert one costs some hundred times as much as to mend a node.
  constexpr std::size_t kFew = 64;
  constexpr double kMuchWorse = 1.3;
  const bool automatic = following_ == Following::automatic;
  if (following_ == Following::reinsert || (automatic && kFew * out < items.size()))
    take_out_and_put_back(items, watch);
  else if (!(mend_all(kRoot, items) <= kMuchWorse * cost_) && automatic)
    build_of_leaves();
  changed();
  return true;
}

template <int D>
void AabbTree<D>::take_out_and_put_back(const Items<D>& items, const EventWatch& watch) {
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
void AabbTree<D>::tell_leaving(NodeHandle at, const Items<D>& items,
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
bool AabbTree<D>::keep_those_that_suit(NodeHandle at, const Items<D>& items) {
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
  nodes_[first] = nodes_[first + 1] = Node{};  // no leaves, for who looks at all places
  append(free_, first);
  return one || two;
}

// Every leaf stays where it is. The areas of the inner nodes.
template <int D>
double AabbTree<D>::mend_all(NodeHandle at, const Items<D>& items) {
  Node& node = nodes_[at];
  ++box_tests_;
  if (node.is_leaf()) {
    const Item<D> item = items[node.link];
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
std::uint64_t AabbTree<D>::find_pairs(std::span<const Box<D>> exact, FoundPairs& found) {
  const BoxTable<D>& table = table_;
  if ((!listed_ || margin_ > 0) && bodies() > 0) {
    const std::size_t places = table_.places();
    table_.resize(bodies());
    const auto own = [](const Node& leaf) { return leaf.box(); };
    const auto true_box = [&](const Node& leaf) -> const Box<D>& { return exact[leaf.link]; };
    margin_ > 0 ? put_into(table_, kRoot, 0, true_box) : put_into(table_, kRoot, 0, own);
    allocations_ += table_.places() != places;
    listed_ = true;
  }
  RunScanner<D> runs(table, table, exact, found);
  if (bodies() > 0) pair_within({kRoot, 0}, table, runs);
  runs.finish();
  return runs.compared();
}

template <int D>
void AabbTree<D>::pair_within(const Spot& at, const BoxTable<D>& table, RunScanner<D>& runs) const {
  const Node& node = nodes_[at.node];
  if (node.bodies() <= kRowBlock) {
    const std::uint32_t end = at.first + node.bodies();
    for (std::uint32_t i = at.first; i < end; ++i) runs.add(i, i + 1, end);
    return;
  }
  const Spot one = child(at, 0), two = child(at, 1);
  pair_within(one, table, runs);
  pair_within(two, table, runs);
  pair_between(one, two, table, runs);
}

template <int D>
void AabbTree<D>::pair_between(const Spot& of_a, const Spot& of_b, const BoxTable<D>& table,
                               RunScanner<D>& runs) const {
  const Node &a = nodes_[of_a.node], &b = nodes_[of_b.node];
  if (!a.reaches(b)) return;
  if (a.bodies() <= kRowBlock && b.bodies() <= kRowBlock) {
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

template class AabbTree<2>;
template class AabbTree<3>;

const StructureEntry aabb_tree_entry{{.words = "AABB tree",
                                      .settings = bits_of({Setting::margin, Setting::following}),
                                      .meets_in_leaves = false,
                                      .holds_once = true,
                                      .splits = false,
                                      .hugs = true,
                                      .follows = true},
                                     made<AabbTree<2>>,
                                     made<AabbTree<3>>};

}  // namespace lantern::spatial
