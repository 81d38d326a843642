// Directed segments in the plane, and the lines that they lie on.
//
//        left: in front of the line
//     a ---------------> b
//        right: behind it
#pragma once

#include "geometry/plane.hpp"

namespace lantern {

struct Segment {
  Vec<2> a{0.0};
  Vec<2> b{0.0};

  Vec<2> middle() const { return a + (b - a) * 0.5; }
  bool operator==(const Segment&) const = default;
};

inline double length(const Segment& s) {
  const Vec<2> along = s.b - s.a;
  return std::sqrt(along.x * along.x + along.y * along.y);
}

// The line through a segment that is not a point: its normal has unit length and points left.
inline Plane<2> line_of(const Segment& s) {
  const Vec<2> along = (s.b - s.a) / length(s);
  return Plane<2>::through(s.a, {-along.y, along.x});
}

// How far the point lies in front of the plane, in lengths of its normal; negative behind it.
template <int D>
double height_over(const Plane<D>& plane, const Vec<D>& point) {
  double sum = 0;
  for (int i = 0; i < D; ++i) sum += plane.normal[i] * point[i];
  return sum - plane.offset;
}

}  // namespace lantern
