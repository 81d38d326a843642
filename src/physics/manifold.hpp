// What the narrow phase says of two bodies that touch.
//
//        b                 normal: unit, from a to b
//    ____|____             separation: of the surfaces along the normal; below 0 they overlap
//   |    v    |            position: in the world, midway between the two surfaces
//   |  x   x  |  <- points
//   ‾‾‾‾‾‾‾‾‾‾‾   a
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/shape.hpp"

namespace lantern::physics {

template <int D>
struct ManifoldPoint {
  Vec<D> position{0.0};
  double separation = 0;
  std::uint32_t feature = 0;  // which corners, edges or faces meet: the same from step to step
};

template <int D>
struct Manifold {
  static constexpr int kMostPoints = D == 2 ? 2 : 4;
  Vec<D> normal{0.0};
  std::array<ManifoldPoint<D>, kMostPoints> room;
  int count = 0;  // 1 ... kMostPoints

  std::span<const ManifoldPoint<D>> points() const {
    return {room.data(), static_cast<std::size_t>(count)};
  }
  void add(const ManifoldPoint<D>& point) { room[static_cast<std::size_t>(count++)] = point; }

  double least_separation() const {
    double least = room[0].separation;
    for (const ManifoldPoint<D>& point : points()) least = std::min(least, point.separation);
    return least;
  }
  // Of the deepest point; 0 if the shapes do not overlap.
  double depth() const { return std::max(0.0, -least_separation()); }
};

// A shape where it stands.
template <int D>
struct Placed {
  const Shape<D>& shape;
  Vec<D> position{0.0};
  Rotation<D> orientation;
  std::optional<Mat<D>> axes = {};  // matrix(orientation), where it is known
};

// What the narrow phase measures of two shapes before it knows whether they touch: first a
// direction along which they were measured.
enum class AxisAcross : std::uint8_t {
  closest_points,  // from one shape to the other: no direction parts them further
  face_of_a,
  face_of_b,
  edges,  // of both, in 3D
  side,   // of a capsule or box without thickness, where it has no face
};
template <int D>
struct MeasuredAxis {
  using Across = AxisAcross;
  Vec<D> normal{0.0};     // unit, from a to b
  double separation = 0;  // of the surfaces along it; below 0 they overlap
  Across across = Across::closest_points;
};

template <int D>
struct NarrowTrace {
  // Lengths taken along a direction, each a product of two vectors: of two discs 1, of a disc and a
  // box 1 + D, of two boxes 1 + D for each axis.
  std::uint64_t lengths = 0;
  // Where somebody watches: each axis when it was measured, in this order.
  std::vector<MeasuredAxis<D>>* axes = nullptr;

  void note(const Vec<D>& normal, double separation, AxisAcross across) {
    if (axes) axes->push_back({normal, separation, across});
  }
};

// The contact of two shapes whose surfaces are no further apart than `margin`; touching counts, at
// margin 0. Two half-spaces have none. All inputs must be finite, sizes not negative (0 is
// allowed), a half-space's normal and quaternions of unit length.
//
// - The least separation of all points is the true one, in 2D and 3D, to about 1e-12 of the sizes:
//   of shapes that are apart their distance, of shapes that overlap the least depth by which they
//   can be parted. The normal is the direction to do so, to about 1e-9 radians; less if the cores
//   (centres, segments, boxes) are a distance below 1e-6 of the sizes apart.
// - Overlapping boxes may report up to 1e-3 of their smallest half size more depth than that: of
//   axes so nearly equal the first of a fixed order is taken, so that rounding does not choose.
// - Further points, up to `margin`, are where the faces in contact end. A capsule that lies along a
//   box or a capsule has two points.
// - Features keep their names under small motion; names of one manifold differ.
// - `collide(b, a)` is the same contact, bit for bit, but for the sign of the normal. Equal shapes
//   with a common centre have no order: they get the same fixed normal both ways.
// - Positions are subtracted first: far from the origin nothing is lost but their own rounding.
//
// `trace` is added to. Boxes, and a box and a capsule, are measured along one axis after another,
// until one of them parts them by more than the margin.
template <int D>
std::optional<Manifold<D>> collide(const Placed<D>& a, const Placed<D>& b, double margin,
                                   NarrowTrace<D>& trace);
template <int D>
std::optional<Manifold<D>> collide(const Placed<D>& a, const Placed<D>& b, double margin) {
  NarrowTrace<D> nobody;
  return collide(a, b, margin, nobody);
}

}  // namespace lantern::physics
