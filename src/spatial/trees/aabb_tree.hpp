// A dynamic tree of axis-aligned bounding boxes, as game engines use it (Bullet's btDbvt, Box2D's
// b2DynamicTree; Erin Catto, "Dynamic Bounding Volume Hierarchies", GDC 2019).
//
//            [a b c]                 Each leaf holds one body, each inner node the smallest box
//           /       \                around its two children. Boxes of siblings may overlap: a
//        [a b]      [c]              query may have to look into both.
//        |   |
//       [a] [b]
//
// Insertion: the new leaf becomes the neighbour of that node with which the surfaces (in 2D the
// perimeters) of all boxes grow least, since a ray or box meets a box the more often the larger its
// surface is (the surface-area heuristic). Descending, a branch is left out if even its best node
// could not be better than the best so far. On the way up the boxes are mended, and a child changes
// places with a child of its sibling where that makes a box smaller (a rotation: Kensler, "Tree
// Rotations for Improving Bounding Volume Hierarchies", 2008).
//
// All at once (`build`), the bodies are halved where the sum of surfaces, each times the bodies
// within, is least of 16 places on the axis on which the centres lie farthest apart (Wald, "On Fast
// Construction of SAH-based Bounding Volume Hierarchies", 2007). This asks for boxes and ids only,
// so the tree does not depend on the order of the items.
//
// Leaves' boxes are enlarged by `margin` on every side: a body that moves within its enlarged box
// changes nothing. One that leaves it is taken out and inserted again (`update`).
//
// Boxes are kept in float, rounded outward; who is handed a body compares the true box.
#pragma once

#include "spatial/structure_of.hpp"
#include "spatial/trees/aabb_rows.hpp"

namespace lantern::spatial {

template <int D>
class AabbTree final : public StructureOf<AabbTree<D>, D>, CountsAllocations {
 public:
  using Node = AabbNode<D>;

  static constexpr Zones kZones = Zones::fitted;
  static constexpr bool kHoldsOnce = true;
  // A tree that insertions have made higher is built anew.
  static constexpr std::uint32_t kHighest = 100;

  // Throws Refused for a margin that is negative or not finite.
  explicit AabbTree(const StructureConfig<D>& config = {})
      : margin_(config.margin), following_(config.following) {
    if (!(margin_ >= 0 && std::isfinite(margin_)))
      throw Refused("AABB tree: margin is {}, must be finite and at least 0", margin_);
    clear();
  }

  // Throws Refused beyond 2^25 bodies; nothing changes then.
  template <class Observer>
  void add(const Item<D>& item, Observer&& observer) {
    require_places(bodies() + 1);
    changed();
    put(Node::leaf(item, margin_), observer);
  }

  // Time: O(n log n).
  void make(Items<D> items);

  // These items, whose boxes may have changed since they were built: those in the tree, in any
  // order, ids being 0 … n-1 (else the tree is built anew). If few have left their enlarged boxes,
  // these are taken out and inserted again; if many have, all boxes are mended where they stand,
  // and once the tree has become much worse by that, it is built anew; or as its `following` says.
  // `watch`, if there is one, is told who leaves and how each is inserted. Throws Refused as
  // `insert` does; nothing changes then.
  bool update(Items<D> items, const EventWatch& watch = {}) override;

  void clear() override {
    nodes_.assign(2, Node{});
    free_.clear();
    changed();
    cost_ = 0;
    box_tests_ = splits_ = reinserted_ = refitted_ = 0;
  }

  std::uint32_t bodies() const { return nodes_[kRoot].bodies(); }

  template <class F>
  void take(Tour<D> tour, F&& f) const {
    visit_from(kRoot, kNone, 0, 0, tour, f);
  }

  // Those whose enlarged boxes the box overlaps, each once.
  std::uint64_t near(const Box<D>& box, std::vector<BodyId>& ids) const override {
    return bodies() == 0 ? 1 : collect(kRoot, Node::leaf({0, box}, 0), ids);
  }

  // See query_walk.hpp. With a margin the boxes are not the bodies' own: none of them is sure.
  bool has_rows() const { return rows_.is_due(); }
  template <class Probe, class Limit, class Soon, class F>
  WalkCounts each_met(const Probe& probe, Limit& limit, Soon& soon, F& f) const {
    const AabbRows<D>& rows = rows_.made([&](AabbRows<D>& made) { write(made); });
    auto told = [&](BodyId id, bool is_sure) { f(id, is_sure && margin_ == 0); };
    return rows.each_met(probe, limit, soon, told);
  }

  // The tree in rows, instead of what they hold.
  void write(AabbRows<D>& rows) const { rows.make(nodes_, kRoot); }

  // Compared are those bodies whose enlarged boxes overlap: the tree is walked against itself, and
  // where two nodes do not overlap, nothing below them does. Returns the nodes compared with nodes
  // on the way.
  std::uint64_t meet(FunctionRef<bool(BodyId)> awake, FunctionRef<void(BodyId, BodyId)> f) const {
    std::uint64_t compared = 0, nodes = 0;
    const auto told = [&](const Node& a, const Node& b) {
      if (!awake(a.link) && !awake(b.link)) return;
      ++compared;
      f(a.link, b.link);
    };
    each_pair_within(kRoot, told, nodes);
    return nodes - compared;
  }

  // The same walk, but down to nodes with some bodies only: these are then compared, all with all,
  // several by one instruction. So more boxes are compared, in less time.
  std::uint64_t find_pairs(std::span<const Box<D>> exact, FoundPairs& found);

  Counters counters() const override {
    const std::uint64_t n = bodies(), nodes = n < 2 ? 1 : 2 * n - 1;
    return {.nodes = nodes,
            .leaves = std::max<std::uint64_t>(n, 1),
            .depth = nodes_[kRoot].height(),
            .entries = n,
            .box_tests = box_tests_,
            .splits = splits_,
            .allocations = allocations_,
            .reinserted = reinserted_,
            .refitted = refitted_};
  }

 private:
  static constexpr NodeHandle kRoot = 1;  // at its children begin the pairs of siblings: 2, 4, ...

  // A node, and the place of its first body among all.
  struct Spot {
    NodeHandle node = 0;
    std::uint32_t first = 0;
  };
  // The way from the root to a node.
  struct Way {
    std::array<NodeHandle, Node::kTallest + 1> nodes;
    std::uint32_t length = 0;
    void add(NodeHandle node) { nodes[length++] = node; }
  };

  void require_places(std::size_t count) const;

  // What others see of a place: no gaps from 0 on.
  static NodeHandle handle_of(NodeHandle place) { return place - 1; }

  void changed() {
    rows_.forget();
    listed_ = false;
  }

  // --- inserting ---

  NodeHandle two_places() {
    if (!free_.empty()) {
      const NodeHandle first = free_.back();
      free_.pop_back();
      return first;
    }
    append(nodes_, Node{});
    append(nodes_, Node{});
    return static_cast<NodeHandle>(nodes_.size() - 2);
  }

  template <class Observer>
  void put(const Node& leaf, Observer& observer) {
    if (bodies() == 0) {
      nodes_[kRoot] = leaf;
      observer(Event{Event::Kind::store, handle_of(kRoot), leaf.link, 1, 1});
      return;
    }
    Way way = way_to_best(leaf, observer);
    const NodeHandle place = way.nodes[way.length - 1];
    const NodeHandle first = two_places();
    observer(Event{Event::Kind::split, handle_of(place), leaf.link, 2, 1});
    nodes_[first] = nodes_[place];
    nodes_[first + 1] = leaf;
    nodes_[place].link = first;
    nodes_[place].enclose(nodes_[first], nodes_[first + 1]);
    ++splits_;
    enclose(way, way.length);
    observer(Event{Event::Kind::store, handle_of(first + 1), leaf.link, 1, 1});
    rotate(way, leaf.link, observer);
    if (nodes_[kRoot].height() > kHighest) build_of_leaves();
  }

  // Down to that node for which the areas of the new parent and of all above it grow least.
  template <class Observer>
  Way way_to_best(const Node& leaf, Observer& observer) {
    Way way;
    NodeHandle at = kRoot;
    const float own = leaf.area();
    float direct = nodes_[kRoot].area_with(leaf);  // of a parent of both
    float inherited = 0;                           // by which the nodes above grow
    float best = direct;
    std::uint32_t best_length = 1;
    for (;;) {
      way.add(at);
      const Node& node = nodes_[at];
      observer(Event{Event::Kind::test, handle_of(at), leaf.link, 0, 0});
      ++box_tests_;
      // Of equal ones the deepest, so that coincident bodies make no chain.
      if (direct + inherited <= best) {
        best = direct + inherited;
        best_length = way.length;
      }
      if (node.is_leaf()) break;
      inherited += direct - node.area();
      const NodeHandle child[2] = {node.link, node.link + 1};
      float with[2], least[2];
      for (const int i : {0, 1}) {
        with[i] = nodes_[child[i]].area_with(leaf);
        // Below a child its box grows as well, and a parent is no smaller than the new leaf.
        least[i] = inherited + with[i] +
                   (nodes_[child[i]].is_leaf() ? 0 : std::min(own - nodes_[child[i]].area(), 0.0f));
      }
      const bool lighter = nodes_[child[1]].bodies() < nodes_[child[0]].bodies();
      const int to = least[1] < least[0] || (least[1] == least[0] && lighter) ? 1 : 0;
      if (best < least[to]) break;
      observer(Event{Event::Kind::miss, handle_of(child[1 - to]), leaf.link, 0, 0});
      at = child[to];
      direct = with[to];
    }
    way.length = best_length;
    return way;
  }

  void enclose(NodeHandle at) {
    Node& node = nodes_[at];
    node.enclose(nodes_[node.link], nodes_[node.link + 1]);
  }
  // The first `length` nodes of the way, from the last up to the root.
  void enclose(const Way& way, std::uint32_t length) {
    while (length-- > 0) enclose(way.nodes[length]);
  }

  template <class Observer>
  void rotate(const Way& way, BodyId body, Observer& observer) {
    for (std::uint32_t i = way.length; i-- > 0;) {
      const NodeHandle turned = rotate(nodes_[way.nodes[i]]);
      enclose(way.nodes[i]);
      if (std::is_same_v<Observer, NoObserver> || turned == kNone) continue;
      enclose(way, i);  // it may look at them
      observer(Event{Event::Kind::rotate, handle_of(turned), body, 0, 0});
    }
  }

  // Changes a child with a child of its sibling, if the sibling's box shrinks by that: with the one
  // by which it shrinks most. The sibling; kNone if none shrinks.
  NodeHandle rotate(const Node& node) {
    NodeHandle up = kNone, down = kNone, sibling = kNone;
    float most = 0;
    for (const NodeHandle side : {0u, 1u}) {
      const NodeHandle mover = node.link + side, other = node.link + 1 - side;
      const Node& o = nodes_[other];
      if (o.is_leaf()) continue;
      for (const NodeHandle i : {0u, 1u}) {
        const float gain = o.area() - nodes_[mover].area_with(nodes_[o.link + 1 - i]);
        if (!(gain > most)) continue;
        most = gain;
        down = mover;
        up = o.link + i;
        sibling = other;
      }
    }
    if (sibling == kNone) return kNone;
    std::swap(nodes_[down], nodes_[up]);
    enclose(sibling);
    return sibling;
  }

  // --- building mending and pairing (aabb_tree.cpp) ---

  // Some of the leaves that stand behind a growing tree.
  struct Leaves {
    std::size_t first = 0, count = 0;
  };
  void make_room(std::size_t leaves);
  void build_of_leaves();
  void grow_all(std::size_t leaves);
  void grow(NodeHandle at, Leaves leaves, std::uint32_t height);
  std::size_t cut(std::span<Node> leaves, std::uint32_t height);
  void take_out_and_put_back(const Items<D>& items, const EventWatch& watch);
  void tell_leaving(NodeHandle at, const Items<D>& items, const EventWatch& watch) const;
  bool suits(const Node& leaf, const Item<D>& item) const;
  bool keep_those_that_suit(NodeHandle at, const Items<D>& items);
  double mend_all(NodeHandle at, const Items<D>& items);
  template <class BoxOf>
  std::uint32_t put_into(BoxTable<D>& table, NodeHandle at, std::uint32_t place, BoxOf& box_of);
  void pair_within(const Spot& at, const BoxTable<D>& table, RunScanner<D>& runs) const;
  void pair_between(const Spot& of_a, const Spot& of_b, const BoxTable<D>& table,
                    RunScanner<D>& runs) const;
  Spot child(const Spot& at, NodeHandle which) const {
    const NodeHandle first = nodes_[at.node].link;
    return {first + which, at.first + (which == 0 ? 0 : nodes_[first].bodies())};
  }

  // f(leaf, leaf) for those below that overlap, each pair once.
  template <class F>
  void each_pair_within(NodeHandle at, F& f, std::uint64_t& tests) const {
    stop_if_asked();
    const Node& node = nodes_[at];
    if (node.is_leaf()) return;
    each_pair_within(node.link, f, tests);
    each_pair_within(node.link + 1, f, tests);
    each_pair_between(node.link, node.link + 1, f, tests);
  }
  // The one below a, the other below b. The larger is opened.
  template <class F>
  void each_pair_between(NodeHandle at_a, NodeHandle at_b, F& f, std::uint64_t& tests) const {
    const Node &a = nodes_[at_a], &b = nodes_[at_b];
    ++tests;
    if (!a.reaches(b)) return;
    if (a.is_leaf() && b.is_leaf()) return f(a, b);
    const bool opens_a = b.is_leaf() || (!a.is_leaf() && a.area() >= b.area());
    for (const NodeHandle i : {0u, 1u})
      opens_a ? each_pair_between(a.link + i, at_b, f, tests)
              : each_pair_between(at_a, b.link + i, f, tests);
  }

  // --- looking ---

  template <class F>
  void visit_from(NodeHandle at, std::uint32_t parent, std::uint32_t slot, std::uint32_t depth,
                  Tour<D>& tour, F& f) const {
    stop_if_asked();
    const Node& node = nodes_[at];
    NodeView<D> view =
        tour.view(handle_of(at), parent, slot, depth, node.is_leaf(), finite(node.box()));
    view.bodies = std::span(&node.link, node.bodies() == 1 ? 1 : 0);
    if (!f(std::as_const(view)) || view.leaf) return;
    const NodeHandle first = second_first(node, tour.toward) ? 1 : 0;
    visit_from(node.link + first, view.id, first, depth + 1, tour, f);
    visit_from(node.link + 1 - first, view.id, 1 - first, depth + 1, tour, f);
  }

  // How many tests it took, but those that led to a body.
  std::uint64_t collect(NodeHandle at, const Node& asked, std::vector<BodyId>& ids) const {
    const Node& node = nodes_[at];
    if (!node.reaches(asked)) return 1;
    if (!node.is_leaf())
      return 1 + collect(node.link, asked, ids) + collect(node.link + 1, asked, ids);
    ids.push_back(node.link);
    return 0;
  }

  // What is beyond the range of float ends where double ends.
  static Box<D> finite(const Box<D>& box) {
    constexpr double kMost = std::numeric_limits<double>::max();
    return {glm::max(box.lo, Vec<D>(-kMost)), glm::min(box.hi, Vec<D>(kMost))};
  }

  // Whether the middle of the second child lies before that of the first on a ray along d.
  bool second_first(const Node& node, const Vec<D>& d) const {
    double along = 0;
    for (int i = 0; i < D; ++i) {
      if (d[i] == 0) continue;
      const Node &a = nodes_[node.link], &b = nodes_[node.link + 1];
      along += d[i] * ((double{b.lo[i]} + b.hi[i]) - (double{a.lo[i]} + a.hi[i]));
    }
    return along < 0;
  }

  std::vector<Node> nodes_;  // from place 1 on; siblings side by side
  double margin_;
  Following following_;
  double cost_ = 0;              // areas of all inner nodes, when it was built last
  std::uint64_t box_tests_ = 0;  // since it was built, or followed its bodies last
  std::uint64_t splits_ = 0;
  std::uint64_t reinserted_ = 0, refitted_ = 0;  // when it followed them last

  mutable MadeWhenAsked<AabbRows<D>> rows_;
  BoxTable<D> table_;    // of pairs: a branch is one run of it; with a margin of true boxes
  bool listed_ = false;  // the leaves' own stand there

  // While it grows: at the front of nodes_, and the leaves of which it is built stand at the back.
  struct Block {
    NodeHandle node = 0;
    Leaves leaves;
    std::uint32_t height = 0;
  };
  NodeHandle made_ = 0;        // places at the front
  std::size_t leaves_at_ = 0;  // where the first leaf stood
  std::size_t next_leaf_ = 0;  // those before it stand in the tree

  // Scratch, kept for its memory.
  std::vector<Block> blocks_;     // that are still to be made
  std::vector<NodeHandle> free_;  // pairs of places that nobody uses
  std::vector<BodyId> left_;      // bodies that are out of the tree
};

extern template class AabbTree<2>;
extern template class AabbTree<3>;

}  // namespace lantern::spatial
