// Lengths and closest points, safe for every finite input: no size, zero included, divides by zero.
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/plane.hpp"

namespace lantern::geometry {

// A vector as a length and a unit direction.
template <int D>
struct Direction {
  Vec<D> unit{0.0};
  double length = 0;
};

// `fallback`, itself a unit vector, is the direction of a vector without length. Squares of very
// small or large numbers would underflow or overflow, so these are scaled first.
template <int D>
Direction<D> direction_of(const Vec<D>& v, const Vec<D>& fallback) {
  const double square = glm::dot(v, v);
  if (square > 1e-200 && square < 1e200) {
    const double length = std::sqrt(square);
    return {v / length, length};
  }
  double most = 0;
  for (int i = 0; i < D; ++i) most = std::max(most, std::abs(v[i]));
  if (most == 0) return {fallback, 0};
  const Vec<D> scaled = v / most;
  const double length = glm::length(scaled);
  return {scaled / length, length * most};
}

// The point of the segment that is closest to the other one.
template <int D>
Vec<D> closest_point(const Segment<D>& segment, const Vec<D>& point) {
  const Vec<D> along = segment.b - segment.a;
  const double square = glm::dot(along, along);
  if (square <= 0) return segment.at(0);
  return segment.at(std::clamp(glm::dot(point - segment.a, along) / square, 0.0, 1.0));
}

template <int D>
struct PointPair {
  Vec<D> a{0.0};
  Vec<D> b{0.0};

  double square() const { return glm::dot(b - a, b - a); }
};

// Where the endless lines of both segments come closest to each other, or as near to it as the
// segments reach. If the closest points of the segments lie inside both of them, it is those.
template <int D>
PointPair<D> crossing_points(const Segment<D>& a, const Segment<D>& b);

// The points, one of each segment, that are closest to each other. If several pairs are, as of
// parallel segments, one of them.
template <int D>
PointPair<D> closest_points(const Segment<D>& a, const Segment<D>& b);

}  // namespace lantern::geometry
