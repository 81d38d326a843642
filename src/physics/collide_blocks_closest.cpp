#include <array>
#include <limits>

#include "physics/collide_blocks.hpp"

namespace lantern::physics::narrow {
namespace {

// Calls f(edge, name) for each edge, as each_corner does.
template <class F>
void each_edge(const PlacedCore<3>& block, const F& f) {
  for (int i = 0; i < 3; ++i) {
    if (block.half[i] <= 0) continue;
    PlacedCore<3> start = block;  // its corners are where the edges along i begin
    start.center -= block.axes[i] * block.half[i];
    start.half[i] = 0;
    each_corner(start, [&](const Vec<3>& corner, std::uint32_t signs) {
      f(Segment<3>{corner, corner + block.axes[i] * (2 * block.half[i])},
        signs | static_cast<std::uint32_t>(i) << 3);
    });
  }
}

template <int D>
Vec<D> closest_point(const PlacedCore<D>& block, const Vec<D>& point) {
  return block.world(glm::clamp(block.local(point), -block.half, block.half));
}

// Two convex bodies with flat faces are closest in a corner and a point of the other one, or in two
// edges. They are tried one by one, but for those that lie too far back: if the closest points lie
// u and v behind the fronts of their blocks along the axis,
//
//   distance >= separation along the axis + u + v,
//
// so that features with a larger u + v than `distance so far - separation` cannot be better.
template <int D>
class ClosestSearch {
 public:
  ClosestSearch(const PlacedCore<D>& a, const PlacedCore<D>& b, const SeparatingAxis<D>& axis,
                NarrowTrace<D>& trace)
      : a_(a),
        b_(b),
        axis_(axis),
        trace_(trace),
        reach_a_(a.reach(axis.normal)),
        reach_b_(b.reach(axis.normal)) {}

  ClosestFeatures<D> run() {
    each_corner(a_, [&](const Vec<D>& corner, std::uint32_t name) {
      if (behind_a(corner) <= slack_)
        consider({corner, closest_point(b_, corner)}, 1u << 10 | name);
    });
    each_corner(b_, [&](const Vec<D>& corner, std::uint32_t name) {
      if (behind_b(corner) <= slack_)
        consider({closest_point(a_, corner), corner}, 2u << 10 | name);
    });
    if constexpr (D == 3) try_edges();
    return best_;
  }

 private:
  struct Edge {
    Segment<3> segment;
    double behind = 0;
    std::uint32_t name = 0;
  };

  // Ends of edges are corners, which have been tried: what is left is where edges cross.
  void try_edges() {
    std::array<Edge, 12> of_b;
    std::size_t count = 0;
    each_edge(b_, [&](const Segment<3>& edge, std::uint32_t name) {
      const double behind = std::min(behind_b(edge.a), behind_b(edge.b));
      if (behind <= slack_) of_b[count++] = {edge, behind, name};
    });
    each_edge(a_, [&](const Segment<3>& edge, std::uint32_t name) {
      const double behind = std::min(behind_a(edge.a), behind_a(edge.b));
      for (std::size_t i = 0; i < count; ++i)
        if (behind + of_b[i].behind <= slack_)
          consider(crossing_points(edge, of_b[i].segment), 3u << 10 | name << 5 | of_b[i].name);
    });
  }

  void consider(const PointPair<D>& points, std::uint32_t feature) {
    const double square = points.square();
    trace_.lengths += 2 + D;  // how far back, the other one's point, the distance
    if (square >= least_) return;
    least_ = square;
    best_ = {points, feature};
    const double rounding = kRounding * (reach_a_ + reach_b_ + std::abs(axis_.separation));
    slack_ = std::sqrt(square) - axis_.separation + rounding;
  }

  double behind_a(const Vec<D>& p) const {
    return reach_a_ - glm::dot(p - a_.center, axis_.normal);
  }
  double behind_b(const Vec<D>& p) const {
    return reach_b_ + glm::dot(p - b_.center, axis_.normal);
  }

  const PlacedCore<D>& a_;
  const PlacedCore<D>& b_;
  const SeparatingAxis<D>& axis_;
  NarrowTrace<D>& trace_;
  double reach_a_, reach_b_;
  double least_ = std::numeric_limits<double>::infinity();  // the square of the least distance
  double slack_ = std::numeric_limits<double>::infinity();
  ClosestFeatures<D> best_;
};

}  // namespace

template <int D>
ClosestFeatures<D> closest_features(const PlacedCore<D>& a, const PlacedCore<D>& b,
                                    const SeparatingAxis<D>& axis, NarrowTrace<D>& trace) {
  return ClosestSearch<D>(a, b, axis, trace).run();
}

template ClosestFeatures<2> closest_features(const PlacedCore<2>&, const PlacedCore<2>&,
                                             const SeparatingAxis<2>&, NarrowTrace<2>&);
template ClosestFeatures<3> closest_features(const PlacedCore<3>&, const PlacedCore<3>&,
                                             const SeparatingAxis<3>&, NarrowTrace<3>&);

}  // namespace lantern::physics::narrow
