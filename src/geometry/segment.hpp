// Directed segments, and in the plane the lines that they lie on.
//
//        left: in front of the line
//     a ---------------> b
//        right: behind it
#pragma once

#include "geometry/plane.hpp"

namespace lantern::geometry {

// All points a + t (b - a) with t in [0, 1]; the ends may coincide.
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

}  // namespace lantern::geometry
