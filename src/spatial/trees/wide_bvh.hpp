// A bounding volume hierarchy whose nodes have up to sixteen children, kept in little memory for
// who asks again and again (Wald, Benthin, Boulos: "Getting Rid of Packets", 2008; Ylitie, Karras,
// Laine: "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", 2017).
//
// An AABB tree is built of all bodies, its levels are gathered into rows (aabb_rows.hpp), and the
// rows are kept: a node is a row, and the lowest hold bodies.
#pragma once

#include "spatial/trees/aabb_tree.hpp"

namespace lantern::spatial {

template <int D>
class WideBvh final : public StructureOf<WideBvh<D>, D> {
 public:
  static constexpr Zones kZones = Zones::fitted;
  static constexpr bool kHoldsOnce = true;
  static constexpr bool kAsksForPairs = true;

  explicit WideBvh(const StructureConfig<D>& = {}) { clear(); }

  // Time: O(n log n).
  void make(Items<D> items) {
    const std::uint64_t allocations = counters_.allocations;
    AabbTree<D> tree;
    tree.make(items);
    tree.write(rows_);
    rows_.shrink();
    counters_ = tree.counters();
    counters_.allocations += allocations + 1;
    counters_.nodes = counters_.leaves = counters_.depth = counters_.splits = 0;
    std::vector<BodyId> ids;
    take(Tour<D>{ids}, [&](const NodeView<D>& node) {
      ++counters_.nodes;
      counters_.leaves += node.leaf;
      counters_.depth = std::max<std::uint64_t>(counters_.depth, node.depth);
      return true;
    });
  }
  void clear() override { make({}); }

  template <class F>
  void take(Tour<D> tour, F&& f) const {
    visit_from(rows_.root(), kNone, 0, 0, tour, f);
  }

  // Those whose rounded boxes the box overlaps, each once.
  std::uint64_t near(const Box<D>& box, std::vector<BodyId>& ids) const override {
    const std::size_t before = ids.size();
    auto meet = [&](BodyId id, bool) { ids.push_back(id); };
    const WalkCounts counts =
        rows_.each_met(VolumeProbe<D, Box>(box), kNoLimit, kNothingSoon, meet);
    return counts.visited + counts.skipped + counts.compared - (ids.size() - before);
  }

  // See query_walk.hpp.
  bool has_rows() const { return true; }
  template <class Probe, class Limit, class Soon, class F>
  WalkCounts each_met(const Probe& probe, Limit& limit, Soon& soon, F& f) const {
    return rows_.each_met(probe, limit, soon, f);
  }

  std::uint64_t meet(FunctionRef<bool(BodyId)> awake, FunctionRef<void(BodyId, BodyId)> f) const {
    std::uint64_t tests = 0;
    std::vector<BodyId> room, ids;
    take(Tour<D>{room}, [&](const NodeView<D>& node) {
      const PackedRow<D> row = rows_.row(node.handle);
      for (std::uint32_t i = 0; i < row.count() && node.leaf; ++i) {
        ids.clear();
        tests += near(row.box(i), ids);
        for (const BodyId other : ids)
          if (other > row.id(i) && (awake(other) || awake(row.id(i)))) f(row.id(i), other);
      }
      return true;
    });
    return tests;
  }

  bool fits(const Item<D>& moved) const override {
    return is_valid(moved.box) && holds(rows_.root(), moved);
  }

  Counters counters() const override { return counters_; }

 private:
  // Whether the rounded boxes above the body hold its box.
  bool holds(NodeHandle at, const Item<D>& item) const {
    const PackedRow<D> row = rows_.row(at);
    for (std::uint32_t i = 0; i < row.count(); ++i) {
      const Box<D> box = row.box(i);
      if (united(box, item.box) == box &&
          (row.holds_bodies() ? row.id(i) == item.id : holds(row.id(i), item)))
        return true;
    }
    return false;
  }

  template <class F>
  void visit_from(NodeHandle at, std::uint32_t parent, std::uint32_t slot, std::uint32_t depth,
                  Tour<D>& tour, F& f) const {
    stop_if_asked();
    const PackedRow<D> row = rows_.row(at);
    Box<D> box;
    for (std::uint32_t i = 0; i < row.count(); ++i)
      box = i == 0 ? row.box(i) : united(box, row.box(i));
    NodeView<D> view = tour.view(at, parent, slot, depth, row.holds_bodies(), box);
    if (view.leaf) view.bodies = tour.ascending(row.ids());
    if (!f(std::as_const(view)) || view.leaf) return;
    // In the order of their middles along the way, in units of the largest part of it.
    std::array<std::pair<double, std::uint32_t>, kRowBlock> children;
    double most = 0;
    for (int axis = 0; axis < D; ++axis) most = std::max(most, std::abs(tour.toward[axis]));
    for (std::uint32_t i = 0; i < row.count(); ++i) {
      children[i] = {0, i};
      for (int axis = 0; axis < D && most > 0; ++axis)
        children[i].first +=
            tour.toward[axis] / most * row.step(axis) * (row.lo(axis)[i] + row.hi(axis)[i]);
    }
    std::sort(children.begin(), children.begin() + row.count());
    for (std::uint32_t i = 0; i < row.count(); ++i) {
      const std::uint32_t child = children[i].second;
      visit_from(row.id(child), view.id, child, depth + 1, tour, f);
    }
  }

  AabbRows<D> rows_;
  Counters counters_;
};

}  // namespace lantern::spatial
