// The lecture's quadtree, and with one more axis its octree: a node that holds too much is halved
// on every axis (see node_parts.hpp), and its contents go to each child that they reach. The tree
// is built as it is taught, one Insert after another.
//
// A body is compared with the middles of nodes only, never with their rims, so nothing is dropped:
// cells at the rim reach outward without end, and a body outside the root's bounds lies in the
// nearest ones.
//
// The finished tree does not depend on the order of insertion. A node is split exactly when
//   - more than `capacity` bodies reach it,
//   - it lies above `max_depth`,
//   - its middle lies strictly between its bounds on every axis: numbers can still tell its halves
//     apart, and
//   - with `no_progress_stop`, the boxes in it have no point common to all.
// Which bodies reach a node is decided by their boxes alone, and more bodies can only make these
// conditions true, never false again. So each is met as soon as the bodies that force it are there.
//
// Why a common point makes splits futile: it lies in (at least) one child, and all boxes reach that
// child. So all bodies meet there again, however often it is split, and no pair is ever parted. For
// axis-aligned boxes there is such a point if the largest lower bound is not above the least upper
// bound on any axis.
#pragma once

#include <numeric>

#include "spatial/structure_of.hpp"
#include "spatial/trees/node_parts.hpp"

namespace lantern::spatial {

template <int D>
class Orthtree final : public StructureOf<Orthtree<D>, D>, CountsAllocations {
  using Halves = Halving<D>;

 public:
  static constexpr std::uint32_t kChildren = Halves::kChildren;
  static constexpr Zones kZones = Zones::endless_rim;
  static constexpr std::uint32_t kDeepest = 32;
  // Nodes and entries have 32-bit numbers: `most_entries` beyond that means so many.
  static constexpr std::uint64_t kMost = 0xffff'fffe;

  // Throws Refused for bounds that are not finite or have no extent, a capacity of 0 and a
  // max_depth above kDeepest.
  explicit Orthtree(const StructureConfig<D>& config)
      : config_(checked(config)), contents_(std::min(config.capacity, kLargestFirstRoom - 1) + 1) {
    make_node(0);
  }

  // Stores the item in every leaf that its box reaches.
  //
  // Time: one test at the root and one for each child, made or not, of each inner node reached; n
  // bodies at one place cost n such ways down and no more. Memory: a few words for each body, node
  // and entry.
  template <class Observer>
  void add(const Item<D>& item, Observer&& observer) {
    append(items_, item);
    leaf_boxes_.forget();
    ++box_tests_;
    put(Spot{0, 0, config_.bounds}, static_cast<std::uint32_t>(items_.size() - 1), observer);
  }

  // The tree of these items, instead of what was there: the same that `add` makes of them one by
  // one, with the same counts of tests and splits, in less time; but its nodes and their places in
  // the array are numbered in the order of visiting. Throws as `build` does.
  void make(Items<D> items) {
    require_all_valid(items);
    clear();
    box_tests_ = items.size();
    for (const Item<D>& item : items) append(items_, item);
    const std::size_t before = work_.capacity() + reached_.capacity();
    work_.resize(items.size());
    std::iota(work_.begin(), work_.end(), 0u);
    grow(Spot{0, 0, config_.bounds}, 0);
    work_.clear();
    allocations_ += work_.capacity() + reached_.capacity() != before;
  }

  void clear() override {
    most_nodes_before_ = std::max(most_nodes_before_, nodes_.size());
    items_.clear();
    leaf_boxes_.forget();
    nodes_.clear();
    families_.clear();
    common_parts_.clear();
    contents_.clear();
    entries_ = box_tests_ = splits_ = nodes_reused_ = deepest_ = 0;
    make_node(0);
  }

  template <class F>
  void take(Tour<D> tour, F&& f) const {
    const bool ahead = tour.toward != Vec<D>(0.0);
    const Way way{ahead ? Halves::first_toward(tour.toward) : 0, tour};
    visit_from(Spot{0, 0, config_.bounds}, kNone, 0, way, f);
  }

  std::uint64_t near(const Box<D>& box, std::vector<BodyId>& ids) const override {
    return collect(Spot{0, 0, config_.bounds}, box, ids);
  }

  // --- asked by rows, see query_walk.hpp ---

  // A node and what was derived for it on the way down.
  struct Place {
    NodeHandle node = 0;
    std::uint32_t depth = 0;
    Box<D> bounds;
  };

  bool has_rows() const { return leaf_boxes_.is_due(); }
  const LeafBoxes<D>& boxes() const {
    return leaf_boxes_.made([&](LeafBoxes<D>& boxes) {
      boxes.fill(
          contents_.places(), nodes_.size(),
          [&](NodeHandle i) {
            return leaf_run({i, 0, {}});
          },
          [&](std::uint32_t at) -> auto& { return items_[contents_.value(at)]; });
    });
  }
  Place root() const { return {0, 0, config_.bounds}; }
  std::optional<LeafRun> leaf_run(const Place& at) const {
    const Node& node = nodes_[at.node];
    if (!node.is_leaf()) return std::nullopt;
    return LeafRun{node.contents.first, node.contents.count};
  }
  // Children reach outward without end at the rim: only the middles cut.
  template <class Probe, class F>
  void open(const Place& at, const Probe& probe, const typename Probe::Part& part, F&& f) const {
    const Vec<D> mid = Halves::middle(at.bounds);
    std::optional<typename Probe::Part> side[D][2];
    std::uint32_t first = 0;
    for (int i = 0; i < D; ++i) {
      for (const bool high : {false, true}) side[i][high] = probe.beside(part, i, mid[i], high);
      if (Halves::is_high(0, i) != probe.high_first(i, mid[i])) first |= 1u << i;
    }
    for (std::uint32_t i = 0; i < kChildren; ++i) {
      const std::uint32_t slot = i ^ first;
      const NodeHandle child = child_of(at.node, slot);
      if (child == kNone) continue;
      auto common = side[0][Halves::is_high(slot, 0)];
      for (int axis = 1; axis < D && common; ++axis) {
        const auto& other = side[axis][Halves::is_high(slot, axis)];
        common = other ? Probe::common(*common, *other) : std::nullopt;
      }
      f(child_spot(at, mid, child, slot), common);
    }
  }

  Counters counters() const override {
    return {.nodes = nodes_.size(),
            .leaves = nodes_.size() - families_.size(),
            .depth = deepest_,
            .entries = entries_,
            .box_tests = box_tests_,
            .splits = splits_,
            .allocations = allocations_ + contents_.allocations(),
            .nodes_reused = nodes_reused_,
            .places = contents_.places(),
            .node_bytes = nodes_.size() * sizeof(Node) + families_.size() * sizeof(Family),
            .pool = std::max(most_nodes_before_, nodes_.size())};
  }

 private:
  // Twelve bytes: bounds, depth and parent are derived on the way down.
  struct Node {
    LeafArray::Run contents;     // a leaf's item numbers, in order of storing
    std::uint32_t link = kNone;  // inner: its family; leaf: its common part, once it was asked for
    bool is_leaf() const { return contents.count != kInner; }
  };
  static constexpr std::uint32_t kInner = kNone;
  using Family = std::array<NodeHandle, kChildren>;  // kNone where no child was made

  using Spot = Place;
  struct Way {
    std::uint32_t first_slot;  // of each family; the others follow as they follow slot 0
    Tour<D>& tour;
  };

  static constexpr std::uint32_t kLargestFirstRoom = 16;

  static StructureConfig<D> checked(StructureConfig<D> config) {
    for (int i = 0; i < D; ++i)
      if (!is_valid(config.bounds) || !(config.bounds.lo[i] < config.bounds.hi[i]))
        throw Refused(
            "tree: its bounds go from {} to {} on axis {}; they must be finite and have an extent",
            config.bounds.lo[i], config.bounds.hi[i], "xyz"[i]);
    if (config.capacity == 0) throw Refused("tree: capacity is 0, must be at least 1");
    if (config.max_depth > kDeepest)
      throw Refused("tree: max_depth is {}, the limit is {}", config.max_depth, kDeepest);
    config.most_entries = std::min(config.most_entries, kMost);
    return config;
  }

  static Spot child_spot(const Spot& parent, const Vec<D>& middle, NodeHandle child,
                         std::uint32_t slot) {
    return {child, parent.depth + 1, Halves::child(parent.bounds, middle, slot)};
  }

  // --- insertion: the lecture's Insert ---

  // The item reaches this node.
  template <class Observer>
  void put(const Spot& at, std::uint32_t item, Observer& observer) {
    stop_if_asked();
    const BodyId body = items_[item].id;
    observer(Event{Event::Kind::test, at.node, body, 0, 0});
    if (!nodes_[at.node].is_leaf()) return hand_down(at, item, observer);
    require_room(entries_ + 1, "entries");
    contents_.append(nodes_[at.node].contents, item);
    ++entries_;
    const std::uint32_t count = nodes_[at.node].contents.count;
    observer(Event{Event::Kind::store, at.node, body, count, config_.capacity});
    if (count <= config_.capacity) return;
    const Event::Kind fate = fate_of_full_leaf(at);
    observer(Event{fate, at.node, body, count, config_.capacity});
    if (fate == Event::Kind::split) split(at, body, observer);
  }

  // To every child that the item reaches; a child that is not there yet is made.
  template <class Observer>
  void hand_down(const Spot& at, std::uint32_t item, Observer& observer) {
    const BodyId body = items_[item].id;
    const Vec<D> mid = Halves::middle(at.bounds);
    const std::uint32_t children = Halves::reached(items_[item].box, mid);
    box_tests_ += kChildren;
    for (std::uint32_t slot = 0; slot < kChildren; ++slot) {
      NodeHandle child = child_of(at.node, slot);
      if ((children >> slot & 1u) == 0) {
        if (child != kNone) observer(Event{Event::Kind::miss, child, body, 0, 0});
        continue;
      }
      if (child == kNone) child = make_child(at, slot, body, observer);
      put(child_spot(at, mid, child, slot), item, observer);
    }
  }

  Event::Kind fate_of_full_leaf(const Spot& at) {
    if (at.depth == config_.max_depth || !Halves::is_possible(at.bounds))
      return Event::Kind::depth_limit;
    if (config_.no_progress_stop && share_a_point(nodes_[at.node])) return Event::Kind::no_progress;
    return Event::Kind::split;
  }

  // The common part of a leaf's boxes is kept from one insertion to the next, so that n bodies at
  // one place are compared n times and not n^2.
  bool share_a_point(Node& leaf) {
    std::span<const std::uint32_t> fresh = contents_.values(leaf.contents);
    if (leaf.link == kNone) {
      leaf.link = static_cast<std::uint32_t>(common_parts_.size());
      append(common_parts_, items_[fresh.front()].box);
    } else {
      fresh = fresh.last(1);
    }
    Box<D>& common = common_parts_[leaf.link];
    for (const std::uint32_t item : fresh) common = common_part(common, items_[item].box);
    return is_valid(common);
  }

  template <class Observer>
  void split(const Spot& at, BodyId last, Observer& observer) {
    const LeafArray::Run waiting = nodes_[at.node].contents;
    make_inner(at.node);
    entries_ -= waiting.count;
    if (config_.eager_children)
      for (std::uint32_t slot = 0; slot < kChildren; ++slot) make_child(at, slot, last, observer);
    for (std::uint32_t i = 0; i < waiting.count; ++i) {
      const std::uint32_t item = contents_.values(waiting)[i];
      observer(Event{Event::Kind::hand_down, at.node, items_[item].id, 0, 0});
      hand_down(at, item, observer);
    }
    contents_.release(waiting);
  }

  // --- building of all at once ---

  // The node of the item numbers in work_ from `begin` on.
  void grow(const Spot& at, std::size_t begin) {
    stop_if_asked();
    const auto items = std::span(work_).subspan(begin);
    if (items.size() <= config_.capacity || !may_split(at, items)) {
      entries_ += items.size();
      require_room(entries_, "entries");
      nodes_[at.node].contents = contents_.stored(items);
      return;
    }
    make_inner(at.node);
    const Vec<D> mid = Halves::middle(at.bounds);
    const std::size_t end = work_.size(), masks = reached_.size();
    std::uint32_t entered = config_.eager_children ? Halves::kEach : 0;
    for (const std::uint32_t item : items) {
      reached_.push_back(static_cast<std::uint8_t>(Halves::reached(items_[item].box, mid)));
      entered |= reached_.back();
    }
    box_tests_ += kChildren * items.size();
    for (std::uint32_t slot = 0; slot < kChildren; ++slot) {
      if ((entered >> slot & 1u) == 0) continue;
      NoObserver nobody;
      const NodeHandle child = make_child(at, slot, 0, nobody);
      work_.resize(end + (end - begin));
      std::size_t next = end;
      for (std::size_t i = begin; i < end; ++i) {
        work_[next] = work_[i];
        next += reached_[masks + i - begin] >> slot & 1u;
      }
      work_.resize(next);
      grow(child_spot(at, mid, child, slot), end);
    }
    work_.resize(end);
    reached_.resize(masks);
  }

  bool may_split(const Spot& at, std::span<const std::uint32_t> items) const {
    if (at.depth == config_.max_depth || !Halves::is_possible(at.bounds)) return false;
    if (!config_.no_progress_stop) return true;
    Box<D> common = items_[items.front()].box;
    for (const std::uint32_t item : items) {
      common = common_part(common, items_[item].box);
      if (!is_valid(common)) return true;
    }
    return false;
  }

  // --- memory ---

  void make_inner(NodeHandle node) {
    Family none;
    none.fill(kNone);
    nodes_[node] = {{0, kInner}, static_cast<std::uint32_t>(families_.size())};
    append(families_, none);
    ++splits_;
  }

  NodeHandle child_of(NodeHandle node, std::uint32_t slot) const {
    return families_[nodes_[node].link][slot];
  }

  template <class Observer>
  NodeHandle make_child(const Spot& parent, std::uint32_t slot, BodyId body, Observer& observer) {
    require_room(nodes_.size() + 1, "nodes");
    const NodeHandle child = make_node(parent.depth + 1);
    families_[nodes_[parent.node].link][slot] = child;
    observer(Event{Event::Kind::make_child, child, body, 0, 0});
    return child;
  }

  NodeHandle make_node(std::uint32_t depth) {
    if (nodes_.size() < most_nodes_before_) ++nodes_reused_;
    append(nodes_, Node{});
    deepest_ = std::max<std::uint64_t>(deepest_, depth);
    return static_cast<NodeHandle>(nodes_.size() - 1);
  }

  void require_room(std::uint64_t wanted, const char* what) const {
    if (wanted <= config_.most_entries) return;
    throw Refused(
        "body {}: with it the tree needs more than {} {} ({} bodies, {} nodes, {} entries); lower "
        "max_depth ({}), raise capacity ({}) or turn on the no-progress stop",
        items_.back().id, config_.most_entries, what, items_.size(), nodes_.size(), entries_,
        config_.max_depth, config_.capacity);
  }

  // --- looking ---

  // Adds the ids that the leaf holds, in order of storing.
  void add_ids(const Node& leaf, std::vector<BodyId>& ids) const {
    const auto values = contents_.values(leaf.contents);
    const std::size_t before = ids.size();
    ids.resize(before + values.size());
    for (std::size_t i = 0; i < values.size(); ++i) ids[before + i] = items_[values[i]].id;
  }

  template <class F>
  void visit_from(const Spot& at, std::uint32_t parent, std::uint32_t slot, const Way& way,
                  F& f) const {
    stop_if_asked();
    const Node& node = nodes_[at.node];
    Tour<D>& tour = way.tour;
    NodeView<D> view = tour.view(at.node, parent, slot, at.depth, node.is_leaf(), at.bounds);
    tour.ids.clear();
    if (view.leaf) {
      add_ids(node, tour.ids);
      view.first = node.contents.count == 0 ? kNone : node.contents.first;
      view.room = contents_.room(node.contents);
    }
    if (!std::ranges::is_sorted(tour.ids)) std::ranges::sort(tour.ids);
    view.bodies = tour.ids;
    if (!f(std::as_const(view)) || view.leaf) return;
    const Vec<D> mid = Halves::middle(at.bounds);
    for (std::uint32_t i = 0; i < kChildren; ++i)
      if (const std::uint32_t s = i ^ way.first_slot; child_of(at.node, s) != kNone)
        visit_from(child_spot(at, mid, child_of(at.node, s), s), view.id, s, way, f);
  }

  // How many children it was tested against, as when a body is handed down.
  std::uint64_t collect(const Spot& at, const Box<D>& box, std::vector<BodyId>& ids) const {
    if (nodes_[at.node].is_leaf()) {
      add_ids(nodes_[at.node], ids);
      return 0;
    }
    std::uint64_t tests = kChildren;
    const Vec<D> mid = Halves::middle(at.bounds);
    const std::uint32_t children = Halves::reached(box, mid);
    for (std::uint32_t slot = 0; slot < kChildren; ++slot)
      if (const NodeHandle child = child_of(at.node, slot);
          child != kNone && (children >> slot & 1u) != 0)
        tests += collect(child_spot(at, mid, child, slot), box, ids);
    return tests;
  }

  StructureConfig<D> config_;
  std::vector<Item<D>> items_;
  std::vector<Node> nodes_;           // the root first
  std::vector<Family> families_;      // of the inner nodes
  std::vector<Box<D>> common_parts_;  // of leaves that the no-progress stop keeps whole
  LeafArray contents_;
  mutable MadeWhenAsked<LeafBoxes<D>> leaf_boxes_;  // by the places of contents_
  std::vector<std::uint32_t> work_;    // while building at once: items of the nodes on the way down
  std::vector<std::uint8_t> reached_;  // and which children each of them reaches
  std::size_t most_nodes_before_ = 0;  // of all trees that stood here before the last clear
  std::uint64_t entries_ = 0;
  std::uint64_t deepest_ = 0;
  std::uint64_t box_tests_ = 0;
  std::uint64_t splits_ = 0;
  std::uint64_t nodes_reused_ = 0;
};

using Quadtree = Orthtree<2>;
using Octree = Orthtree<3>;

}  // namespace lantern::spatial
