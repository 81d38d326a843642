// The collision volumes of bodies, and the boxes that envelop them in the broad phase.
#pragma once

#include <algorithm>
#include <variant>

#include "geometry/box.hpp"
#include "geometry/rotation.hpp"

namespace lantern::geometry {

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

// Every shape but the half-space is all that lies within `radius` of its core: a point, a segment
// or a box, which is a box of half sizes 0, of one that is not 0, or of all.
template <int D>
struct Core {
  Vec<D> half{0.0};  // along the body's own axes, or the world's if it does not turn
  double radius = 0;
  bool turns = true;  // with its body

  double thickness() const {  // half of its smallest width
    double least = half[0];
    for (int i = 1; i < D; ++i) least = std::min(least, half[i]);
    return least + radius;
  }
};

// One function for each shape: std::visit(EachShape{...}, shape) does not compile if one is
// forgotten.
template <class... F>
struct EachShape : F... {
  using F::operator()...;
};
template <class... F>
EachShape(F...) -> EachShape<F...>;

template <int D>
Core<D> core_of(const Sphere& s) {
  return {Vec<D>(0.0), s.radius, true};
}
template <int D>
Core<D> core_of(const AxisBox<D>& s) {
  return {s.half_size, 0, false};
}
template <int D>
Core<D> core_of(const OrientedBox<D>& s) {
  return {s.half_size, 0, true};
}
template <int D>
Core<D> core_of(const Capsule& s) {
  Vec<D> half{0.0};
  half.y = s.half_length;
  return {half, s.radius, true};
}

// f(core), or g(half_space).
template <int D, class F, class G>
auto visit_shape(const Shape<D>& shape, F&& f, G&& g) {
  return std::visit(EachShape{[&](const auto& s) { return f(core_of<D>(s)); },
                              [&](const HalfSpace<D>& s) { return g(s); }},
                    shape);
}

// Whether it turns with its body. An axis-aligned box and a half-space never do.
template <int D>
bool turns(const Shape<D>& shape) {
  return visit_shape<D>(
      shape, [](const Core<D>& core) { return core.turns; },
      [](const HalfSpace<D>&) { return false; });
}

// A half-space reaches this far: boxes must be finite.
inline constexpr double kEndless = 1e150;

// The broad-phase box by the lecture's formulas: a sphere's half sizes are its radius on each axis,
// an axis-aligned box is its own, a turned box has |R| * half sizes, where |R| holds the absolute
// values of the rotation matrix.
template <int D>
Box<D> bounding_box(const Shape<D>& shape, const Vec<D>& position,
                    const Rotation<D>& orientation = {});
// The same by its axes (columns), which are those of the world if it does not turn.
template <int D>
Box<D> bounding_box(const Shape<D>& shape, const Vec<D>& position, const Mat<D>& axes);

// How far the surface of a body can be from its centre, as far as turning moves it: how fast it can
// move because the body turns, per radian. 0 for what does not turn, and for spheres.
template <int D>
double turning_reach(const Shape<D>& shape);

// Half of the smallest width; endless for a half-space.
template <int D>
double thickness(const Shape<D>& shape);

}  // namespace lantern::geometry
