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

// An AABB tree in rows: a row holds the boxes of up to kRowBlock nodes that lie one or more levels
// below its own, and is looked at by a few instructions; the lowest rows hold bodies (Dammertz,
// Hanika, Keller: "Shallow Bounding Volume Hierarchies for Fast SIMD Ray Tracing of Incoherent
// Rays", 2008). A row that is full stands for four levels of the tree and more.
template <int D>
class AabbRows {
 public:
  // The rows of the tree with that root, instead of those before. What is rounded is not rounded
  // again.
  void make(std::span<const AabbNode<D>> nodes, NodeHandle root) {
    words_.clear();
    if (nodes[root].bodies() > 0)
      add(nodes, root);
    else
      words_.push_back(0);
    words_.resize(words_.size() + kRowBlock / sizeof(std::uint32_t));
  }

  // f(id, is_sure) for each body that the probe may meet before `limit()`, see each_in_block.
  template <class Probe, class Limit, class Soon, class F>
  WalkCounts each_met(const Probe& probe, Limit& limit, Soon& soon, F& f) const {
    WalkCounts counts;
    if constexpr (Probe::kIsOrdered) {
      enter(0, probe, limit, soon, f, counts);
    } else {
      // One level after the other: what comes next is on its way from memory meanwhile.
      thread_local std::vector<std::uint32_t> waiting;
      waiting.assign(1, 0);
      auto enters = [&](std::uint32_t below, bool) { waiting.push_back(below); };
      for (std::size_t i = 0; i < waiting.size(); ++i)
        look(waiting[i], probe, limit, soon, f, enters, counts);
    }
    return counts;
  }

 private:
  // Where the row of that node stands among the words: those of bodies and of large nodes behind
  // their own.
  std::uint32_t add(std::span<const AabbNode<D>> nodes, NodeHandle at) {
    std::array<NodeHandle, kRowBlock> below;
    const bool holds_bodies = nodes[at].bodies() <= kRowBlock;
    std::uint32_t count = 1;
    below[0] = at;
    // The largest is opened, as long as there is room.
    const auto size = [&](NodeHandle i) {
      const bool opens = !nodes[i].is_leaf() && (holds_bodies || nodes[i].bodies() > kRowBlock);
      return opens ? nodes[i].area() : -1;
    };
    while (count < kRowBlock) {
      const auto largest = std::max_element(below.begin(), below.begin() + count,
                                            [&](auto a, auto b) { return size(a) < size(b); });
      if (size(*largest) < 0) break;
      const NodeHandle first = nodes[*largest].link;
      *largest = first;
      below[count++] = first + 1;
    }
    const auto first = static_cast<std::uint32_t>(words_.size());
    words_.resize(first + PackedRow<D>::words(count));
    std::array<std::uint32_t, kRowBlock> links;
    for (std::uint32_t i = 0; i < count; ++i)
      links[i] = holds_bodies ? nodes[below[i]].link : add(nodes, below[i]);
    PackedRow<D>::write(
        words_.data() + first, count,
        holds_bodies, [&](std::uint32_t i) -> auto& { return nodes[below[i]]; },
        [&](std::uint32_t i) { return links[i]; });
    return first;
  }

  template <class Probe, class Limit, class Soon, class F>
  void enter(std::uint32_t at, const Probe& probe, Limit& limit, Soon& soon, F& f,
             WalkCounts& counts) const {
    auto enters = [&](std::uint32_t below, bool) { enter(below, probe, limit, soon, f, counts); };
    look(at, probe, limit, soon, f, enters, counts);
  }

  // f of the bodies, `enters` of the rows below.
  template <class Probe, class Limit, class Soon, class F, class Enters>
  void look(std::uint32_t at, const Probe& probe, Limit& limit, Soon& soon, F& f, Enters& enters,
            WalkCounts& counts) const {
    const PackedRow<D> row(words_.data() + at);
    const std::uint32_t count = row.count();
    ++counts.visited;
    if (row.holds_bodies()) {
      counts.compared += count;
      each_in_block(row, count, probe, limit, soon, f);
      return;
    }
    const auto fetch = [&](std::uint32_t below) {
      constexpr std::size_t kLine = 16;
      for (std::size_t i = 0; i < PackedRow<D>::words(kRowBlock); i += kLine)
        __builtin_prefetch(words_.data() + below + i);
    };
    counts.skipped += count - each_in_block(row, count, probe, limit, fetch, enters);
  }

  std::vector<std::uint32_t> words_;  // the root first; behind the last some that are read in vain
};

}  // namespace lantern::spatial
