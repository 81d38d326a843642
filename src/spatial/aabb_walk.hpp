// The ways of boxes and rays through an AABB tree, for when nobody watches.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "geometry/ray.hpp"
#include "spatial/aabb_block.hpp"
#include "spatial/aabb_node.hpp"

namespace lantern::spatial {

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
