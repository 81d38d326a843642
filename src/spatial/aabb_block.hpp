// Which bodies of a few that stand side by side in a table a box reaches, or a ray meets: looked at
// several at a time, in float.
#pragma once

#include <cmath>
#include <cstdint>

#include "geometry/ray.hpp"
#include "spatial/aabb_node.hpp"

namespace lantern::spatial {

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
BlockBits reached_in_block(const BoxTable<2>& table, std::uint32_t first, const AabbNode<2>& asked);
BlockBits reached_in_block(const BoxTable<3>& table, std::uint32_t first, const AabbNode<3>& asked);

// The same of those that the ray may meet before `limit`.
std::uint32_t met_in_block(const BoxTable<2>& table, std::uint32_t first, const FloatRay<2>& ray,
                           float limit);
std::uint32_t met_in_block(const BoxTable<3>& table, std::uint32_t first, const FloatRay<3>& ray,
                           float limit);

}  // namespace lantern::spatial
