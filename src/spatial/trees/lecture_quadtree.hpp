// The lecture's own quadtree (src/lecture) as a structure like all others. It allocates for every
// object in every leaf and for every split, and frees everything when it is cleared: the naive
// baseline.
#pragma once

#include <utility>

#include "lecture/quad_tree.hpp"
#include "spatial/trees/orthtree.hpp"

namespace lantern::spatial {

class LectureQuadtree final : public StructureOf<LectureQuadtree, 2> {
  using Tree = lecture::QuadTree<BodyId>;
  using Node = lecture::QuadTreeNode<BodyId>;
  // Told wherever it is built, also where a pointer has fewer than 8 bytes.
  static constexpr std::uint64_t kNodeBytes = 88;
  static_assert(sizeof(void*) != 8 || sizeof(Node) == kNodeBytes);
  using Entries = std::list<lecture::QuadTreeEntry<BodyId>>;

 public:
  static constexpr Zones kZones = Zones::endless_rim;

  // Throws Refused as the quadtree does. A split makes all children, and only the depth limit
  // stops splits, whatever is configured.
  explicit LectureQuadtree(const StructureConfig<2>& config)
      : config_(checked(config)), tree_(empty_tree()) {}

  // As Orthtree::add, with its events.
  template <class Observer>
  void add(const Item<2>& item, Observer&& observer) {
    const auto [pos, size] = flat(item.box);
    Watch<Observer> watch{*this, observer, item.id};
    tree_.Insert(item.id, pos, size, watch);
  }

  void clear() override {
    tree_ = empty_tree();
    const std::uint64_t allocations = counters_.allocations;
    counters_ = {.nodes = 1, .allocations = allocations};
  }

  template <class F>
  void take(Tour<2> tour, F&& f) const {
    const bool ahead = tour.toward != Vec<2>(0.0);
    const std::uint32_t first = ahead ? Halving<2>::first_toward(tour.toward) : 0;
    visit_from(tree_.GetRoot(), NodeView<2>{.box = config_.bounds}, first, tour, f);
  }

  std::uint64_t near(const Box<2>& box, std::vector<BodyId>& ids) const override {
    const auto [pos, size] = flat(box);
    tree_.OperateOnContents(
        [&](const Entries& data) {
          for (const auto& entry : data) ids.push_back(entry.object);
        },
        pos, size);
    return 0;
  }

  Counters counters() const override {
    Counters c = counters_;
    c.leaves = c.nodes - c.splits;
    c.node_bytes = c.nodes * kNodeBytes;
    return c;
  }

 private:
  using Vector3 = lecture::Vector3;

  static const StructureConfig<2>& checked(const StructureConfig<2>& config) {
    Quadtree tree({.bounds = config.bounds,  // which does the checking
                   .capacity = config.capacity,
                   .max_depth = config.max_depth});
    return config;
  }

  Tree empty_tree() const {
    const Box<2>& box = config_.bounds;
    return Tree(box.hi * 0.5 - box.lo * 0.5, static_cast<int>(config_.max_depth),
                static_cast<int>(config_.capacity), Halving<2>::middle(box), config_.as_printed);
  }

  // Centre and half sizes, as the text wants them. Of a box that is endless on one side they would
  // lose the other, so the box is clamped to the root first, as the tree would do anyway, unless it
  // is as printed.
  std::pair<Vector3, Vector3> flat(const Box<2>& box) const {
    Vector3 pos(0.0), size(0.0);
    for (const int axis : {0, 1}) {
      const Box<2>& room = config_.as_printed ? box : config_.bounds;
      const double from = room.lo[axis], to = room.hi[axis];
      const double lo = std::clamp(box.lo[axis], from, to), hi = std::clamp(box.hi[axis], from, to);
      pos[2 * axis] = lo * 0.5 + hi * 0.5;
      size[2 * axis] = hi * 0.5 - lo * 0.5;
    }
    return {pos, size};
  }

  // Counts what the tree does, and tells the observer.
  template <class Observer>
  struct Watch {
    LectureQuadtree& tree;
    Observer& observer;
    BodyId last;

    void tell(Event::Kind kind, const Node& node, BodyId body, std::uint32_t count = 0) {
      observer(Event{kind, handle(node), body, count, count > 0 ? tree.config_.capacity : 0});
    }
    void Tested(const Node& node, BodyId body, bool reached) {
      stop_if_asked();
      ++tree.counters_.box_tests;
      tell(reached ? Event::Kind::test : Event::Kind::miss, node, body);
    }
    void Stored(const Node& node, BodyId body, int depthLeft) {
      Counters& c = tree.counters_;
      const auto count = static_cast<std::uint32_t>(node.GetContents().size());
      tree.require_room(++c.entries, "entries", body);
      ++c.allocations;
      tell(Event::Kind::store, node, body, count);
      if (count <= tree.config_.capacity) return;
      tell(depthLeft > 0 ? Event::Kind::split : Event::Kind::depth_limit, node, body, count);
    }
    void Split(const Node& node, BodyId /*last*/, int depthLeft) {
      Counters& c = tree.counters_;
      ++c.splits;
      ++c.allocations;
      c.entries -= node.GetContents().size();
      c.depth = std::max<std::uint64_t>(c.depth, tree.config_.max_depth - depthLeft + 1);
      tree.require_room(c.nodes + 4, "nodes", last);
    }
    void Made(Node& child) {
      child.number = static_cast<int>(tree.counters_.nodes++);
      tell(Event::Kind::make_child, child, last);
    }
    void HandedDown(const Node& node, BodyId body) { tell(Event::Kind::hand_down, node, body); }
  };

  void require_room(std::uint64_t wanted, const char* what, BodyId body) const {
    if (wanted <= config_.most_entries) return;
    throw Refused(
        "body {}: with it the tree needs more than {} {} ({} nodes, {} entries); lower max_depth "
        "({}) or raise capacity ({})",
        body, config_.most_entries, what, counters_.nodes, counters_.entries, config_.max_depth,
        config_.capacity);
  }

  static NodeHandle handle(const Node& node) {  // the root has none of its own
    return static_cast<NodeHandle>(std::max(node.number, 0));
  }

  // Boxes are halved on the way down, so that neighbours share their borders exactly; the tree's
  // own centres and sizes are rounded.
  template <class F>
  void visit_from(const Node& node, NodeView<2> view, std::uint32_t first, Tour<2>& tour,
                  F& f) const {
    stop_if_asked();
    view.handle = handle(node);
    view.id = tour.next_id++;
    view.leaf = node.GetChildren().empty();
    tour.ids.clear();
    if (view.leaf)
      for (const auto& entry : node.GetContents()) tour.ids.push_back(entry.object);
    std::sort(tour.ids.begin(), tour.ids.end());
    view.bodies = tour.ids;
    if (!f(std::as_const(view)) || view.leaf) return;
    const Vec<2> middle = Halving<2>::middle(view.box);
    for (std::uint32_t i = 0; i < 4; ++i) {
      if (node.GetChildren()[i ^ first].number < 0) continue;  // in the midst of a split
      NodeView<2> child = view;
      child.parent = view.id;
      child.slot = i ^ first;
      child.depth = view.depth + 1;
      child.box = Halving<2>::child(view.box, middle, child.slot);
      visit_from(node.GetChildren()[child.slot], child, first, tour, f);
    }
  }

  StructureConfig<2> config_;
  Tree tree_;
  Counters counters_{.nodes = 1};
};

}  // namespace lantern::spatial
