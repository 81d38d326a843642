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
#pragma once

#include <array>
#include <bit>
#include <limits>

#include <fmt/format.h>

#include "base/error.hpp"
#include "spatial/structure.hpp"

namespace lantern::spatial {

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
      throw Refused(fmt::format("the leaves need more than {} places", block));
    const std::size_t capacity = values_.capacity();
    values_.resize(block + room);
    allocations_ += values_.capacity() != capacity;
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
