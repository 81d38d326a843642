// The shapes as the narrow phase sees them, placed relative to the first body.
//
// Every shape but the half-space is all that lies within a radius of a core, which is a point, a
// box or a segment (geometry/shape.hpp). Two of them are apart by the distance of their cores less
// both radii.
#pragma once

#include <cmath>
#include <optional>
#include <variant>

#include "geometry/closest.hpp"
#include "geometry/shape.hpp"
#include "physics/manifold.hpp"

namespace lantern::physics::narrow {

// A computed length is trusted to this part of the sizes that went into it: about 4500 roundings.
inline constexpr double kRounding = 1e-12;

// The normal of two cores that meet in a point.
template <int D>
Vec<D> fallback_normal() {
  Vec<D> up{0.0};
  up.y = 1;
  return up;
}

// What closed form a core has; one that is a box by its shape is a box, whatever its sizes.
enum class CoreKind { point, box, segment };  // pairs are handled in this order

// Half sizes of 0 make a box of the core a rectangle, a segment or a point.
template <int D>
struct PlacedCore {
  CoreKind kind = CoreKind::box;
  Vec<D> center{0.0};
  Mat<D> axes{1.0};  // columns: unit vectors
  Vec<D> half{0.0};
  double radius = 0;

  // How far the core reaches from its centre along a unit vector.
  double reach(const Vec<D>& n) const {
    double sum = 0;
    for (int i = 0; i < D; ++i) sum += half[i] * std::abs(glm::dot(n, axes[i]));
    return sum;
  }
  // Its point farthest along a vector; of several that are, the one along the axes.
  Vec<D> support(const Vec<D>& n) const {
    Vec<D> point = center;
    for (int i = 0; i < D; ++i) point += axes[i] * (glm::dot(n, axes[i]) < 0 ? -half[i] : half[i]);
    return point;
  }
  // Coordinates along the axes from the centre, and back.
  Vec<D> local(const Vec<D>& point) const {
    Vec<D> coordinates;
    for (int i = 0; i < D; ++i) coordinates[i] = glm::dot(point - center, axes[i]);
    return coordinates;
  }
  Vec<D> world(const Vec<D>& coordinates) const { return center + axes * coordinates; }
  // Of a segment, which lies along its y axis.
  Vec<D> along() const { return axes[1]; }
  Segment<D> segment() const { return {center - along() * half.y, center + along() * half.y}; }
};

// A half-space.
template <int D>
struct Wall {
  Vec<D> point{0.0};
  Vec<D> normal{0.0};  // out of the solid
};

template <int D>
using Placing = std::variant<PlacedCore<D>, Wall<D>>;

// A shape at `center`, wherever it was placed.
template <int D>
Placing<D> placing_of(const Placed<D>& placed, const Vec<D>& center) {
  const auto core = [&](CoreKind kind, const Core<D>& of) -> Placing<D> {
    const bool is_turned = of.turns && kind != CoreKind::point;
    const Mat<D> axes = !is_turned    ? Mat<D>(1.0)
                        : placed.axes ? *placed.axes
                                      : matrix(placed.orientation);
    return PlacedCore<D>{kind, center, axes, of.half, of.radius};
  };
  return std::visit(EachShape{
                        [&](const Sphere& s) { return core(CoreKind::point, core_of<D>(s)); },
                        [&](const AxisBox<D>& s) { return core(CoreKind::box, core_of<D>(s)); },
                        [&](const OrientedBox<D>& s) { return core(CoreKind::box, core_of<D>(s)); },
                        [&](const Capsule& s) { return core(CoreKind::segment, core_of<D>(s)); },
                        [&](const HalfSpace<D>& s) -> Placing<D> {
                          return Wall<D>{center, s.normal};
                        },
                    },
                    placed.shape);
}

// Calls f(corner, name) for each corner of a core; those that coincide, for want of thickness,
// once.
template <int D, class F>
void each_corner(const PlacedCore<D>& core, const F& f) {
  for (std::uint32_t signs = 0; signs < 1u << D; ++signs) {
    Vec<D> corner = core.half;
    bool again = false;
    for (int i = 0; i < D; ++i) {
      if ((signs >> i & 1u) != 0) continue;
      corner[i] = -corner[i];
      again |= core.half[i] <= 0;
    }
    if (!again) f(core.world(corner), signs);
  }
}

// The contact of two cores in one point. `a` and `b` are points of the cores.
template <int D>
Manifold<D> one_point(const Vec<D>& a, double radius_a, double radius_b, const Direction<D>& from_a,
                      std::uint32_t feature = 0) {
  Manifold<D> manifold;
  manifold.normal = from_a.unit;
  const double separation = from_a.length - radius_a - radius_b;
  manifold.add({a + from_a.unit * (radius_a + separation / 2), separation, feature});
  return manifold;
}

template <int D>
using Contact = std::optional<Manifold<D>>;

// By search. It does not look at the order of bodies: `collide` has sorted them.
template <int D>
Contact<D> touch_blocks(const PlacedCore<D>& a, const PlacedCore<D>& b, double margin,
                        NarrowTrace<D>& trace);  // any two but points

// The parts of the contact of two blocks: cores taken for boxes, capsules for boxes without
// thickness. First a direction along which they were measured.
template <int D>
struct SeparatingAxis {
  Vec<D> normal{0.0};                         // unit, from a to b
  double separation = 0;                      // of the cores along it; below 0 they overlap
  AxisAcross across = AxisAcross::face_of_a;  // never the closest points
  int axis_a = 0;                             // of a's face or edge
  int axis_b = 0;                             // of b's face or edge
};

template <int D>
struct SeparatingAxes {
  bool parted = false;         // one axis was enough; the others were not measured
  SeparatingAxis<D> chosen;    // the one to build the contact on
  SeparatingAxis<D> greatest;  // the one of the largest separation
  SeparatingAxis<D> face;      // the best of a face; its normal is 0 if neither block has any
};

inline constexpr double kAxisBias = 1e-3;

// Gottschalk, Lin, Manocha (OBBTree, 1996). If the largest separation is above 0, the cores are at
// least so far apart. If not, they overlap, and it is the least depth.
//
// Where two axes are nearly equal, as for boxes that lie flat on each other, rounding must not
// choose. So a later kind of axis must be better than an earlier one by kAxisBias of the smallest
// half size: faces of a, faces of b, edges, sides.
//
// It ends at the first axis along which the shapes, radii and all, are further apart than `margin`.
// Boxes that lie the same way have the same axes, which are measured once.
template <int D>
SeparatingAxes<D> separating_axes(const PlacedCore<D>& a, const PlacedCore<D>& b, double margin,
                                  NarrowTrace<D>& trace);

// The smallest half size of both that is not 0; 0 if all are.
template <int D>
double smallest_half(const PlacedCore<D>& a, const PlacedCore<D>& b);

// The point of each core that is closest to the other one, if they are apart, and a name of the
// features on which they lie. `axis` is one along which they are apart; the better it is, the less
// work is left.
template <int D>
struct ClosestFeatures {
  PointPair<D> points;
  std::uint32_t feature = 0;
};

template <int D>
ClosestFeatures<D> closest_features(const PlacedCore<D>& a, const PlacedCore<D>& b,
                                    const SeparatingAxis<D>& axis, NarrowTrace<D>& trace);

}  // namespace lantern::physics::narrow
