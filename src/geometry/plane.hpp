// Planes in 3D, lines in 2D: the dividers of a binary space partition; directed segments; and the
// convex polygons into which lines cut the plane.
#pragma once

#include <vector>

#include "geometry/box.hpp"

namespace lantern::geometry {

// The points x with normal . x = offset. In front is where normal . x > offset. The normal need not
// have unit length; it must be finite and not zero.
template <int D>
struct Plane {
  Vec<D> normal{0.0};
  double offset = 0;

  static Plane through(const Vec<D>& point, const Vec<D>& normal) {
    double offset = 0;
    for (int i = 0; i < D; ++i) offset += normal[i] * point[i];
    return {normal, offset};
  }
};

// The height of a point over the plane, in lengths of the normal.
template <int D>
double height(const Vec<D>& point, const Plane<D>& plane) {
  double h = 0;
  for (int i = 0; i < D; ++i) h += plane.normal[i] * point[i];
  return h - plane.offset;
}

// The same plane, its normal's largest part in [0.5, 1): then no product with a finite box is
// infinite. A scale by a power of two rounds nothing.
template <int D>
Plane<D> scaled(Plane<D> plane) {
  double largest = 0;
  for (int i = 0; i < D; ++i) largest = std::max(largest, std::abs(plane.normal[i]));
  int exponent = 0;
  std::frexp(largest, &exponent);
  for (int i = 0; i < D; ++i) plane.normal[i] = std::ldexp(plane.normal[i], -exponent);
  plane.offset = std::ldexp(plane.offset, -exponent);
  return plane;
}

// Which half-spaces a box reaches. A box that touches the plane reaches both.
struct Reach {
  bool back = false;
  bool front = false;
};

// Exact for axis-aligned normals; otherwise as good as D rounded products and sums.
template <int D>
Reach reach(const Box<D>& box, const Plane<D>& plane) {
  double least = 0, most = 0;  // of normal . x over the box
  for (int i = 0; i < D; ++i) {
    const double a = plane.normal[i] * box.lo[i];
    const double b = plane.normal[i] * box.hi[i];
    least += std::min(a, b);
    most += std::max(a, b);
  }
  return {least <= plane.offset, most >= plane.offset};
}

// All points a + t (b - a) with t in [0, 1]; the ends may coincide.
//
//        left: in front of the line
//     a ---------------> b
//        right: behind it
template <int D>
struct Segment {
  Vec<D> a{0.0};
  Vec<D> b{0.0};

  Vec<D> at(double t) const { return a + (b - a) * t; }  // t from 0 to 1
  Vec<D> middle() const { return at(0.5); }
  bool operator==(const Segment&) const = default;
};

template <int D>
double length(const Segment<D>& s) {
  return glm::length(s.b - s.a);
}

// The line through a segment that is not a point: its normal has unit length and points left.
inline Plane<2> line_of(const Segment<2>& s) {
  const Vec<2> along = (s.b - s.a) / length(s);
  return Plane<2>::through(s.a, {-along.y, along.x});
}

// Corners in counter-clockwise order; fewer than three corners mean an empty region.
using Polygon = std::vector<Vec<2>>;

// The corners of a box, from its lower left.
inline Polygon polygon_of(const Box<2>& box) {
  return {box.lo, {box.hi.x, box.lo.y}, box.hi, {box.lo.x, box.hi.y}};
}

// What holds the points; inverted if there are none.
inline Box<2> box_of(const std::vector<Vec<2>>& points) {
  Box<2> box{Vec<2>(1e300), Vec<2>(-1e300)};
  for (const Vec<2>& p : points) box = united(box, Box<2>{p, p});
  return box;
}

// The part of a convex polygon on one side of a line (Sutherland and Hodgman 1974).
inline Polygon clipped(const Polygon& polygon, const Plane<2>& line, bool keep_front) {
  const auto height_within = [&](const Vec<2>& p) {
    return keep_front ? height(p, line) : -height(p, line);
  };
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec<2>& from = polygon[i];
    const Vec<2>& to = polygon[(i + 1) % polygon.size()];
    const double a = height_within(from);
    const double b = height_within(to);
    if (a >= 0) kept.push_back(from);
    if ((a > 0 && b < 0) || (a < 0 && b > 0)) kept.push_back(from + (to - from) * (a / (a - b)));
  }
  if (kept.size() < 3) kept.clear();
  return kept;
}

}  // namespace lantern::geometry
