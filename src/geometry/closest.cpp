#include "geometry/closest.hpp"

#include "geometry/rotation.hpp"

namespace lantern::geometry {
namespace {

// Where on `a` the endless lines of both segments come closest, from 0 to 1; 0 if they are
// parallel.
//
// Ericson (Real-Time Collision Detection, 5.1.9) divides by |u|^2 |v|^2 - (u.v)^2, which cancels
// for nearly parallel lines. It is the square of u x v, and the product loses nothing.
template <int D>
double meeting_parameter(const Segment<D>& a, const Segment<D>& b) {
  const Vec<D> u = a.b - a.a, v = b.b - b.a, between = b.a - a.a;
  const auto normal = cross(u, v);
  double square = 0, share = 0;
  if constexpr (D == 2) {
    square = normal * normal;
    share = cross(between, v) * normal;
  } else {
    square = glm::dot(normal, normal);
    share = glm::dot(cross(between, v), normal);
  }
  return square > 0 ? std::clamp(share / square, 0.0, 1.0) : 0;
}

}  // namespace

template <int D>
PointPair<D> crossing_points(const Segment<D>& a, const Segment<D>& b) {
  const Vec<D> on_b = closest_point(b, a.at(meeting_parameter(a, b)));
  return {closest_point(a, on_b), on_b};
}

// Either an end of one segment is the closest to the other one, or the lines meet inside both.
// Every candidate is a pair of real points, so rounding can only pick one that is not quite the
// closest.
template <int D>
PointPair<D> closest_points(const Segment<D>& a, const Segment<D>& b) {
  const PointPair<D> candidates[] = {
      {a.a, closest_point(b, a.a)}, {a.b, closest_point(b, a.b)}, {closest_point(a, b.a), b.a},
      {closest_point(a, b.b), b.b}, crossing_points(a, b),
  };
  PointPair<D> best = candidates[0];
  for (const PointPair<D>& candidate : candidates)
    if (candidate.square() < best.square()) best = candidate;
  return best;
}

template PointPair<2> crossing_points(const Segment<2>&, const Segment<2>&);
template PointPair<3> crossing_points(const Segment<3>&, const Segment<3>&);
template PointPair<2> closest_points(const Segment<2>&, const Segment<2>&);
template PointPair<3> closest_points(const Segment<3>&, const Segment<3>&);

}  // namespace lantern::geometry
