// Boxes in float that stand in a row, and which of them a ray, a box, a ball or a point meets: some
// instructions for sixteen of them (box_vectors.cpp).
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "geometry/ray.hpp"
#include "spatial/box_table.hpp"

namespace lantern::spatial {

// The bodies of a leaf, where they stand side by side.
struct LeafRun {
  std::uint32_t first = 0, count = 0;
};

// The boxes of a table for who looks at one leaf after another, each somewhere else: all of a leaf
// lies in one piece of memory, so that the fewest lines of the cache are read.
//
//   lo.x 0.1 0.3 0.7 | hi.x 0.4 0.5 0.9 | lo.y ... | hi.y ... | ids 7 2 4 || lo.x of the next leaf
template <int D>
class LeafBoxes {
 public:
  void clear() { resize(0); }
  void resize(std::size_t places) {
    places_ = places;
    words_.resize(kWords * (places + BoxTable<D>::kPadding));
  }
  // One more, of so many boxes.
  LeafRun add(std::uint32_t count) {
    const auto first = static_cast<std::uint32_t>(places_);
    resize(places_ + count);
    return {first, count};
  }
  // The box, rounded outward, at a place of a leaf.
  void set(LeafRun leaf, std::size_t place, BodyId id, const Box<D>& box) {
    float* at = words_.data() + kWords * leaf.first + place;
    for (int i = 0; i < D; ++i) {
      *at = BoxTable<D>::rounded_down(box.lo[i]);
      at[leaf.count] = BoxTable<D>::rounded_up(box.hi[i]);
      at += 2 * leaf.count;
    }
    std::memcpy(at, &id, sizeof id);
  }
  // It will soon be looked at.
  void fetch(LeafRun leaf) const {
    constexpr std::size_t kLine = 64 / sizeof(float);
    const float* at = words_.data() + kWords * leaf.first;
    for (std::size_t i = 0; i < kWords * leaf.count; i += kLine) __builtin_prefetch(at + i);
  }
  BoxRow<D> row(LeafRun leaf) const {
    BoxRow<D> row;
    const float* at = words_.data() + kWords * leaf.first;
    for (int i = 0; i < D; ++i) {
      row.lo[i] = at;
      row.hi[i] = at + leaf.count;
      at += 2 * leaf.count;
    }
    row.ids = reinterpret_cast<const std::byte*>(at);
    return row;
  }

 private:
  static constexpr std::size_t kWords = 2 * D + 1;
  static_assert(sizeof(BodyId) == sizeof(float));
  std::size_t places_ = 0;
  std::vector<float> words_;
};

// --- what of a row is met ---

// Boxes of a row that are looked at together.
inline constexpr std::uint32_t kAabbBlock = 16;

// A box in float, rounded outward.
template <int D>
struct FloatBox {
  float lo[D], hi[D];

  explicit FloatBox(const Box<D>& box) {
    for (int i = 0; i < D; ++i) {
      lo[i] = BoxTable<D>::rounded_down(box.lo[i]);
      hi[i] = BoxTable<D>::rounded_up(box.hi[i]);
    }
  }
};

// A ray in float. Where it enters a box, and leaves it, is known but for `slack` on each axis and a
// small part of what it is.
template <int D>
struct FloatRay {
  float origin[D], inverse[D], slack[D];
  float below[D], above[D];  // the origin, rounded down and up
  bool stands[D];            // it does not move along this axis

  explicit FloatRay(const Ray<D>& ray) {
    for (int i = 0; i < D; ++i) {
      origin[i] = static_cast<float>(ray.origin[i]);
      below[i] = BoxTable<D>::rounded_down(ray.origin[i]);
      above[i] = BoxTable<D>::rounded_up(ray.origin[i]);
      stands[i] = ray.direction[i] == 0;
      inverse[i] = stands[i] ? 0 : static_cast<float>(1 / ray.direction[i]);
      // Numbers below the least normal one have fewer digits.
      slack[i] =
          std::abs(inverse[i] * origin[i]) * 0x1p-22f + (1 + std::abs(inverse[i])) * 0x1p-123f;
    }
  }

  // Whether all of its numbers lie well within float: else it must not be used.
  bool is_usable() const {
    constexpr float kMost = 1e30f;
    bool all = true;
    for (int i = 0; i < D; ++i) {
      const float size = stands[i] ? 1 : std::abs(inverse[i]);
      all = all && std::abs(origin[i]) < kMost && 1 / kMost < size && size < kMost &&
            slack[i] < kMost;
    }
    return all;
  }
};

// A ball in float. How far a box is from its centre on an axis is known but for `slack` and a small
// part of what it is.
template <int D>
struct FloatBall {
  float center[D], slack[D];
  float square;  // of the radius

  FloatBall(const Vec<D>& at, double radius) : square(static_cast<float>(radius * radius)) {
    for (int i = 0; i < D; ++i) {
      center[i] = static_cast<float>(at[i]);
      slack[i] = std::abs(center[i]) * 0x1p-21f;
    }
  }

  // Whether all of its numbers lie well within float: else it must not be used.
  bool is_usable() const {
    bool all = square > 1e-30f && square < 1e30f;
    for (int i = 0; i < D; ++i) all = all && std::abs(center[i]) < 1e15f;
    return all;
  }
};

// A bit for each of the first kAabbBlock boxes of a row: those that overlap that of `asked`, and
// those that certainly do, if both have been rounded outward by less than one float.
struct BlockBits {
  std::uint32_t maybe = 0, surely = 0;
};
template <int D>
BlockBits reached_in_block(const BoxRow<D>& row, const FloatBox<D>& asked);

// What is told of each box of a block beside its bits: no more than where a ray enters it, or than
// the square of its distance from a ball's centre.
using BlockEntries = std::array<float, kAabbBlock>;
template <int D>
BlockBits reached_in_block(const BoxRow<D>& row, const FloatBall<D>& ball, BlockEntries& entries);
// Those that the ray may meet before `limit`, and those that it certainly meets before its end, if
// that is the limit.
template <int D>
BlockBits met_in_block(const BoxRow<D>& row, const FloatRay<D>& ray, float limit,
                       BlockEntries& entries);

// How many nodes, or rows, a walk entered, and how many branches it left out.
struct WalkCounts {
  std::uint64_t visited = 0;
  std::uint64_t skipped = 0;
  std::uint64_t compared = 0;  // bodies of the rows among those visited
};

// f(id, is_sure) for the boxes of a row that the probe may meet before `limit()`, of an ordered
// one about in that order; sure are those that it meets. `soon(id)` is told of all of a block
// before f is of any. How many f was told of.
template <int D, class Probe, class Limit, class Soon, class F>
std::uint32_t each_in_row(const BoxRow<D>& row, std::uint32_t count, const Probe& probe,
                          Limit& limit, Soon&& soon, F&& f) {
  struct Next {
    float entry;
    BodyId id;
    bool is_sure;
  };
  // Of more than a few that come in an order most are never looked at.
  constexpr std::uint32_t kFew = 4;
  std::uint32_t told = 0;
  for (std::uint32_t first = 0; first < count; first += kAabbBlock) {
    BlockEntries entries;
    std::array<Next, kAabbBlock> next;
    const auto [maybe, surely] = probe.bits(first == 0 ? row : row.from(first), limit(), entries);
    std::uint32_t size = 0;
    std::uint32_t bits = maybe & ((1u << std::min(kAabbBlock, count - first)) - 1);
    for (; bits != 0; bits &= bits - 1) {
      const auto i = static_cast<std::uint32_t>(std::countr_zero(bits));
      next[size++] = {Probe::kIsOrdered ? entries[i] : 0, row.id(first + i),
                      (surely >> i & 1) != 0};
    }
    if (!Probe::kIsOrdered || size <= kFew)
      for (std::uint32_t i = 0; i < size; ++i) soon(next[i].id);
    for (std::uint32_t i = 0; i < size; ++i) {
      if constexpr (Probe::kIsOrdered) {
        std::uint32_t least = i;
        for (std::uint32_t k = i + 1; k < size; ++k)
          if (next[k].entry < next[least].entry) least = k;
        std::swap(next[i], next[least]);
        if (next[i].entry > limit()) break;
      }
      f(next[i].id, next[i].is_sure);
      ++told;
    }
  }
  return told;
}

}  // namespace lantern::spatial
