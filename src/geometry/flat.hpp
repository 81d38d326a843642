// Between the flat world of the engine and the three dimensions of scenarios and frames. A flat
// thing lies in the plane z = 0 and has no extent along z.
#pragma once

#include "geometry/plane.hpp"
#include "geometry/shape.hpp"

namespace lantern::geometry {

inline Vec<2> flat(const Vec<3>& v) { return {v.x, v.y}; }
inline Box<2> flat(const Box<3>& box) { return {flat(box.lo), flat(box.hi)}; }
inline Plane<2> flat(const Plane<3>& plane) { return {flat(plane.normal), plane.offset}; }

inline Vec<3> solid(const Vec<2>& v) { return {v.x, v.y, 0}; }
inline Vec<3> solid(const Vec<3>& v) { return v; }
inline Box<3> solid(const Box<2>& box) { return {solid(box.lo), solid(box.hi)}; }
inline Box<3> solid(const Box<3>& box) { return box; }
inline Plane<3> solid(const Plane<2>& plane) { return {solid(plane.normal), plane.offset}; }
inline Plane<3> solid(const Plane<3>& plane) { return plane; }

// The first D coordinates.
template <int D>
Vec<D> in_dimension(const Vec<3>& v) {
  if constexpr (D == 2)
    return flat(v);
  else
    return v;
}

template <int D>
Box<D> in_dimension(const Box<3>& box) {
  return {in_dimension<D>(box.lo), in_dimension<D>(box.hi)};
}

// The same shape in another dimension: half sizes and normals lose z, or get 0 there.
template <int To, int From>
Shape<To> in_dimension(const Shape<From>& shape) {
  const auto vec = [](const Vec<From>& v) { return in_dimension<To>(solid(v)); };
  return std::visit(
      EachShape{
          [&](const AxisBox<From>& s) -> Shape<To> { return AxisBox<To>{vec(s.half_size)}; },
          [&](const OrientedBox<From>& s) -> Shape<To> {
            return OrientedBox<To>{vec(s.half_size)};
          },
          [&](const HalfSpace<From>& s) -> Shape<To> { return HalfSpace<To>{vec(s.normal)}; },
          [](const auto& s) -> Shape<To> { return s; },
      },
      shape);
}

// Half of its smallest width in a world of so many dimensions.
inline double thickness(const Shape<3>& shape, int dimension) {
  return dimension == 2 ? thickness<2>(in_dimension<2>(shape)) : thickness<3>(shape);
}

}  // namespace lantern::geometry
