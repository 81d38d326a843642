// Rays, and where they meet boxes and shapes; and what a camera sees.
#pragma once

#include <array>
#include <limits>
#include <optional>

#include "geometry/plane.hpp"
#include "geometry/shape.hpp"

namespace lantern::geometry {

// The points origin + t * direction for 0 <= t <= length. `t` is a distance if the direction has
// unit length; it need not, but must be finite and not zero.
template <int D>
struct Ray {
  Vec<D> origin{0.0};
  Vec<D> direction{0.0};
  double length = std::numeric_limits<double>::infinity();

  Vec<D> at(double t) const { return origin + direction * t; }
};

// Throws Refused, naming the field, for an origin or direction that is not finite, a direction of
// zero and a length that is negative or no number.
template <int D>
void require_valid(const Ray<D>& ray);

// The part of a ray, by t, that lies in something convex.
struct RaySpan {
  double from = 0;
  double to = 0;
};

// The slab method (Kay and Kajiya 1986): the box is the common part of D slabs, the ray lies in
// each of them over one span of t.
//
//        |  slab x  |           Quotients are rounded monotonically. So the span of a larger box is
//     ---+----------+---        never smaller, and whoever walks a tree with this test loses no
//        |   box  . | slab y    object that it finds without the tree.
//     ---+-----.----+---
//        |  .       |           Along an axis on which the ray stands still it lies in the slab
//      ray                      always or never. All is closed: a ray that touches the box meets
//      it.
//
// The bounds of the box may be infinite.
template <int D>
std::optional<RaySpan> span_in(const Ray<D>& ray, const Box<D>& box) {
  RaySpan span{0, ray.length};
  for (int i = 0; i < D; ++i) {
    const double o = ray.origin[i], d = ray.direction[i];
    if (d == 0) {
      if (o < box.lo[i] || box.hi[i] < o) return std::nullopt;
      continue;
    }
    const double low = (box.lo[i] - o) / d, high = (box.hi[i] - o) / d;
    span.from = std::max(span.from, d > 0 ? low : high);
    span.to = std::min(span.to, d > 0 ? high : low);
  }
  constexpr double kNever = std::numeric_limits<double>::infinity();
  if (span.from > span.to || span.from == kNever) return std::nullopt;
  return span;
}

// The least t at which the ray is in the solid shape, whose centre is `position`: 0 if it begins
// inside, nothing if it misses. Touching is meeting. Exact but for rounding.
template <int D>
std::optional<double> entry(const Ray<D>& ray, const Shape<D>& shape, const Vec<D>& position,
                            const Rotation<D>& orientation = {});

// What a camera sees: a truncated pyramid in 3D, a trapezoid in 2D.
//
//            far                 All planes look inward: inside is where normal . x >= offset.
//     \-------------/
//      \     |     /             plane 0 near, 1 far, then two for each axis across: the side
//       \    | ---/--> across    towards which the axis points, and the one opposite.
//        \---|---/  near
//         \  |  /                corner bits: bit 0 far; bit k the side towards which the k-th axis
//          \ | /                 across points (1: right, 2: up).
//           eye
template <int D>
struct Frustum {
  std::array<Plane<D>, 2 * D> planes;
  std::array<Vec<D>, (1u << D)> corners;
  std::array<Vec<D>, D> axes;  // unit length: forward, then across: right (and up)
};

// `fov` is the whole vertical angle in radians, in (0, pi); `aspect` is width / height; 0 <= near <
// far are distances along the view. Throws Refused, naming the field, for other values, for an eye
// at its target and for an up along the view.
Frustum<3> view_frustum(const Vec<3>& eye, const Vec<3>& target, const Vec<3>& up, double fov,
                        double aspect, double near, double far);

// `opening` is the whole angle in radians, in (0, pi). Throws Refused as above.
Frustum<2> view_wedge(const Vec<2>& eye, const Vec<2>& direction, double opening, double near,
                      double far);

// The usual plane test (Assarsson and Moller 2000): false only if the box lies wholly outside one
// of the planes by more than rounding could feign. Conservative: a box near a corner may pass
// although it is outside. The box may be infinite.
template <int D>
bool may_overlap(const Frustum<D>& frustum, const Box<D>& box);

// Exact but for rounding: no line separates them (separating axes of convex polytopes, Gottschalk
// 1996: the normals of both, and in 3D the cross products of their edges). Touching overlaps.
template <int D>
bool overlap(const Frustum<D>& frustum, const Box<D>& box);

}  // namespace lantern::geometry
