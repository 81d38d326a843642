// What trees are made of: halves of nodes, and the contents of leaves.
#pragma once

#include <array>
#include <bit>
#include <limits>

#include "base/error.hpp"
#include "spatial/structure.hpp"

namespace lantern::spatial {

// How a quadtree or octree node is halved on every axis: one rule for every dimension.
//
//   +-------+-------+    2D: 0 upper left, 1 upper right, 2 lower left, 3 lower right; y is up.
//   |   0   |   1   |    3D: the same four for low z, then the four for high z.
//   +-------+-------+
//   |   2   |   3   |    A box reaches the low side of an axis if box.lo <= middle, the high side
//   +-------+-------+    if box.hi >= middle: one that touches the middle reaches both.
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

// The contents of all leaves of a tree in one array: a leaf is an index and a count (the lecture,
// "Memory Usage"). Each leaf owns a block of a power of two of places; one that is full moves to a
// block twice as large, and the old block waits for the next leaf that needs its size:
//
//   | leaf 3: 7 2 4 . | leaf 1: 5 . . . | free --> | leaf 4: 1 2 3 5 6 8 . . | ...
//                                            |
//                       next free block of this size
//
// So the array has at most twice the places that the values need, plus a first block for each leaf,
// plus the blocks left behind by leaves that grew.
class LeafArray {
 public:
  // A leaf's contents. An empty one owns no block.
  struct Run {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };

  // A leaf's first block has room for at least this many values, rounded up to a power of two.
  explicit LeafArray(std::uint32_t first_room) : first_room_(std::bit_ceil(first_room)) {
    free_.fill(kNone);
  }

  std::uint32_t value(std::size_t place) const { return values_[place]; }
  // Valid until the next append.
  std::span<const std::uint32_t> values(Run run) const {
    return std::span(values_).subspan(run.count == 0 ? 0 : run.first, run.count);
  }

  // Throws Refused when the array would outgrow its 32-bit indices; the run stays as it was.
  void append(Run& run, std::uint32_t value) {
    const std::uint32_t room = room_for(run.count);
    if (run.count == 0) {
      run.first = take(room);
    } else if (run.count == room) {
      const std::uint32_t larger = take(2 * room);
      std::copy_n(values_.begin() + run.first, run.count, values_.begin() + larger);
      give_back(run.first, room);
      run.first = larger;
    }
    values_[run.first + run.count++] = value;
  }

  // A new run of these values. Throws as `append` does.
  Run stored(std::span<const std::uint32_t> values) {
    if (values.empty()) return {};
    const auto count = static_cast<std::uint32_t>(values.size());
    const Run run{take(room_for(count)), count};
    std::ranges::copy(values, values_.begin() + run.first);
    return run;
  }

  // The run's block may be given to another leaf from now on.
  void release(Run run) {
    if (run.count > 0) give_back(run.first, room_for(run.count));
  }

  // Forgets all runs and keeps the memory.
  void clear() {
    values_.clear();
    free_.fill(kNone);
  }

  // Of the run's block.
  std::uint32_t room(Run run) const { return run.count == 0 ? 0 : room_for(run.count); }

  // Of all blocks, free or not.
  std::size_t places() const { return values_.size(); }
  std::uint64_t allocations() const { return allocations_; }

 private:
  std::uint32_t room_for(std::uint32_t count) const {
    return std::max(first_room_, std::bit_ceil(count));
  }

  std::uint32_t take(std::uint32_t room) {
    std::uint32_t& free = free_[std::countr_zero(room)];
    if (free != kNone) {
      const std::uint32_t block = free;
      free = values_[block];
      return block;
    }
    const std::size_t block = values_.size();
    if (block + room > std::numeric_limits<std::uint32_t>::max())
      throw Refused("the leaves need more than {} places", block);
    if (block + room > values_.capacity()) {  // by our own rule: libraries have different ones
      values_.reserve(block + std::max<std::size_t>(block, room));
      ++allocations_;
    }
    values_.resize(block + room);
    return static_cast<std::uint32_t>(block);
  }

  // A free block's first place names the next free block of its size.
  void give_back(std::uint32_t block, std::uint32_t room) {
    std::uint32_t& free = free_[std::countr_zero(room)];
    values_[block] = free;
    free = block;
  }

  std::vector<std::uint32_t> values_;
  std::uint32_t first_room_;
  std::array<std::uint32_t, 32> free_;  // first free block of 2^index places, or kNone
  std::uint64_t allocations_ = 0;
};

}  // namespace lantern::spatial
