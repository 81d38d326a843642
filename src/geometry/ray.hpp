// Rays, and where they meet boxes and shapes.
#pragma once

#include <limits>
#include <optional>

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

}  // namespace lantern::geometry
