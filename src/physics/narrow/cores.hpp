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

// Half sizes of 0 make a box of the core a rectangle, a segment or a point. `place` sets it.
template <int D>
struct PlacedCore : Core<D> {
  using Core<D>::half;
  CoreKind kind = CoreKind::box;
  Vec<D> center;
  Mat<D> axes;  // columns: unit vectors

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

// A shape's core at `center`, wherever it was placed. False if it has none: a half-space is there.
template <int D>
inline bool place(const Placed<D>& placed, const Vec<D>& center, PlacedCore<D>& core) {
  core.center = center;
  core.kind = std::holds_alternative<Sphere>(placed.shape)    ? CoreKind::point
              : std::holds_alternative<Capsule>(placed.shape) ? CoreKind::segment
                                                              : CoreKind::box;
  const auto set = [&](const Core<D>& of) { return static_cast<Core<D>&>(core) = of, true; };
  if (!visit_shape<D>(placed.shape, set, [](const HalfSpace<D>&) { return false; })) return false;
  const bool turns = core.turns && core.kind != CoreKind::point;
  core.axes = !turns ? Mat<D>(1.0) : placed.axes ? *placed.axes : matrix(placed.orientation);
  return true;
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

template <int D>
using Contact = std::optional<Manifold<D>>;

// The contact of two cores in one point. `a` and `b` are points of the cores.
template <int D>
inline Contact<D> one_point(const Vec<D>& a, double radius_a, double radius_b,
                            const Direction<D>& from_a, std::uint32_t feature = 0) {
  Contact<D> contact(std::in_place);
  contact->normal = from_a.unit;
  const double separation = from_a.length - radius_a - radius_b;
  contact->add({a + from_a.unit * (radius_a + separation / 2), separation, feature});
  return contact;
}

// By search. It does not look at the order of bodies: `collide` has sorted them.
template <int D>
Contact<D> touch_blocks(const PlacedCore<D>& a, const PlacedCore<D>& b, double margin,
                        NarrowTrace<D>& trace);  // any two but points

}  // namespace lantern::physics::narrow
