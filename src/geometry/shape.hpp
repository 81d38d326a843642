// The collision volumes of bodies, and the boxes that envelop them in the broad phase.
#pragma once

#include <variant>

#include "geometry/box.hpp"
#include "geometry/rotation.hpp"

namespace lantern {

// A disc in 2D, a ball in 3D.
struct Sphere {
  double radius = 0;
};

// An axis-aligned box around the body's position. It never turns.
template <int D>
struct AxisBox {
  Vec<D> half_size{0.0};
};

// A box that turns with its body.
template <int D>
struct OrientedBox {
  Vec<D> half_size{0.0};
};

// All points within `radius` of a segment along the body's own y axis, from -half_length to
// +half_length.
struct Capsule {
  double radius = 0;
  double half_length = 0;
};

// All points on the far side of a plane through the body's position. `normal` has unit length,
// points out of the solid and does not turn with the body.
template <int D>
struct HalfSpace {
  Vec<D> normal{0.0};
};

template <int D>
using Shape = std::variant<Sphere, AxisBox<D>, OrientedBox<D>, Capsule, HalfSpace<D>>;

// A half-space reaches this far: boxes must be finite.
inline constexpr double kEndless = 1e150;

// The broad-phase box by the lecture's formulas: a sphere's half sizes are its radius on each axis,
// an axis-aligned box is its own, a turned box has |R| * half sizes, where |R| holds the absolute
// values of the rotation matrix.
template <int D>
Box<D> bounding_box(const Shape<D>& shape, const Vec<D>& position,
                    const Rotation<D>& orientation = {});

extern template Box<2> bounding_box(const Shape<2>&, const Vec<2>&, const Rotation<2>&);
extern template Box<3> bounding_box(const Shape<3>&, const Vec<3>&, const Rotation<3>&);

}  // namespace lantern
