// Planes for a BSP over the tests' worlds: some along the axes, some slanted, some through corners
// of bodies.
#pragma once

#include <vector>

#include "base/random.hpp"
#include "spatial/trees/bsp.hpp"
#include "spatial/worlds.hpp"

namespace lantern::spatial::testing {

template <int D>
std::vector<BspPlane<D>> random_planes(Sort sort, std::size_t count, Random& random) {
  const Box<D> bounds = bounds_of<D>(sort);
  std::vector<BspPlane<D>> planes;
  std::set<std::pair<std::uint32_t, bool>> taken;
  while (planes.size() < count) {
    const auto parent = planes.empty() ? kNone
                                       : static_cast<std::uint32_t>(random.whole(
                                             0, static_cast<std::int64_t>(planes.size()) - 1));
    const bool front = !planes.empty() && random.bits() % 2 == 0;
    if (!taken.insert({parent, front}).second) continue;
    Vec<D> point = random_point<D>(random, bounds.lo[0], bounds.hi[0]), normal{0.0};
    if (random.bits() % 2 == 0)
      normal[static_cast<int>(random.whole(0, D - 1))] = random.bits() % 2 == 0 ? 1 : -2;
    else
      normal = random_point<D>(random, -1, 1);
    if (random.bits() % 2 == 0) {  // through the corners of boxes in an aligned world
      for (int i = 0; i < D; ++i)
        point[i] = bounds.lo[i] + 4.0 * static_cast<double>(random.whole(0, 15));
      for (int i = 0; i < D; ++i) normal[i] = static_cast<double>(random.whole(-1, 1));
      if (normal == Vec<D>(0.0)) normal[0] = 1;
    }
    planes.push_back({Plane<D>::through(point, normal), parent, front});
  }
  return planes;
}

}  // namespace lantern::spatial::testing
