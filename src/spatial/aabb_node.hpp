// A node of an AABB tree: a box in float that holds boxes in double, and what lies below it, in 24
// bytes (2D) or 32 (3D).
#pragma once

#include <algorithm>
#include <cstdint>

#include "geometry/box.hpp"
#include "spatial/box_table.hpp"
#include "spatial/structure.hpp"

namespace lantern::spatial {

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

}  // namespace lantern::spatial
