// Two capsules: the closest points of their segments; two contacts where they lie along each other.
#include "physics/collide_cores.hpp"

namespace lantern::narrow {
namespace {

// Segments at a larger angle than this (its sine, about 6 degrees) meet in one point.
constexpr double kMostParallel = 0.1;

// The two ends of where segment b lies along segment a.
//
//          b  o------------o            n: normal, from a to b
//        x            x    |
//   a  o-+------------+    | <- the points x are midway between the surfaces
//
// Nothing if they cross rather than lie along each other, or hardly overlap.
template <int D>
Contact<D> two_points(const PlacedCore<D>& a, const PlacedCore<D>& b, const Direction<D>& normal,
                      double margin) {
  const Vec<D> along = a.along(), n = normal.unit;
  if (std::abs(glm::dot(along, n)) > kMostParallel) return std::nullopt;
  const double turn = glm::dot(along, b.along());
  if (std::abs(turn) < std::sqrt(1 - kMostParallel * kMostParallel)) return std::nullopt;

  const double middle = glm::dot(b.center - a.center, along);
  const double reach = b.half.y * std::abs(turn);
  const double from = std::max(-a.half.y, middle - reach);
  const double to = std::min(a.half.y, middle + reach);
  const double shorter = std::min(a.half.y, b.half.y);
  if (to - from <= 1e-3 * shorter) return std::nullopt;

  const double radii = a.radius + b.radius;
  Manifold<D> manifold;
  manifold.normal = n;
  double least = 0;
  for (const double t : {from, to}) {
    const Vec<D> on_a = a.center + along * t;
    const Vec<D> on_b = b.center + b.along() * ((t - middle) / turn);
    const double distance = glm::dot(on_b - on_a, n);
    if (glm::length(on_b - on_a - n * distance) > kMostParallel * radii + kRounding * shorter)
      return std::nullopt;
    const double separation = distance - radii;
    manifold.add({on_a + n * (a.radius + separation / 2), separation, t == from ? 1u : 2u});
    least = t == from ? separation : std::min(least, separation);
  }
  // The deeper one stands for the closest points, whose distance is exact.
  for (int i = 0; i < 2; ++i) {
    ManifoldPoint<D>& point = manifold.room[static_cast<std::size_t>(i)];
    if (point.separation == least) point.separation = normal.length - radii;
  }
  if (manifold.room[1].separation > margin) manifold.count = 1;
  if (manifold.room[0].separation > margin) manifold.room[0] = manifold.room[--manifold.count];
  return manifold;
}

}  // namespace

template <int D>
Contact<D> touch_segments(const PlacedCore<D>& a, const PlacedCore<D>& b, double margin) {
  const PointPair<D> closest = closest_points(a.segment(), b.segment());
  const Direction<D> normal = direction_of(closest.b - closest.a, fallback_normal<D>());
  const double size = a.half.y + b.half.y + glm::length(b.center - a.center);
  // Segments that cross have no direction between them: they part by separating axes.
  if (normal.length <= kRounding * size) return touch_blocks(a, b, margin);
  if (normal.length - a.radius - b.radius > margin) return std::nullopt;
  if (const Contact<D> contact = two_points(a, b, normal, margin)) return contact;
  return one_point(closest.a, a.radius, b.radius, normal);
}

template Contact<2> touch_segments(const PlacedCore<2>&, const PlacedCore<2>&, double);
template Contact<3> touch_segments(const PlacedCore<3>&, const PlacedCore<3>&, double);

}  // namespace lantern::narrow
