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
    const FloatBox<D> box(Box<D>{item.box.lo - margin, item.box.hi + margin});
    AabbNode node;
    std::copy_n(box.lo, D, node.lo);
    std::copy_n(box.hi, D, node.hi);
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

// An AABB tree in rows: a row holds the boxes of up to kRowBlock bodies or rows, and is looked at
// by a few instructions (Dammertz, Hanika, Keller: "Shallow Bounding Volume Hierarchies for Fast
// SIMD Ray Tracing of Incoherent Rays", 2008). Rows are made from below, of the largest branches
// that have no more: so all are filled about alike, and a row stands for three levels of the tree
// and more.
template <int D>
class AabbRows {
 public:
  // The rows of the tree with that root, instead of those before. What is rounded is not rounded
  // again.
  void make(std::span<const AabbNode<D>> nodes, NodeHandle root) {
    words_.clear();
    root_ = 0;
    if (nodes[root].bodies() > 0) {
      Waiting waiting;
      Top top = top_of(nodes, root, waiting);
      close(top, 0, nodes, root, waiting);
      root_ = waiting.entries[0].id;
    } else {
      words_.assign(PackedRow<D>::words(0), PackedRow<D>::kHoldsBodies);
    }
    words_.resize(words_.size() + kRowBlock / sizeof(std::uint32_t));
  }

  void shrink() { words_.shrink_to_fit(); }
  std::uint32_t root() const { return root_; }
  PackedRow<D> row(std::uint32_t at) const { return PackedRow<D>(words_.data() + at); }

  // f(id, is_sure) for each body that the probe may meet before `limit()`, see each_in_block.
  template <class Probe, class Limit, class Soon, class F>
  WalkCounts each_met(const Probe& probe, Limit& limit, Soon& soon, F& f) const {
    WalkCounts counts;
    if constexpr (Probe::kIsOrdered) {
      enter(root_, probe, limit, soon, f, counts);
    } else {
      // One level after the other: what comes next is on its way from memory meanwhile.
      thread_local std::vector<std::uint32_t> waiting;
      waiting.assign(1, root_);
      auto enters = [&](std::uint32_t below, bool) { waiting.push_back(below); };
      for (std::size_t i = 0; i < waiting.size(); ++i)
        look(waiting[i], probe, limit, soon, f, enters, counts);
    }
    return counts;
  }

 private:
  // What will stand in a row: a body or a row, and the node whose box it has.
  struct Entry {
    NodeHandle node;
    std::uint32_t id;
  };
  // Those of a branch for which there is no row yet stand behind those of the branch before.
  struct Waiting {
    std::array<Entry, kRowBlock*(AabbNode<D>::kTallest + 1)> entries;
    std::size_t size = 0;
  };
  struct Top {
    bool holds_bodies = true;
    std::uint32_t count = 0;
  };

  Top top_of(std::span<const AabbNode<D>> nodes, NodeHandle at, Waiting& waiting) {
    const AabbNode<D>& node = nodes[at];
    if (node.is_leaf()) {
      waiting.entries[waiting.size++] = {at, node.link};
      return {true, 1};
    }
    Top a = top_of(nodes, node.link, waiting), b = top_of(nodes, node.link + 1, waiting);
    const auto close_both = [&](bool bodies_only) {
      if (a.holds_bodies || !bodies_only) close(a, b.count, nodes, node.link, waiting);
      if (b.holds_bodies || !bodies_only) close(b, 0, nodes, node.link + 1, waiting);
    };
    if (a.count + b.count > kRowBlock || a.holds_bodies != b.holds_bodies) close_both(true);
    if (a.count + b.count > kRowBlock) close_both(false);
    return {a.holds_bodies, a.count + b.count};
  }
  // Makes a row of what waits of the branch of that node, before `behind` others.
  void close(Top& top, std::uint32_t behind, std::span<const AabbNode<D>> nodes, NodeHandle node,
             Waiting& waiting) {
    if (top.count == 1 && !top.holds_bodies) return;
    const auto end = waiting.entries.begin() + static_cast<std::ptrdiff_t>(waiting.size);
    const auto first = end - (behind + top.count);
    const auto row = static_cast<std::uint32_t>(words_.size());
    words_.resize(row + PackedRow<D>::words(top.count));
    PackedRow<D>::write(
        words_.data() + row, top.count,
        top.holds_bodies, [&](std::uint32_t i) -> auto& { return nodes[first[i].node]; },
        [&](std::uint32_t i) { return first[i].id; });
    std::copy(first + top.count, end, first + 1);
    *first = {node, row};
    waiting.size -= top.count - 1;
    top = {false, 1};
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
    const PackedRow<D> row = this->row(at);
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

  std::vector<std::uint32_t> words_;  // behind the last row some that are read in vain
  std::uint32_t root_ = 0;
};

}  // namespace lantern::spatial
