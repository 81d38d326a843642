// What a camera sees: a truncated pyramid in 3D, a trapezoid in 2D.
#pragma once

#include <array>

#include "geometry/plane.hpp"

namespace lantern::geometry {

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
