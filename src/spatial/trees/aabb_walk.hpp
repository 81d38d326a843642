// The nodes of an AABB tree, and the ways of boxes and rays through it, for when nobody watches.
#pragma once

#include <cmath>
#include <limits>
#include <utility>

#include "geometry/ray.hpp"
#include "spatial/box_table.hpp"

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

// --- bodies of a block: a few that stand side by side in a table, looked at several at a time ---

// Bodies below a node that is not opened.
inline constexpr std::uint32_t kAabbBlock = 16;

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
      slack[i] = std::abs(inverse[i] * origin[i]) * 0x1p-22f;
    }
  }

  // Whether all of its numbers lie well within float: else it must not be used.
  bool is_usable() const {
    constexpr float kMost = 1e30f;
    bool all = true;
    for (int i = 0; i < D; ++i)
      all = all && std::abs(origin[i]) < kMost && std::abs(inverse[i]) < kMost && slack[i] < kMost;
    return all;
  }
};

// A bit for each of kAabbBlock places from `first` on: those whose boxes overlap that of `asked`,
// and those that certainly do, if both have been rounded outward by less than one float.
struct BlockBits {
  std::uint32_t maybe = 0, surely = 0;
};
template <int D>
BlockBits reached_in_block(const BoxTable<D>& table, std::uint32_t first, const AabbNode<D>& asked);

// The same of those that the ray may meet before `limit`.
template <int D>
std::uint32_t met_in_block(const BoxTable<D>& table, std::uint32_t first, const FloatRay<D>& ray,
                           float limit);

// --- ways ---

// How many nodes a walk entered, and how many branches it left out.
struct WalkCounts {
  std::uint64_t visited = 0;
  std::uint64_t skipped = 0;
  std::uint64_t compared = 0;  // bodies of the blocks among those visited
};

// What is walked through. Of nodes with at most `block` bodies these stand in the table, those of
// the first child before those of the second, and are looked at several at a time; block = 0: no
// table is there.
template <int D>
struct AabbWay {
  std::span<const AabbNode<D>> nodes;
  NodeHandle root;
  const BoxTable<D>& table;
  std::uint32_t block;
  bool is_tight;  // the boxes of leaves are their bodies' own, rounded
};

// A node, and the place of its first body in the table.
struct AabbSpot {
  NodeHandle node = 0;
  std::uint32_t first = 0;
};

namespace detail {

// f(place) for each bit of so many.
template <class F>
void each_bit(std::uint32_t bits, std::uint32_t count, F&& f) {
  for (bits &= (1u << count) - 1; bits != 0; bits &= bits - 1)
    f(static_cast<std::uint32_t>(std::countr_zero(bits)));
}

}  // namespace detail

// f(id, is_sure) for each body whose box in the tree the box reaches; sure are those whose own box
// it reaches.
template <int D, class F>
WalkCounts each_near(const AabbWay<D>& way, const Box<D>& box, F&& f) {
  std::array<AabbSpot, AabbNode<D>::kTallest + 1> waiting;
  const auto asked = AabbNode<D>::leaf({0, box}, 0);
  const auto& nodes = way.nodes;
  if (nodes[way.root].bodies() == 0 || !nodes[way.root].reaches(asked)) return {0, 1};
  WalkCounts counts;
  std::size_t left = 0;
  for (AabbSpot at{way.root, 0};;) {
    ++counts.visited;
    const AabbNode<D>& node = nodes[at.node];
    if (node.is_leaf()) {
      f(node.link, false);
    } else if (node.bodies() <= way.block) {
      counts.compared += node.bodies();
      const BlockBits bits = reached_in_block(way.table, at.first, asked);
      detail::each_bit(bits.maybe, node.bodies(), [&](std::uint32_t i) {
        f(way.table.id(at.first + i), way.is_tight && (bits.surely >> i & 1) != 0);
      });
    } else {
      const AabbNode<D>&one = nodes[node.link], &two = nodes[node.link + 1];
      const bool in_one = one.reaches(asked), in_two = two.reaches(asked);
      const AabbSpot second{node.link + 1, at.first + one.bodies()};
      counts.skipped += 2u - in_one - in_two;
      waiting[left] = second;
      left += in_one & in_two;
      if (in_one | in_two) {
        at = in_one ? AabbSpot{node.link, at.first} : second;
        continue;
      }
    }
    if (left == 0) return counts;
    at = waiting[--left];
  }
}

// A ray that asks nodes: as span_in of geometry/ray.hpp, but with products instead of quotients.
// What is lost by that is given back, so that no box is missed that span_in meets, and none begins
// later than it says.
template <int D>
class AabbRay {
 public:
  static constexpr double kMissed = std::numeric_limits<double>::infinity();

  explicit AabbRay(const Ray<D>& ray) : length_(ray.length) {
    for (int i = 0; i < D; ++i) {
      origin_[i] = ray.origin[i];
      const double inverse = 1 / ray.direction[i];
      // Along an axis on which it (nearly) stands still everything is in its way, unless it begins
      // beside it.
      stands_[i] = !std::isfinite(inverse);
      inverse_[i] = stands_[i] ? 0 : inverse;
      moves_[i] = ray.direction[i] != 0;
    }
  }

  // Where it enters the node's box, or kMissed.
  double entry(const AabbNode<D>& node) const {
    constexpr double kLess = 1 - 1e-15, kMore = 1 + 1e-15;
    double from = 0, to = length_;
    for (int i = 0; i < D; ++i) {
      if (stands_[i]) {
        if (!moves_[i] && (origin_[i] < node.lo[i] || node.hi[i] < origin_[i])) return kMissed;
        continue;
      }
      const double low = (node.lo[i] - origin_[i]) * inverse_[i];
      const double high = (node.hi[i] - origin_[i]) * inverse_[i];
      from = std::max(from, std::min(low, high) * kLess);
      to = std::min(to, std::max(low, high) * kMore);
    }
    return from > to ? kMissed : from;
  }

 private:
  double origin_[D], inverse_[D], length_;
  bool stands_[D], moves_[D];
};

// f(id) for each body whose box in the tree the ray meets, of two siblings first those of the one
// that it enters first; none of a node that it enters beyond `limit()`.
template <int D, class Limit, class F>
WalkCounts each_along(const AabbWay<D>& way, const Ray<D>& ray, Limit&& limit, F&& f) {
  struct Waiting {
    double entry;
    AabbSpot spot;
  };
  std::array<Waiting, AabbNode<D>::kTallest + 1> waiting;
  const AabbRay<D> asking(ray);
  const FloatRay<D> in_float(ray);
  const std::uint32_t block = in_float.is_usable() ? way.block : 0;
  const auto& nodes = way.nodes;
  constexpr double kMissed = AabbRay<D>::kMissed;
  if (nodes[way.root].bodies() == 0 || asking.entry(nodes[way.root]) == kMissed) return {0, 1};
  WalkCounts counts;
  std::size_t left = 0;
  for (AabbSpot at{way.root, 0};;) {
    ++counts.visited;
    const AabbNode<D>& node = nodes[at.node];
    if (node.is_leaf()) {
      f(node.link);
    } else if (node.bodies() <= block) {
      const float end = BoxTable<D>::rounded_up(limit());
      detail::each_bit(met_in_block(way.table, at.first, in_float, end), node.bodies(),
                       [&](std::uint32_t i) { f(way.table.id(at.first + i)); });
    } else {
      Waiting near{asking.entry(nodes[node.link]), {node.link, at.first}};
      Waiting far{asking.entry(nodes[node.link + 1]),
                  {node.link + 1, at.first + nodes[node.link].bodies()}};
      if (far.entry < near.entry) std::swap(near, far);
      waiting[left] = far;
      left += far.entry != kMissed;
      counts.skipped += far.entry == kMissed;
      if (near.entry != kMissed && near.entry <= limit()) {
        at = near.spot;
        continue;
      }
      ++counts.skipped;
    }
    for (;;) {
      if (left == 0) return counts;
      --left;
      if (waiting[left].entry <= limit()) break;
      ++counts.skipped;
    }
    at = waiting[left].spot;
  }
}

}  // namespace lantern::spatial
