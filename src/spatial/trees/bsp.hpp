// Binary space partitioning on given planes: each inner node has a plane, and two children, one for
// what lies behind it and one for what lies in front.
//
//          behind | in front           [plane]          0 = behind (the lecture's left child)
//           bat   |   ball             /     \          1 = in front
//                 |-->  normal     (bat)     (ball)     What touches the plane is stored in both.
//
// No overlapping pair is ever parted, rounding or not: products and sums are rounded monotonically,
// so the height over the plane of a point that two boxes share, computed in the same order, lies
// between the least and the greatest height of both boxes. Whatever side it falls on, both reach.
#pragma once

#include "spatial/structure_of.hpp"
#include "spatial/trees/node_parts.hpp"

namespace lantern::spatial {

template <int D>
class Bsp final : public StructureOf<Bsp<D>, D> {
 public:
  static constexpr Zones kZones = Zones::half_spaces;

  // The first plane is the root's; parents stand before their children. Throws Refused for a list
  // in another order, two planes in one place, a normal that is zero or not finite, more than
  // kDeepestBsp planes one below the other, and for bounds that are not valid. Without planes the
  // tree is a single leaf. `bounds` is the box that every node shows; it cuts nothing off.
  explicit Bsp(const StructureConfig<D>& config)
      : planes_(config.planes),
        bounds_(config.bounds),
        most_entries_(config.most_entries),
        contents_(4) {
    if (!is_valid(bounds_)) throw Refused("BSP: its bounds are not finite or inverted");
    nodes_.reserve(2 * planes_.size() + 1);
    nodes_.push_back({});
    for (std::uint32_t i = 0; i < planes_.size(); ++i) add_plane(i);
    allocations_ = 1;
  }

  // Stores the item in every leaf that its box reaches.
  template <class Observer>
  void add(const Item<D>& item, Observer&& observer) {
    items_.push_back(item);
    leaf_boxes_.forget();
    put(0, static_cast<std::uint32_t>(items_.size() - 1), observer);
  }

  // The planes stay.
  void clear() override {
    contents_.clear();
    items_.clear();
    leaf_boxes_.forget();
    for (Node& node : nodes_) node.contents = {};
    entries_ = box_tests_ = 0;
  }

  template <class F>
  void take(Tour<D> tour, F&& f) const {
    visit_from(0, kNone, tour, f);
  }

  std::uint64_t near(const Box<D>& box, std::vector<BodyId>& ids) const override {
    return collect(0, box, ids);
  }

  // --- asked by rows, see query_walk.hpp ---

  using Place = NodeHandle;
  bool has_rows() const { return leaf_boxes_.is_due(); }
  const LeafBoxes<D>& boxes() const {
    return leaf_boxes_.made([&](LeafBoxes<D>& boxes) {
      boxes.fill(
          contents_.places(), nodes_.size(), [&](NodeHandle i) { return leaf_run(i); },
          [&](std::uint32_t at) -> auto& { return items_[contents_.value(at)]; });
    });
  }
  Place root() const { return 0; }
  std::optional<LeafRun> leaf_run(Place at) const {
    const Node& node = nodes_[at];
    if (!node.is_leaf()) return std::nullopt;
    return LeafRun{node.contents.first, node.contents.count};
  }
  template <class Probe, class F>
  void open(Place at, const Probe& probe, const typename Probe::Part& part, F&& f) const {
    const Node& node = nodes_[at];
    const Plane<D>& plane = tested_[node.plane];
    const NodeHandle first = probe.front_first(plane) ? 1 : 0;
    for (const NodeHandle child : {first, 1 - first})
      f(node.first_child + child, probe.beside(part, plane, child == 1));
  }

  // `box_tests` counts tests against a plane.
  Counters counters() const override {
    return {.nodes = nodes_.size(),
            .leaves = planes_.size() + 1,
            .depth = deepest_,
            .entries = entries_,
            .box_tests = box_tests_,
            .allocations = allocations_ + contents_.allocations()};
  }

 private:
  struct Node {
    std::uint32_t plane = kNone;  // of an inner node
    NodeHandle first_child = 0;   // the one behind; the one in front is next to it
    std::uint32_t slot = 0;
    std::uint32_t depth = 0;
    LeafArray::Run contents;
    bool is_leaf() const { return plane == kNone; }
  };

  // The leaf at the plane's place becomes an inner node with two leaves.
  void add_plane(std::uint32_t index) {
    const BspPlane<D>& p = planes_[index];
    const auto refuse = [&](const char* why) { throw Refused("BSP: plane {} {}", index, why); };
    if (!is_finite(p.plane.normal)) refuse("has a normal that is not finite");
    if (p.plane.normal == Vec<D>(0.0)) refuse("has a normal of zero length");
    if (!std::isfinite(p.plane.offset)) refuse("has an offset that is not finite");
    if (index == 0 && p.parent != kNone) refuse("is the first, so it cannot have a parent");
    if (index > 0 && p.parent >= index) refuse("must stand after its parent");
    const NodeHandle node =
        index == 0 ? 0 : nodes_[node_of_plane_[p.parent]].first_child + (p.front ? 1u : 0u);
    if (!nodes_[node].is_leaf()) refuse("has the same place as one before it");
    tested_.push_back(scaled(p.plane));
    const std::uint32_t depth = nodes_[node].depth + 1;
    if (depth > kDeepestBsp) refuse("lies too deep");
    nodes_[node].plane = index;
    nodes_[node].first_child = static_cast<NodeHandle>(nodes_.size());
    node_of_plane_.push_back(node);
    for (std::uint32_t slot = 0; slot < 2; ++slot) nodes_.push_back({kNone, 0, slot, depth, {}});
    deepest_ = std::max<std::uint64_t>(deepest_, depth);
  }

  // The item reaches this node.
  template <class Observer>
  void put(NodeHandle handle, std::uint32_t number, Observer& observer) {
    stop_if_asked();
    const Item<D>& item = items_[number];
    observer(Event{Event::Kind::test, handle, item.id, 0, 0});
    Node& node = nodes_[handle];
    if (node.is_leaf()) {
      if (entries_ == most_entries_)
        throw Refused(
            "body {}: with it the BSP's leaves hold more than {} entries; "
            "use fewer planes or bodies",
            item.id, most_entries_);
      contents_.append(node.contents, number);
      ++entries_;
      observer(Event{Event::Kind::store, handle, item.id, node.contents.count, 0});
      return;
    }
    const Reach sides = reach(item.box, tested_[node.plane]);
    ++box_tests_;
    put_or_miss(node.first_child, sides.back, number, observer);
    put_or_miss(node.first_child + 1, sides.front, number, observer);
  }

  template <class Observer>
  void put_or_miss(NodeHandle handle, bool reached, std::uint32_t number, Observer& observer) {
    if (reached)
      put(handle, number, observer);
    else
      observer(Event{Event::Kind::miss, handle, items_[number].id, 0, 0});
  }

  void add_ids(const Node& node, std::vector<BodyId>& ids) const {
    for (const std::uint32_t item : contents_.values(node.contents)) ids.push_back(items_[item].id);
  }

  template <class F>
  void visit_from(NodeHandle handle, std::uint32_t parent, Tour<D>& tour, F& f) const {
    stop_if_asked();
    const Node& node = nodes_[handle];
    NodeView<D> view = tour.view(handle, parent, node.slot, node.depth, node.is_leaf(), bounds_);
    if (!view.leaf) view.plane = &planes_[node.plane].plane;
    tour.ids.clear();
    add_ids(node, tour.ids);
    std::ranges::sort(tour.ids);
    view.bodies = tour.ids;
    if (!f(std::as_const(view)) || view.leaf) return;
    double along = 0;  // a ray along the plane's normal comes from behind
    for (int i = 0; i < D; ++i) along += tested_[node.plane].normal[i] * tour.toward[i];
    const NodeHandle first = along < 0 ? 1 : 0;
    visit_from(node.first_child + first, view.id, tour, f);
    visit_from(node.first_child + 1 - first, view.id, tour, f);
  }

  // How many planes it was tested against.
  std::uint64_t collect(NodeHandle handle, const Box<D>& box, std::vector<BodyId>& ids) const {
    const Node& node = nodes_[handle];
    if (node.is_leaf()) {
      add_ids(node, ids);
      return 0;
    }
    const Reach sides = reach(box, tested_[node.plane]);
    std::uint64_t tests = 1;
    if (sides.back) tests += collect(node.first_child, box, ids);
    if (sides.front) tests += collect(node.first_child + 1, box, ids);
    return tests;
  }

  std::vector<BspPlane<D>> planes_;  // as given, for views
  std::vector<Plane<D>> tested_;     // the same, scaled
  std::vector<NodeHandle> node_of_plane_;
  std::vector<Node> nodes_;
  Box<D> bounds_;
  std::uint64_t most_entries_;
  std::vector<Item<D>> items_;
  LeafArray contents_;                              // numbers of items
  mutable MadeWhenAsked<LeafBoxes<D>> leaf_boxes_;  // by the places of contents_
  std::uint64_t entries_ = 0;
  std::uint64_t deepest_ = 0;
  std::uint64_t box_tests_ = 0;
  std::uint64_t allocations_ = 0;
};

}  // namespace lantern::spatial
