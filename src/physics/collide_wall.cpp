// A core against a half-space: its lowest corners are the contacts.
#include <algorithm>
#include <array>

#include "physics/collide_cores.hpp"

namespace lantern::narrow {

// As many of those that touch as a manifold holds. They stay in the order of their features,
// whichever of them rounding makes the lowest.
template <int D>
Contact<D> touch_wall(const PlacedCore<D>& core, const Wall<D>& wall, double margin) {
  std::array<ManifoldPoint<D>, 1u << D> room;
  std::size_t count = 0;
  each_corner(core, [&](const Vec<D>& corner, std::uint32_t) {
    ManifoldPoint<D>& point = room[count];
    point.feature = static_cast<std::uint32_t>(count++);
    point.separation = glm::dot(corner - wall.point, wall.normal) - core.radius;
    point.position = corner - wall.normal * (core.radius + point.separation / 2);
  });
  const std::span<const ManifoldPoint<D>> corners{room.data(), count};
  const auto is_lower = [](const ManifoldPoint<D>& x, const ManifoldPoint<D>& y) {
    return x.separation != y.separation ? x.separation < y.separation : x.feature < y.feature;
  };
  Manifold<D> manifold;
  manifold.normal = -wall.normal;
  for (const ManifoldPoint<D>& corner : corners) {
    const auto lower = std::count_if(corners.begin(), corners.end(),
                                     [&](const auto& other) { return is_lower(other, corner); });
    if (corner.separation <= margin && lower < Manifold<D>::kMostPoints) manifold.add(corner);
  }
  if (manifold.count == 0) return std::nullopt;
  return manifold;
}

template Contact<2> touch_wall(const PlacedCore<2>&, const Wall<2>&, double);
template Contact<3> touch_wall(const PlacedCore<3>&, const Wall<3>&, double);

}  // namespace lantern::narrow
