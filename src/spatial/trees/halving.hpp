// How a quadtree or octree node is halved on every axis: one rule for every dimension.
//
//   +-------+-------+    2D: 0 upper left, 1 upper right, 2 lower left, 3 lower right; y is up.
//   |   0   |   1   |    3D: the same four for low z, then the four for high z.
//   +-------+-------+
//   |   2   |   3   |    A box reaches the low side of an axis if box.lo <= middle, the high side
//   +-------+-------+    if box.hi >= middle: one that touches the middle reaches both.
#pragma once

#include <cstdint>

#include "geometry/box.hpp"

namespace lantern::spatial {

template <int D>
struct Halving {
  static_assert(D == 2 || D == 3);
  static constexpr std::uint32_t kChildren = 1u << D;
  static constexpr std::uint32_t kEach = (1u << kChildren) - 1;  // one bit for each child

  // Does the child lie on the high side of the axis? Its number counts x first, and y from the top.
  static constexpr bool is_high(std::uint32_t slot, int axis) {
    return ((slot >> axis & 1u) != 0) != (axis == 1);
  }

  // The child that a ray along the direction meets first. With it, child i ^ first is never met
  // after child j ^ first for i < j.
  static constexpr std::uint32_t first_toward(const Vec<D>& direction) {
    std::uint32_t slot = 0;
    for (int i = 0; i < D; ++i)
      if (is_high(0, i) != (direction[i] < 0)) slot |= 1u << i;
    return slot;
  }

  // Halves are exact (but of denormal numbers), so this is the middle rounded once; and it cannot
  // overflow.
  static Vec<D> middle(const Box<D>& box) { return box.lo * 0.5 + box.hi * 0.5; }

  // False when the numbers are exhausted: none lies strictly between the bounds of some axis.
  static bool is_possible(const Box<D>& box) {
    const Vec<D> m = middle(box);
    for (int i = 0; i < D; ++i)
      if (!(box.lo[i] < m[i] && m[i] < box.hi[i])) return false;
    return true;
  }

  static Box<D> child(Box<D> box, const Vec<D>& middle, std::uint32_t slot) {
    for (int i = 0; i < D; ++i) (is_high(slot, i) ? box.lo : box.hi)[i] = middle[i];
    return box;
  }

  // Bit `slot` is set if the box reaches that child; never is none set for a valid box.
  static std::uint32_t reached(const Box<D>& box, const Vec<D>& middle) {
    std::uint32_t children = kEach;
    for (int i = 0; i < D; ++i)
      children &= (box.lo[i] <= middle[i] ? side(i, false) : 0u) |
                  (box.hi[i] >= middle[i] ? side(i, true) : 0u);
    return children;
  }

 private:
  // One bit for each child on that side of the axis.
  static constexpr std::uint32_t side(int axis, bool high) {
    std::uint32_t children = 0;
    for (std::uint32_t slot = 0; slot < kChildren; ++slot)
      if (is_high(slot, axis) == high) children |= 1u << slot;
    return children;
  }
};

}  // namespace lantern::spatial
