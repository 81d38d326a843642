// A kD-tree that is fitted to the objects (the lecture, "kD-Trees"): planes lie on objects' faces,
// and each node's box is the smallest one around what it holds.
//
//     +-----+ +---+           The plane lies on the upper face of an object: what ends there lies
//     |  a  | | b |           behind only. So objects that fit close together are parted, and those
//     |     |-+---+--+        that pass through (c) are stored on both sides.
//     |     ||   c   |
//     +-----+--------+        behind: box.lo <= plane    in front: box.hi > plane
//           ^ plane
//
// Two boxes that share a point share a leaf: the point lies on one side, and both reach that side.
//
// A node that holds more than `capacity` bodies and lies above `max_depth` is split where
// KdCuts says, unless there is no such plane; nothing more is split once the tree holds
// `most_entries` entries. The rule asks for boxes only, so the tree does not depend on the order of
// the items.
#pragma once

#include <tuple>

#include "spatial/structure_of.hpp"

namespace lantern::spatial {

// Where a kD-tree cuts a node, so that it fits the objects.
//
//   1. Axes are tried by the spread of the bodies' centres, the largest first (of equal ones, x
//      before y before z).
//   2. On an axis, the plane goes through the upper face nearest below or at the median of the
//      centres, or the nearest above it: the one that leaves fewer bodies on its fuller side, then
//      the one that cuts fewer bodies, then the lower one. It must leave something out on each side
//      and cut at most half of the bodies.
//   3. If no axis has such a plane, all upper faces of all axes are compared in the same way.
//   4. If that fails, too, there is no cut: either all boxes share a point, so that no plane parts
//      any pair (no progress), or every plane would copy more than it parts.
struct KdCut {
  int axis = 0;
  double plane = 0;
  std::size_t fuller = 0;  // bodies on the side that holds more
  std::size_t both = 0;    // bodies on both sides

  template <int D>
  bool behind(const Box<D>& box) const {
    return box.lo[axis] <= plane;
  }
  template <int D>
  bool in_front(const Box<D>& box) const {
    return box.hi[axis] > plane;
  }
  bool better_than(const KdCut& other) const {
    return std::tie(fuller, both, axis, plane) <
           std::tie(other.fuller, other.both, other.axis, other.plane);
  }
};

template <int D>
class KdCuts : CountsAllocations {
 public:
  // The cut of those items that are chosen, which are at least one. Keeps its scratch memory.
  std::optional<KdCut> best(std::span<const Item<D>> items, std::span<const std::uint32_t> chosen) {
    items_ = items;
    chosen_ = chosen;
    for (const int axis : axes_by_spread())
      if (const auto cut = at_median(axis)) return cut;
    std::optional<KdCut> best;
    for (int axis = 0; axis < D; ++axis) keep_better(best, best_of(axis));
    return best;
  }

  std::uint64_t tests = 0;  // comparisons of a body with a plane
  std::uint64_t allocations() const { return allocations_; }

 private:
  static void keep_better(std::optional<KdCut>& best, const std::optional<KdCut>& cut) {
    if (cut && (!best || cut->better_than(*best))) best = cut;
  }

  double center(std::uint32_t item, int axis) const {
    return 0.5 * items_[item].box.lo[axis] + 0.5 * items_[item].box.hi[axis];
  }

  std::array<int, D> axes_by_spread() const {
    std::array<double, D> spread{};
    std::array<int, D> axes{};
    for (int axis = 0; axis < D; ++axis) {
      double least = center(chosen_.front(), axis), most = least;
      for (const std::uint32_t i : chosen_) {
        least = std::min(least, center(i, axis));
        most = std::max(most, center(i, axis));
      }
      spread[axis] = most - least;
      axes[axis] = axis;
    }
    std::ranges::sort(axes, [&](int a, int b) {
      return spread[a] > spread[b] || (spread[a] == spread[b] && a < b);
    });
    return axes;
  }

  std::optional<KdCut> at_median(int axis) {
    lower_.clear();
    for (const std::uint32_t i : chosen_) append(lower_, center(i, axis));
    const auto middle = lower_.begin() + static_cast<std::ptrdiff_t>((lower_.size() - 1) / 2);
    std::nth_element(lower_.begin(), middle, lower_.end());
    double below = -std::numeric_limits<double>::infinity(), above = -below;
    for (const std::uint32_t i : chosen_) {
      const double face = items_[i].box.hi[axis];
      if (face <= *middle) below = std::max(below, face);
      if (face > *middle) above = std::min(above, face);
    }
    std::optional<KdCut> best;
    for (const double plane : {below, above})
      if (std::isfinite(plane)) keep_better(best, tried(axis, plane));
    return best;
  }

  // Nothing if the plane parts no pair, or cuts more than half.
  std::optional<KdCut> judged(int axis, double plane, std::size_t back, std::size_t front) const {
    const KdCut cut{axis, plane, std::max(back, front), back + front - chosen_.size()};
    if (cut.fuller == chosen_.size() || 2 * cut.both > chosen_.size()) return std::nullopt;
    return cut;
  }

  std::optional<KdCut> tried(int axis, double plane) {
    const KdCut cut{axis, plane};
    std::size_t back = 0, front = 0;
    for (const std::uint32_t i : chosen_) {
      back += cut.behind(items_[i].box);
      front += cut.in_front(items_[i].box);
    }
    tests += chosen_.size();
    return judged(axis, plane, back, front);
  }

  // Of all upper faces, in one sweep.
  std::optional<KdCut> best_of(int axis) {
    lower_.clear();
    upper_.clear();
    for (const std::uint32_t i : chosen_) {
      append(lower_, items_[i].box.lo[axis]);
      append(upper_, items_[i].box.hi[axis]);
    }
    std::ranges::sort(lower_);
    std::ranges::sort(upper_);
    tests += upper_.size();
    std::optional<KdCut> best;
    std::size_t back = 0;
    for (std::size_t i = 0; i < upper_.size(); ++i) {
      if (i + 1 < upper_.size() && upper_[i + 1] == upper_[i]) continue;
      while (back < lower_.size() && lower_[back] <= upper_[i]) ++back;
      keep_better(best, judged(axis, upper_[i], back, upper_.size() - i - 1));
    }
    return best;
  }

  std::span<const Item<D>> items_;
  std::span<const std::uint32_t> chosen_;
  std::vector<double> lower_, upper_;  // faces, or centres
};

template <int D>
class KdTree final : public StructureOf<KdTree<D>, D>, CountsAllocations {
 public:
  static constexpr Zones kZones = Zones::fitted;
  static constexpr std::uint32_t kDeepest = 64;

  // Throws Refused for a capacity of 0 and a max_depth above kDeepest.
  explicit KdTree(const StructureConfig<D>& config) : config_(config) {
    if (config.capacity == 0) throw Refused("kD-tree: capacity is 0, must be at least 1");
    if (config.max_depth > kDeepest)
      throw Refused("kD-tree: max_depth is {}, the limit is {}", config.max_depth, kDeepest);
    clear();
  }

  // The tree of these items, instead of what was there; memory is used again. Throws Refused for a
  // box that is not valid; nothing changes then. After Stopped the tree must be built again before
  // further use. Tells make_child, split, store, and why a leaf
  // that is too full stays one. Time: O(n log n) where planes part well.
  template <class Observer = NoObserver>
  void make(Items<D> items, Observer&& observer = {}) {
    require_all_valid(items);
    most_nodes_before_ = std::max(most_nodes_before_, nodes_.size());
    nodes_.clear();
    items_.clear();
    leaf_boxes_.forget();
    stored_.clear();
    work_.clear();
    deepest_ = box_tests_ = 0;
    cuts_.tests = 0;
    for (const Item<D>& item : items) append(items_, item);
    std::ranges::sort(items_, {}, &Item<D>::id);
    for (std::uint32_t i = 0; i < items_.size(); ++i) append(work_, i);
    entries_expected_ = items_.size();
    append(nodes_, Node{});
    grow(Spot{}, 0, observer);
  }

  // An empty leaf.
  void clear() override { make({}); }

  // Is the tree still fitted to its objects if this one, which it holds, has moved to this box? It
  // is as long as the object reaches the same leaves, and in each lies within the leaf's fitted
  // box. An object that was decisive for a box does not fit after any move outward; then, "if that
  // object moves in any way, the tree must be rebuilt". False for a body that is not there.
  bool fits(const Item<D>& moved) const override {
    const Item<D>* stored = stored_item(moved.id);
    if (stored == nullptr || !is_valid(moved.box)) return false;
    return fits_below(0, stored->box, moved.box);
  }

  template <class F>
  void take(Tour<D> tour, F&& f) const {
    visit_from(0, kNone, 0, 0, tour, f);
  }

  // The leaves whose fitted boxes the box overlaps.
  std::uint64_t near(const Box<D>& box, std::vector<BodyId>& ids) const override {
    return collect(0, box, ids);
  }

  // --- asked by rows, see query_walk.hpp ---

  using Place = NodeHandle;
  bool has_rows() const { return leaf_boxes_.is_due(); }
  const LeafBoxes<D>& boxes() const {
    return leaf_boxes_.made([&](LeafBoxes<D>& boxes) {
      boxes.fill(
          stored_.size(), nodes_.size(), [&](NodeHandle i) { return leaf_run(i); },
          [&](std::uint32_t at) -> auto& { return *stored_item(stored_[at]); });
    });
  }
  Place root() const { return 0; }
  std::optional<LeafRun> leaf_run(Place at) const {
    const Node& node = nodes_[at];
    return node.is_leaf() ? std::optional(LeafRun{node.first, node.count}) : std::nullopt;
  }
  template <class Probe, class F>
  void open(Place at, const Probe& probe, const typename Probe::Part&, F&& f) const {
    const Node& node = nodes_[at];
    const NodeHandle first = probe.high_first(node.axis, node.plane) ? 1 : 0;
    for (const NodeHandle child : {node.first_child + first, node.first_child + 1 - first})
      f(child, probe.in_box(nodes_[child].box));
  }

  // `box_tests` counts comparisons of a body with a plane.
  Counters counters() const override {
    return {.nodes = nodes_.size(),
            .leaves = (nodes_.size() + 1) / 2,
            .depth = deepest_,
            .entries = stored_.size(),
            .box_tests = box_tests_ + cuts_.tests,
            .splits = nodes_.size() / 2,
            .allocations = allocations_ + cuts_.allocations(),
            .nodes_reused = std::min(most_nodes_before_, nodes_.size()),
            .pool = std::max(most_nodes_before_, nodes_.size())};
  }

 private:
  struct Node {
    Box<D> box;        // fitted
    double plane = 0;  // of an inner node
    int axis = kLeaf;
    NodeHandle first_child = 0;  // the one behind; the one in front is next to it
    std::uint32_t first = 0;     // of a leaf, in stored_
    std::uint32_t count = 0;
    bool is_leaf() const { return axis == kLeaf; }
    KdCut cut() const { return {axis, plane}; }
  };
  static constexpr int kLeaf = -1;

  // A node while it is made: which cell it answers for, and how deep it lies.
  struct Spot {
    NodeHandle node = 0;
    std::uint32_t depth = 0;
    Box<D> cell{Vec<D>(-std::numeric_limits<double>::infinity()),
                Vec<D>(std::numeric_limits<double>::infinity())};
  };

  // Null if it is not there. Items stand in the order of ids, often at the places of their ids.
  const Item<D>* stored_item(BodyId id) const {
    if (id < items_.size() && items_[id].id == id) return &items_[id];
    const auto found = std::ranges::lower_bound(items_, id, {}, &Item<D>::id);
    return found == items_.end() || found->id != id ? nullptr : &*found;
  }

  // --- building ---

  // Makes the node from the items in work_ from `begin` on, and takes them away.
  template <class Observer>
  void grow(const Spot& at, std::size_t begin, Observer& observer) {
    deepest_ = std::max<std::uint64_t>(deepest_, at.depth);
    const auto count = static_cast<std::uint32_t>(work_.size() - begin);
    if (count > config_.capacity) {
      const auto cut =
          may_split(at) ? cuts_.best(items_, std::span(work_).subspan(begin)) : std::nullopt;
      if (cut) return split(at, begin, *cut, observer);
      const Event::Kind why =
          at.depth < config_.max_depth ? Event::Kind::no_progress : Event::Kind::depth_limit;
      observer(Event{why, at.node, items_[work_.back()].id, count, config_.capacity});
    }
    Node& leaf = nodes_[at.node];
    leaf.first = static_cast<std::uint32_t>(stored_.size());
    for (std::size_t i = begin; i < work_.size(); ++i) {
      const Item<D>& item = items_[work_[i]];
      append(stored_, item.id);
      ++leaf.count;
      const Box<D> part = common_part(item.box, at.cell);
      leaf.box = i == begin ? part : united(leaf.box, part);
      observer(Event{Event::Kind::store, at.node, item.id, leaf.count, config_.capacity});
    }
    work_.resize(begin);
  }

  bool may_split(const Spot& at) const {
    return at.depth < config_.max_depth && entries_expected_ < config_.most_entries;
  }

  template <class Observer>
  void split(const Spot& at, std::size_t begin, const KdCut& cut, Observer& observer) {
    stop_if_asked();
    const std::size_t end = work_.size();
    const BodyId last = items_[work_.back()].id;
    observer(Event{Event::Kind::split, at.node, last, static_cast<std::uint32_t>(end - begin),
                   config_.capacity});
    entries_expected_ += cut.both;
    const auto first_child = static_cast<NodeHandle>(nodes_.size());
    nodes_[at.node].axis = cut.axis;
    nodes_[at.node].plane = cut.plane;
    nodes_[at.node].first_child = first_child;
    for (NodeHandle child = 0; child < 2; ++child) {
      append(nodes_, Node{});
      observer(Event{Event::Kind::make_child, first_child + child, last, 0, 0});
    }
    for (const bool front : {false, true}) {
      for (std::size_t i = begin; i < end; ++i) {
        const Box<D>& box = items_[work_[i]].box;
        if (front ? cut.in_front(box) : cut.behind(box)) append(work_, work_[i]);
      }
      box_tests_ += end - begin;
      Spot child{first_child + (front ? 1u : 0u), at.depth + 1, at.cell};
      (front ? child.cell.lo : child.cell.hi)[cut.axis] = cut.plane;
      grow(child, end, observer);
    }
    work_.resize(begin);
    nodes_[at.node].box = united(nodes_[first_child].box, nodes_[first_child + 1].box);
  }

  // --- looking ---

  template <class F>
  void visit_from(NodeHandle handle, std::uint32_t parent, std::uint32_t slot, std::uint32_t depth,
                  Tour<D>& tour, F& f) const {
    stop_if_asked();
    const Node& node = nodes_[handle];
    NodeView<D> view = tour.view(handle, parent, slot, depth, node.is_leaf(), node.box);
    Plane<D> plane;
    if (!view.leaf) {
      plane.normal[node.axis] = 1;
      plane.offset = node.plane;
      view.plane = &plane;
    }
    view.bodies = std::span(stored_).subspan(node.first, node.count);
    if (!f(std::as_const(view)) || view.leaf) return;
    const std::uint32_t first = tour.toward[node.axis] < 0 ? 1 : 0;
    for (const std::uint32_t child : {first, 1 - first})
      visit_from(node.first_child + child, view.id, child, depth + 1, tour, f);
  }

  // How many nodes it was tested against.
  std::uint64_t collect(NodeHandle handle, const Box<D>& box, std::vector<BodyId>& ids) const {
    const Node& node = nodes_[handle];
    if (!overlap(box, node.box)) return 1;
    if (node.is_leaf()) {
      const auto first = stored_.begin() + node.first;
      ids.insert(ids.end(), first, first + node.count);
      return 1;
    }
    return 1 + collect(node.first_child, box, ids) + collect(node.first_child + 1, box, ids);
  }

  // Both are what lies in the node's cell of the box as it was stored and as it is now.
  bool fits_below(NodeHandle handle, const Box<D>& stored, const Box<D>& moved) const {
    const Node& node = nodes_[handle];
    if (node.is_leaf()) return united(node.box, moved) == node.box;
    for (const bool front : {false, true}) {
      const auto reaches = [&](const Box<D>& box) {
        return front ? node.cut().in_front(box) : node.cut().behind(box);
      };
      if (reaches(stored) != reaches(moved)) return false;
      if (!reaches(stored)) continue;
      Box<D> part = moved;
      double& bound = (front ? part.lo : part.hi)[node.axis];
      bound = front ? std::max(bound, node.plane) : std::min(bound, node.plane);
      if (!fits_below(node.first_child + (front ? 1u : 0u), stored, part)) return false;
    }
    return true;
  }

  StructureConfig<D> config_;
  std::vector<Item<D>> items_;                      // by id
  std::vector<Node> nodes_;                         // the root first, siblings side by side
  std::vector<BodyId> stored_;                      // of all leaves, each ascending
  mutable MadeWhenAsked<LeafBoxes<D>> leaf_boxes_;  // by the places of stored_
  std::vector<std::uint32_t> work_;  // items of the nodes that are being made, the deepest last
  KdCuts<D> cuts_;
  std::size_t most_nodes_before_ = 0;
  std::uint64_t entries_expected_ = 0;
  std::uint64_t deepest_ = 0;
  std::uint64_t box_tests_ = 0;
};

}  // namespace lantern::spatial
