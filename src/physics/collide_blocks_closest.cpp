#include <limits>

#include "physics/collide_blocks.hpp"

namespace lantern::narrow {
namespace {

// Calls f(corner, name) for each corner; those that coincide, for want of thickness, once.
template <int D, class F>
void each_corner(const Block<D>& block, const F& f) {
  for (std::uint32_t signs = 0; signs < 1u << D; ++signs) {
    Vec<D> corner = block.half;
    bool again = false;
    for (int i = 0; i < D; ++i) {
      if ((signs >> i & 1u) != 0) continue;
      corner[i] = -corner[i];
      again |= block.half[i] <= 0;
    }
    if (!again) f(block.world(corner), signs);
  }
}

// Calls f(edge, name) for each edge, in the same way.
template <class F>
void each_edge(const Block<3>& block, const F& f) {
  for (int i = 0; i < 3; ++i) {
    if (block.half[i] <= 0) continue;
    Block<3> start = block;  // its corners are where the edges along i begin
    start.center -= block.axes[i] * block.half[i];
    start.half[i] = 0;
    each_corner(start, [&](const Vec<3>& corner, std::uint32_t signs) {
      f(Segment<3>{corner, corner + block.axes[i] * (2 * block.half[i])},
        signs | static_cast<std::uint32_t>(i) << 3);
    });
  }
}

template <int D>
Vec<D> closest_point(const Block<D>& block, const Vec<D>& point) {
  return block.world(glm::clamp(block.local(point), -block.half, block.half));
}

}  // namespace

// Two convex bodies with flat faces are closest in a corner and a point of the other one, or in two
// edges. They are tried one by one, but for those that lie too low behind the axis: if the closest
// points lie u and v below the ends of their blocks along it,
//
//   distance >= separation along the axis + u + v,
//
// so that no feature with a larger u than `distance so far - separation` can be better.
template <int D>
ClosestFeatures<D> closest_features(const Block<D>& a, const Block<D>& b,
                                    const SeparatingAxis<D>& axis) {
  ClosestFeatures<D> best;
  double least = std::numeric_limits<double>::infinity();  // a square
  const auto consider = [&](const PointPair<D>& points, std::uint32_t feature) {
    if (const double square = points.square(); square < least)
      least = square, best = {points, feature};
  };
  const double reach_a = a.reach(axis.normal), reach_b = b.reach(axis.normal);
  const double rounding = kRounding * (reach_a + reach_b + std::abs(axis.separation));
  const auto is_low = [&](double below) {
    return below > std::sqrt(least) - axis.separation + rounding;
  };
  const auto below_a = [&](const Vec<D>& p) {
    return reach_a - glm::dot(p - a.center, axis.normal);
  };
  const auto below_b = [&](const Vec<D>& p) {
    return reach_b + glm::dot(p - b.center, axis.normal);
  };

  each_corner(a, [&](const Vec<D>& corner, std::uint32_t name) {
    if (!is_low(below_a(corner))) consider({corner, closest_point(b, corner)}, 1u << 10 | name);
  });
  each_corner(b, [&](const Vec<D>& corner, std::uint32_t name) {
    if (!is_low(below_b(corner))) consider({closest_point(a, corner), corner}, 2u << 10 | name);
  });
  if constexpr (D == 3)
    each_edge(a, [&](const Segment<3>& edge_a, std::uint32_t name_a) {
      if (is_low(std::min(below_a(edge_a.a), below_a(edge_a.b)))) return;
      each_edge(b, [&](const Segment<3>& edge_b, std::uint32_t name_b) {
        if (is_low(std::min(below_b(edge_b.a), below_b(edge_b.b)))) return;
        consider(closest_points(edge_a, edge_b), 3u << 10 | name_a << 5 | name_b);
      });
    });
  return best;
}

template ClosestFeatures<2> closest_features(const Block<2>&, const Block<2>&,
                                             const SeparatingAxis<2>&);
template ClosestFeatures<3> closest_features(const Block<3>&, const Block<3>&,
                                             const SeparatingAxis<3>&);

}  // namespace lantern::narrow
