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
// The rule. A node that holds more than `capacity` bodies and lies above `max_depth` is split:
//   1. Axes are tried in the order of the spread of the bodies' centres, the largest first (of
//   equal
//      ones, x before y before z).
//   2. On an axis, the plane goes through the upper face nearest below or at the median of the
//      centres, or the nearest above it: the one that leaves fewer bodies on its fuller side, then
//      the one that cuts fewer bodies, then the lower one. It must leave something out on each side
//      and cut at most half of the bodies.
//   3. If no axis has such a plane, all upper faces of all axes are compared in the same way.
//   4. If that fails, too, the node stays a leaf: either all its boxes share a point, so that no
//      plane parts any pair (no progress), or every plane would copy more than it parts.
//   5. Nothing more is split once the tree holds `most_entries` entries.
// The rule asks for boxes only, so the tree does not depend on the order of the items.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.hpp"
#include "spatial/ids.hpp"
#include "spatial/structure.hpp"

namespace lantern {

template <int D>
class KdTree {
 public:
  static constexpr Zones kZones = Zones::fitted;
  static constexpr std::uint32_t kDeepest = 64;

  struct Config {
    std::uint32_t capacity = 2;    // a leaf that holds more is split; at least 1
    std::uint32_t max_depth = 16;  // 0: the root is never split
    std::uint64_t most_entries = std::uint64_t{1} << 22;
  };

  // Throws Refused for a capacity of 0 and a max_depth above kDeepest.
  explicit KdTree(const Config& config = {});

  // The tree of these items, instead of what was there; memory is used again. Throws Refused for a
  // box that is not valid; nothing changes then. Tells make_child, split, store, and why a leaf
  // that is too full stays one. Time: O(n log n) where planes part well.
  void build(std::span<const Item<D>> items) { build(items, NoObserver{}); }
  template <class Observer>
  void build(std::span<const Item<D>> items, Observer&& observer);

  // An empty leaf.
  void clear() { build({}); }

  // Is the tree still fitted to its objects if this one, which it holds, has moved to this box? It
  // is as long as the object reaches the same leaves, and in each lies within the leaf's fitted
  // box. An object that was decisive for a box does not fit after any move outward; then, "if that
  // object moves in any way, the tree must be rebuilt". False for a body that is not there.
  bool fits(const Item<D>& moved) const;

  template <class F>
  void visit(F&& f) const;
  template <class F>
  void visit(F&& f, std::vector<BodyId>& room) const;
  template <class F>
  void visit_toward(const Vec<D>& direction, F&& f) const;
  template <class F>
  void query(const Box<D>& box, F&& f) const;
  // Goes by planes, not by fitted boxes: the leaves in which the box would be stored.
  void near(const Box<D>& box, std::vector<BodyId>& ids) const;

  // `box_tests` counts comparisons of a body with a plane.
  Counters counters() const;
};

}  // namespace lantern
