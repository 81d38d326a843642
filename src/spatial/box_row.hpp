// Rounded boxes that stand in a row, and which of them a ray, a box, a ball or a point meets: some
// instructions for sixteen of them (box_vectors.cpp).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "geometry/ray.hpp"
#include "spatial/box_table.hpp"

namespace lantern::spatial {

// A box in float, rounded outward; and two floats smaller on each side, which lies within the box.
template <int D>
struct FloatBox {
  float lo[D], hi[D], sure_lo[D], sure_hi[D];

  explicit FloatBox(const Box<D>& box) {
    for (int i = 0; i < D; ++i) {
      lo[i] = BoxTable<D>::rounded_down(box.lo[i]);
      hi[i] = BoxTable<D>::rounded_up(box.hi[i]);
      sure_lo[i] = detail::stepped(lo[i], 2);
      sure_hi[i] = detail::stepped(hi[i], -2);
    }
  }
};

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
  // Of nodes whose leaves lie in so many places: the item at each place, its box rounded outward.
  // leaf_of(node) is an optional<LeafRun>.
  template <class LeafOf, class ItemAt>
  void fill(std::size_t places, std::size_t nodes, LeafOf&& leaf_of, ItemAt&& item_at) {
    words_.resize(kWords * (places + BoxTable<D>::kPadding));
    for (std::uint32_t node = 0; node < nodes; ++node) {
      const std::optional<LeafRun> leaf = leaf_of(node);
      for (std::uint32_t i = 0; leaf && i < leaf->count; ++i) {
        const Item<D>& item = item_at(leaf->first + i);
        const FloatBox<D> box(item.box);
        float* at = words_.data() + kWords * leaf->first + i;
        for (int axis = 0; axis < D; ++axis, at += 2 * leaf->count) {
          at[0] = box.lo[axis];
          at[leaf->count] = box.hi[axis];
        }
        std::memcpy(at, &item.id, sizeof item.id);
      }
    }
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
  std::vector<float> words_;
};

// Boxes of a row that are looked at together.
inline constexpr std::uint32_t kRowBlock = 16;
// For who looks for all that is met, at once: how far, and what is told of bodies to be looked at.
inline constexpr auto kNoLimit = [] { return 0.0; };
inline constexpr auto kNothingSoon = [](BodyId) {};

// Up to kRowBlock boxes whose edges take a byte each: the steps from the row's origin, outward
// (Benthin, Wald, Woop, Afra: "Compressed-Leaf Bounding Volume Hierarchies", 2018).
//
//   count, flags, steps' exponents | origin | ids 7 2 4 | lo.x 1 9 60 | hi.x 30 41 254 | lo.y ...
//
// A step is a power of two, and the origin a multiple of it: whatever is reckoned from them is
// exact in float. Edges beyond kFar are the codes 0 and 255 of a row that is endless.
template <int D>
class PackedRow {
 public:
  static constexpr int kDimension = D;
  static constexpr float kFar = 0x1p126f;
  static constexpr std::uint32_t kLeast = 1, kMost = 254, kEnd = 255;  // codes
  static constexpr std::uint32_t kHoldsBodies = 32;  // all that is said of no boxes

  // Where it stands among words.
  explicit PackedRow(const std::uint32_t* at) : at_(at) {}
  static std::size_t words(std::uint32_t count) { return kHead + count + (2 * D * count + 3) / 4; }

  std::uint32_t count() const { return at_[0] & 31; }
  bool holds_bodies() const { return (at_[0] & kHoldsBodies) != 0; }
  bool is_endless() const { return (at_[0] & kIsEndless) != 0; }
  float origin(int axis) const { return std::bit_cast<float>(at_[1 + axis]); }
  float step(int axis) const {  // its exponent is written as a float's
    return std::bit_cast<float>((at_[0] >> (8 * (axis + 1)) & 255) << 23);
  }
  float edge(int axis, std::uint32_t code) const {
    return origin(axis) + static_cast<float>(code) * step(axis);
  }
  std::uint32_t id(std::size_t place) const { return at_[kHead + place]; }
  std::span<const std::uint32_t> ids() const { return {at_ + kHead, count()}; }
  Box<D> box(std::size_t place) const {  // what is far ends where double ends
    constexpr double kLast = std::numeric_limits<double>::max();
    Box<D> box;
    for (int i = 0; i < D; ++i) {
      const std::uint32_t low = lo(i)[place], high = hi(i)[place];
      box.lo[i] = low < kLeast ? -kLast : edge(i, low);
      box.hi[i] = high > kMost ? kLast : edge(i, high);
    }
    return box;
  }
  const std::uint8_t* lo(int axis) const {
    return reinterpret_cast<const std::uint8_t*>(at_ + kHead + count()) +
           2 * count() * unsigned(axis);
  }
  const std::uint8_t* hi(int axis) const { return lo(axis) + count(); }

  // box(place) has lo[D] and hi[D] in float.
  template <class BoxAt, class IdAt>
  static void write(std::uint32_t* at, std::uint32_t count, bool holds_bodies, BoxAt&& box,
                    IdAt&& id) {
    at[0] = count | (holds_bodies ? kHoldsBodies : 0);
    for (std::uint32_t i = 0; i < count; ++i) at[kHead + i] = id(i);
    auto* codes = reinterpret_cast<std::uint8_t*>(at + kHead + count);
    for (int axis = 0; axis < D; ++axis) {
      double lo = kFar, hi = -kFar;
      for (std::uint32_t i = 0; i < count; ++i)
        for (const float edge : {box(i).lo[axis], box(i).hi[axis]})
          if (is_far(edge)) {
            at[0] |= kIsEndless;
          } else {
            lo = std::min<double>(lo, edge);
            hi = std::max<double>(hi, edge);
          }
      if (hi < lo) lo = hi = 0;
      const int exponent = exponent_for(lo, hi);
      const double per_unit = std::ldexp(1.0, -exponent);
      const double first = std::floor(lo * per_unit) - kLeast;
      at[0] |= static_cast<std::uint32_t>(exponent + 127) << (8 * (axis + 1));
      at[1 + axis] = std::bit_cast<std::uint32_t>(static_cast<float>(first / per_unit));
      for (std::uint32_t i = 0; i < count; ++i, ++codes) {
        const double low = box(i).lo[axis], high = box(i).hi[axis];
        codes[0] = static_cast<std::uint8_t>(is_far(low) ? 0 : std::floor(low * per_unit) - first);
        codes[count] =
            static_cast<std::uint8_t>(is_far(high) ? kEnd : std::ceil(high * per_unit) - first);
      }
      codes += count;
    }
  }

 private:
  static constexpr std::size_t kHead = 1 + D;
  static constexpr std::uint32_t kIsEndless = 64;

  static bool is_far(double edge) { return !(std::abs(edge) < kFar); }
  // Of the least step with which all fits, and no multiple has more digits than a float.
  static int exponent_for(double lo, double hi) {
    const auto log = [](double x) { return std::ilogb(std::max(x, 0x1p-126)); };
    int exponent = std::max({-126, log(hi - lo) - 7, log(std::max(-lo, hi)) - 22});
    const auto steps = [&] {
      const double per_unit = std::ldexp(1.0, -exponent);
      return std::ceil(hi * per_unit) - std::floor(lo * per_unit);
    };
    while (steps() > kMost - kLeast) ++exponent;
    return exponent;
  }

  const std::uint32_t* at_;
};

// --- what of a row is met ---

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

// A bit for each of the first kRowBlock boxes of a row, a BoxRow or a PackedRow: those that may be
// met, and those that certainly are, though the box in double lies further within than the row's
// by less than a float, or a step.
struct BlockBits {
  std::uint32_t maybe = 0, surely = 0;
};
// Of each box of a block: no more than where a ray enters it, or than the square of its distance
// from a ball's centre. Who asks for them is not told what is certain.
using BlockEntries = std::array<float, kRowBlock>;

// Those that overlap the box; those that reach into the ball; those that the ray meets before
// `limit`, which is its end where it is asked what is certain.
template <class Row, int D>
BlockBits reached_in_block(const Row& row, const FloatBox<D>& asked);
template <class Row, int D>
BlockBits reached_in_block(const Row& row, const FloatBall<D>& ball, BlockEntries* entries);
template <class Row, int D>
BlockBits met_in_block(const Row& row, const FloatRay<D>& ray, float limit, BlockEntries* entries);

// How many nodes, or rows, a walk entered, and how many branches it left out.
struct WalkCounts {
  std::uint64_t visited = 0;
  std::uint64_t skipped = 0;
  std::uint64_t compared = 0;  // bodies of the rows among those visited
};

// f(id, is_sure) for the first `count` boxes of a row, up to kRowBlock, that the probe may meet
// before `limit()`, of an ordered one about in that order; sure are those that it meets. `soon(id)`
// is told of what will be looked at. How many f was told of.
template <class Row, class Probe, class Limit, class Soon, class F>
std::uint32_t each_in_block(const Row& row, std::uint32_t count, const Probe& probe, Limit& limit,
                            Soon&& soon, F&& f) {
  BlockEntries entries;
  const auto [maybe, surely] = probe.bits(row, limit(), entries);
  const std::uint32_t met = maybe & ((1u << count) - 1);
  const auto size = static_cast<std::uint32_t>(std::popcount(met));
  const auto each = [&](auto&& tell) {
    for (std::uint32_t bits = met; bits != 0; bits &= bits - 1)
      tell(static_cast<std::uint32_t>(std::countr_zero(bits)));
  };
  if constexpr (!Probe::kIsOrdered) {
    each([&, sure = surely](std::uint32_t place) {
      soon(row.id(place));
      f(row.id(place), (sure >> place & 1) != 0);
    });
    return size;
  } else {
    // The order of floats that are not negative is that of their bits, of which the last are the
    // place's own here: so the least is found without a branch.
    constexpr std::int32_t kPlace = kRowBlock - 1, kDone = 0x7fff'ffff;
    const auto key = [&](std::uint32_t place) {
      return (std::bit_cast<std::int32_t>(entries[place]) & ~kPlace) |
             static_cast<std::int32_t>(place);
    };
    const auto in_order = [&](auto& keys) {
      for (std::uint32_t told = 0; told < size; ++told) {
        std::int32_t least = kDone;
        for (const std::int32_t one : keys) least = std::min(least, one);
        for (std::int32_t& one : keys) one = one == least ? kDone : one;
        if (std::bit_cast<float>(least & ~kPlace) > limit()) return told;
        f(row.id(static_cast<std::size_t>(least & kPlace)), false);
      }
      return size;
    };
    constexpr std::uint32_t kFew = 4;
    if (size > kFew) {  // most of these are never looked at
      std::array<std::int32_t, kRowBlock> keys;
      for (std::uint32_t i = 0; i < kRowBlock; ++i) keys[i] = (met & 1u << i) != 0 ? key(i) : kDone;
      return in_order(keys);
    }
    std::array<std::int32_t, kFew> keys;
    keys.fill(kDone);
    each([&, next = keys.begin()](std::uint32_t place) mutable {
      soon(row.id(place));
      *next++ = key(place);
    });
    return in_order(keys);
  }
}
// The same of any number of boxes.
template <int D, class Probe, class Limit, class Soon, class F>
void each_in_row(const BoxRow<D>& row, std::uint32_t count, const Probe& probe, Limit& limit,
                 Soon&& soon, F&& f) {
  for (std::uint32_t first = 0; first < count; first += kRowBlock)
    each_in_block(row.from(first), std::min(kRowBlock, count - first), probe, limit, soon, f);
}

}  // namespace lantern::spatial
