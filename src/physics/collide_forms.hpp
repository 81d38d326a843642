// The five shapes as the narrow phase sees them: four forms, placed relative to the first body.
//
// Every form but the half-space is all that lies within a radius of a core, which is a point, a
// segment or a box. Two such forms are apart by the distance of their cores less both radii.
#pragma once

#include "geometry/closest.hpp"
#include "geometry/shape.hpp"
#include "physics/manifold.hpp"

namespace lantern::narrow {

// A computed length is trusted to this part of the sizes that went into it: about 4500 roundings.
inline constexpr double kRounding = 1e-12;

// The normal of two cores that meet in a point.
template <int D>
Vec<D> fallback_normal() {
  Vec<D> up{0.0};
  up.y = 1;
  return up;
}

template <int D>
struct Ball {
  Vec<D> center{0.0};
  double radius = 0;
};

// A box of either kind; an axis-aligned one is not turned. Half sizes of 0 make it a rectangle, a
// segment or a point.
template <int D>
struct Block {
  Vec<D> center{0.0};
  Mat<D> axes{1.0};  // columns: unit vectors
  Vec<D> half{0.0};
  double radius = 0;  // of the rounding, 0 for a box

  // How far the core reaches from its centre along a unit vector.
  double reach(const Vec<D>& n) const {
    double sum = 0;
    for (int i = 0; i < D; ++i) sum += half[i] * std::abs(glm::dot(n, axes[i]));
    return sum;
  }
  // Coordinates along the axes from the centre, and back.
  Vec<D> local(const Vec<D>& point) const {
    Vec<D> coordinates;
    for (int i = 0; i < D; ++i) coordinates[i] = glm::dot(point - center, axes[i]);
    return coordinates;
  }
  Vec<D> world(const Vec<D>& coordinates) const { return center + axes * coordinates; }
};

// A capsule.
template <int D>
struct Rod {
  Vec<D> center{0.0};
  Mat<D> axes{1.0};
  double half_length = 0;
  double radius = 0;

  Vec<D> along() const { return axes[1]; }
  Segment<D> segment() const {
    return {center - along() * half_length, center + along() * half_length};
  }
  Block<D> block() const {
    Vec<D> half{0.0};
    half.y = half_length;
    return {center, axes, half, radius};
  }
};

// A half-space.
template <int D>
struct Wall {
  Vec<D> point{0.0};
  Vec<D> normal{0.0};  // out of the solid
};

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

// One handler a pair of forms. None looks at the order of bodies: `collide` has sorted them.
template <int D>
Contact<D> touch(const Ball<D>& a, const Ball<D>& b, double margin);
template <int D>
Contact<D> touch(const Ball<D>& a, const Block<D>& b, double margin);
template <int D>
Contact<D> touch(const Ball<D>& a, const Rod<D>& b, double margin);
template <int D>
Contact<D> touch(const Ball<D>& a, const Wall<D>& b, double margin);
template <int D>
Contact<D> touch(const Block<D>& a, const Block<D>& b, double margin);
template <int D>
Contact<D> touch(const Block<D>& a, const Rod<D>& b, double margin);
template <int D>
Contact<D> touch(const Block<D>& a, const Wall<D>& b, double margin);
template <int D>
Contact<D> touch(const Rod<D>& a, const Rod<D>& b, double margin);
template <int D>
Contact<D> touch(const Rod<D>& a, const Wall<D>& b, double margin);

}  // namespace lantern::narrow
