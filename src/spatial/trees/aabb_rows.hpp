// The nodes of an AABB tree, and the rows of boxes that are made of them for who asks again and
// again.
#pragma once

#include <cmath>
#include <limits>
#include <utility>

#include "geometry/ray.hpp"
#include "spatial/box_row.hpp"

namespace lantern::spatial {

// A box in float that holds boxes in double, and what lies below it, in 24 bytes (2D) or 32 (3D).
template <int D>
struct alignas(D == 3 ? 16 : 8) AabbNode {
  static constexpr std::uint32_t kTallest = 127;                // that can be written down
  static constexpr std::uint32_t kMostBodies = (1u << 25) - 1;  // as well

  float lo[D] = {};
  float hi[D] = {};
  std::uint32_t link = 0;   // of a leaf its body, else the first of its two children
  std::uint32_t below = 0;  // how many bodies, times 128, plus the height

  // The box, enlarged by the margin and rounded outward.
  static AabbNode leaf(const Item<D>& item, double margin) {
    AabbNode node;
    for (int i = 0; i < D; ++i) {
      node.lo[i] = BoxTable<D>::rounded_down(item.box.lo[i] - margin);
      node.hi[i] = BoxTable<D>::rounded_up(item.box.hi[i] + margin);
    }
    node.link = item.id;
    node.below = 1 << 7;
    return node;
  }

  bool is_leaf() const { return height() == 0; }
  std::uint32_t height() const { return below & kTallest; }  // 0: a leaf
  std::uint32_t bodies() const { return below >> 7; }

  Box<D> box() const {
    Box<D> box;
    for (int i = 0; i < D; ++i) {
      box.lo[i] = lo[i];
      box.hi[i] = hi[i];
    }
    return box;
  }

  // The smallest around both; what lies below is counted, too.
  void enclose(const AabbNode& a, const AabbNode& b) {
    grow_around(a, b);
    below = ((a.bodies() + b.bodies()) << 7) + 1 + std::max(a.height(), b.height());
  }
  void grow_around(const AabbNode& a, const AabbNode& b) {
    for (int i = 0; i < D; ++i) {
      lo[i] = std::min(a.lo[i], b.lo[i]);
      hi[i] = std::max(a.hi[i], b.hi[i]);
    }
  }

  // Half of what the surface-area heuristic calls the area: in 2D of the perimeter. Sides count as
  // kFarthest at most, so that it is a number, however large the box is.
  float area() const { return area_of(lo, hi); }
  float area_with(const AabbNode& other) const {
    AabbNode both;
    both.grow_around(*this, other);
    return both.area();
  }
  static float area_of(const float* lo, const float* hi) {
    constexpr float kFarthest = 1e18f;
    float side[D];
    for (int i = 0; i < D; ++i) side[i] = std::min(hi[i] - lo[i], kFarthest);
    if constexpr (D == 2)
      return side[0] + side[1];
    else
      return side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
  }

  bool reaches(const AabbNode& other) const {
    bool all = true;
    for (int i = 0; i < D; ++i) all = all & (lo[i] <= other.hi[i]) & (other.lo[i] <= hi[i]);
    return all;
  }
  bool holds(const Box<D>& box) const {
    for (int i = 0; i < D; ++i)
      if (box.lo[i] < lo[i] || box.hi[i] > hi[i]) return false;
    return true;
  }
};

// An AABB tree in rows: a row holds the boxes of up to kAabbBlock nodes that lie one or more levels
// below its own, and is looked at by a few instructions; the lowest rows hold bodies (Dammertz,
// Hanika, Keller: "Shallow Bounding Volume Hierarchies for Fast SIMD Ray Tracing of Incoherent
// Rays", 2008). A row that is full stands for four levels of the tree and more.
template <int D>
class AabbRows {
 public:
  // The rows of the tree with that root, instead of those before. What is rounded is not rounded
  // again.
  void make(std::span<const AabbNode<D>> nodes, NodeHandle root) {
    boxes_.clear();
    root_ = nodes[root].bodies() > 0 ? add(nodes, root) : Row{};
  }

  // f(id, is_sure) for each body that the probe may meet before `limit()`, see each_in_row.
  template <class Probe, class Limit, class Soon, class F>
  WalkCounts each_met(const Probe& probe, Limit& limit, Soon& soon, F& f) const {
    WalkCounts counts;
    if constexpr (Probe::kIsOrdered) {
      enter(root_, probe, limit, soon, f, counts);
    } else {
      // One level after the other: what comes next is on its way from memory meanwhile.
      thread_local std::vector<Row> waiting;
      waiting.assign(1, root_);
      auto enters = [&](std::uint32_t below, bool) { waiting.push_back(Row(below)); };
      for (std::size_t i = 0; i < waiting.size(); ++i)
        look(waiting[i], probe, limit, soon, f, enters, counts);
    }
    return counts;
  }

 private:
  // In one word, as it stands in the row above: there are fewer than 2^26 places.
  struct Row {
    std::uint32_t word = 0;
    Row() = default;
    explicit Row(std::uint32_t its) : word(its) {}
    Row(LeafRun run, bool holds) : word(run.first << 6 | run.count << 1 | std::uint32_t{holds}) {}
    LeafRun run() const { return {word >> 6, word >> 1 & 31}; }
    bool holds_bodies() const { return (word & 1) != 0; }
  };
  Row add(std::span<const AabbNode<D>> nodes, NodeHandle at) {
    std::array<NodeHandle, kAabbBlock> below;
    const bool holds_bodies = nodes[at].bodies() <= kAabbBlock;
    std::uint32_t count = 1;
    below[0] = at;
    // The largest is opened, as long as there is room.
    const auto size = [&](NodeHandle i) {
      const bool opens = !nodes[i].is_leaf() && (holds_bodies || nodes[i].bodies() > kAabbBlock);
      return opens ? nodes[i].area() : -1;
    };
    while (count < kAabbBlock) {
      const auto largest = std::max_element(below.begin(), below.begin() + count,
                                            [&](auto a, auto b) { return size(a) < size(b); });
      if (size(*largest) < 0) break;
      const NodeHandle first = nodes[*largest].link;
      *largest = first;
      below[count++] = first + 1;
    }
    const LeafRun run = boxes_.add(count);
    for (std::uint32_t i = 0; i < count; ++i)
      boxes_.set(run, i, holds_bodies ? nodes[below[i]].link : add(nodes, below[i]).word,
                 nodes[below[i]].box());
    return {run, holds_bodies};
  }

  template <class Probe, class Limit, class Soon, class F>
  void enter(Row at, const Probe& probe, Limit& limit, Soon& soon, F& f, WalkCounts& counts) const {
    auto enters = [&](std::uint32_t below, bool) {
      enter(Row(below), probe, limit, soon, f, counts);
    };
    look(at, probe, limit, soon, f, enters, counts);
  }

  // f of the bodies, `enters` of the rows below.
  template <class Probe, class Limit, class Soon, class F, class Enters>
  void look(Row at, const Probe& probe, Limit& limit, Soon& soon, F& f, Enters& enters,
            WalkCounts& counts) const {
    const LeafRun run = at.run();
    const BoxRow<D> row = boxes_.row(run);
    ++counts.visited;
    if (at.holds_bodies()) {
      counts.compared += run.count;
      each_in_row(row, run.count, probe, limit, soon, f);
      return;
    }
    const auto fetch = [&](std::uint32_t below) { boxes_.fetch(Row(below).run()); };
    counts.skipped += run.count - each_in_row(row, run.count, probe, limit, fetch, enters);
  }

  Row root_;
  LeafBoxes<D> boxes_;
};

}  // namespace lantern::spatial
