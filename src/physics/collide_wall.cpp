// Everything against a half-space: its lowest points are the contacts.
#include <algorithm>
#include <array>

#include "physics/collide_forms.hpp"

namespace lantern::narrow {
namespace {

// The lowest points of a core that touch the wall, as many as a manifold holds. They stay in the
// order of their features, whichever of them rounding makes the lowest.
template <int D, std::size_t N>
Contact<D> lowest_points(std::array<ManifoldPoint<D>, N> corners, double radius,
                         const Wall<D>& wall, double margin) {
  for (ManifoldPoint<D>& corner : corners) {
    corner.separation = glm::dot(corner.position - wall.point, wall.normal) - radius;
    corner.position -= wall.normal * (radius + corner.separation / 2);
  }
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

}  // namespace

template <int D>
Contact<D> touch(const Ball<D>& a, const Wall<D>& b, double margin) {
  return lowest_points<D, 1>({{{a.center, 0, 0}}}, a.radius, b, margin);
}

template <int D>
Contact<D> touch(const Rod<D>& a, const Wall<D>& b, double margin) {
  const Segment<D> segment = a.segment();
  return lowest_points<D, 2>({{{segment.a, 0, 0}, {segment.b, 0, 1}}}, a.radius, b, margin);
}

template <int D>
Contact<D> touch(const Block<D>& a, const Wall<D>& b, double margin) {
  std::array<ManifoldPoint<D>, 1u << D> corners;
  for (std::uint32_t signs = 0; signs < corners.size(); ++signs) {
    Vec<D> corner = a.half;
    for (int i = 0; i < D; ++i)
      if ((signs >> i & 1u) == 0) corner[i] = -corner[i];
    corners[signs] = {a.world(corner), 0, signs};
  }
  return lowest_points<D>(corners, a.radius, b, margin);
}

template Contact<2> touch(const Ball<2>&, const Wall<2>&, double);
template Contact<3> touch(const Ball<3>&, const Wall<3>&, double);
template Contact<2> touch(const Block<2>&, const Wall<2>&, double);
template Contact<3> touch(const Block<3>&, const Wall<3>&, double);
template Contact<2> touch(const Rod<2>&, const Wall<2>&, double);
template Contact<3> touch(const Rod<3>&, const Wall<3>&, double);

}  // namespace lantern::narrow
