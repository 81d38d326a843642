#include "geometry/ray.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "geometry/not_finite.hpp"

namespace lantern::geometry {
namespace {

// Where, on the whole line, |m + t * d| <= r: between the roots of a t^2 + 2 b t + c, of which the
// one that would cancel is found from the other. The discriminant is measured from the line's
// nearest point, so that it keeps its digits far away (Haines et al., "Precision Improvements for
// Ray/Sphere Intersection", Ray Tracing Gems, 2019).
template <int D>
std::optional<RaySpan> span_in_ball(const Vec<D>& m, const Vec<D>& d, double r) {
  const double a = glm::dot(d, d), b = glm::dot(m, d), c = glm::dot(m, m) - r * r;
  if (a == 0) return c <= 0 ? std::optional(RaySpan{-kInfinity, kInfinity}) : std::nullopt;
  const Vec<D> nearest = m - d * (b / a);
  const double inside = r * r - glm::dot(nearest, nearest);
  if (inside < 0) return std::nullopt;
  const double root = std::sqrt(a * inside);
  const double q = b > 0 ? -b - root : -b + root;
  if (q == 0) return RaySpan{0, 0};
  return b > 0 ? RaySpan{q / a, c / q} : RaySpan{c / q, q / a};
}

std::optional<RaySpan> common(const RaySpan& a, const std::optional<RaySpan>& b) {
  if (!b) return std::nullopt;
  const RaySpan both{std::max(a.from, b->from), std::min(a.to, b->to)};
  return both.from <= both.to ? std::optional(both) : std::nullopt;
}

// The ray as the turned body sees it.
template <int D>
Ray<D> seen_from(const Ray<D>& ray, const Vec<D>& position, const Rotation<D>& orientation) {
  const Mat<D> back = glm::transpose(matrix(orientation));
  return {back * (ray.origin - position), back * ray.direction, ray.length};
}

// A ball at each end of the segment, and between them what is nearer than the radius to the y axis.
template <int D>
std::optional<double> entry_of_capsule(const Ray<D>& ray, const Capsule& capsule) {
  std::optional<double> first;
  const auto meet = [&](const std::optional<RaySpan>& span) {
    if (span && (!first || span->from < *first)) first = span->from;
  };
  for (const double y : {-capsule.half_length, capsule.half_length}) {
    Vec<D> m = ray.origin;
    m.y -= y;
    meet(common({0, ray.length}, span_in_ball<D>(m, ray.direction, capsule.radius)));
  }
  Box<D> slab{Vec<D>(-kInfinity), Vec<D>(kInfinity)};
  slab.lo.y = -capsule.half_length;
  slab.hi.y = capsule.half_length;
  Vec<D> m = ray.origin, d = ray.direction;
  m.y = d.y = 0;
  if (const auto span = span_in(ray, slab))
    meet(common(*span, span_in_ball<D>(m, d, capsule.radius)));
  return first;
}

template <int D>
std::optional<double> entry_of_half_space(const Ray<D>& ray, const Vec<D>& normal,
                                          const Vec<D>& position) {
  const double h = glm::dot(normal, ray.origin - position);
  if (h <= 0) return 0;
  const double rate = glm::dot(normal, ray.direction);
  if (rate >= 0) return std::nullopt;
  const double t = -h / rate;
  return t <= ray.length ? std::optional(t) : std::nullopt;
}

}  // namespace

template <int D>
void require_valid(const Ray<D>& ray) {
  require_finite(ray.origin, "ray", "origin");
  require_finite(ray.direction, "ray", "direction");
  if (ray.direction == Vec<D>(0.0)) throw Refused("ray: direction has no length");
  if (!(ray.length >= 0))
    throw Refused(fmt::format("ray: length is {}, must not be negative", ray.length));
}

template <int D>
std::optional<double> entry(const Ray<D>& ray, const Shape<D>& shape, const Vec<D>& position,
                            const Rotation<D>& orientation) {
  const auto from = [](const std::optional<RaySpan>& span) {
    return span ? std::optional(span->from) : std::nullopt;
  };
  const RaySpan all{0, ray.length};
  return std::visit(
      EachShape{
          [&](const Sphere& s) {
            return from(
                common(all, span_in_ball<D>(ray.origin - position, ray.direction, s.radius)));
          },
          [&](const AxisBox<D>& s) {
            return from(span_in(ray, Box<D>::around(position, s.half_size)));
          },
          [&](const OrientedBox<D>& s) {
            return from(span_in(seen_from(ray, position, orientation),
                                Box<D>::around(Vec<D>(0.0), s.half_size)));
          },
          [&](const Capsule& s) {
            return entry_of_capsule(seen_from(ray, position, orientation), s);
          },
          [&](const HalfSpace<D>& s) { return entry_of_half_space(ray, s.normal, position); },
      },
      shape);
}

template void require_valid(const Ray<2>&);
template void require_valid(const Ray<3>&);
template std::optional<double> entry(const Ray<2>&, const Shape<2>&, const Vec<2>&,
                                     const Rotation<2>&);
template std::optional<double> entry(const Ray<3>&, const Shape<3>&, const Vec<3>&,
                                     const Rotation<3>&);

}  // namespace lantern::geometry
