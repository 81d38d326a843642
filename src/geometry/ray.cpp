#include "geometry/ray.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "base/error.hpp"
#include "geometry/elementary.hpp"
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

void require_view(double angle, double near, double far) {
  if (!(angle > 0 && angle < std::numbers::pi))
    throw Refused("view: the opening angle is {}, must lie between 0 and pi", angle);
  if (!(near >= 0) || !(near < far) || !std::isfinite(far))
    throw Refused(
        "view: near is {}, far is {}; must be finite, near not negative and less than far", near,
        far);
}

template <int D>
Vec<D> direction(const Vec<D>& v, const char* field) {
  require_finite(v, "view", field);
  const double length = glm::length(v);
  if (!(length > 0) || !std::isfinite(length)) throw Refused("view: {} has no length", field);
  return v / length;
}

// `tangents` of half the opening angle towards each axis across.
template <int D>
Frustum<D> frustum_of(const Vec<D>& eye, const std::array<Vec<D>, D>& axes,
                      const std::array<double, D - 1>& tangents, double near, double far) {
  Frustum<D> f;
  f.axes = axes;
  f.planes[0] = Plane<D>::through(eye + axes[0] * near, axes[0]);
  f.planes[1] = Plane<D>::through(eye + axes[0] * far, -axes[0]);
  for (std::size_t k = 1; k < D; ++k)
    for (std::size_t side = 0; side < 2; ++side) {
      const Vec<D> outward = side == 0 ? axes[k] : -axes[k];
      // (tan, -1) along (forward, outward), scaled to unit length
      const double t = tangents[k - 1], scale = 1 / std::sqrt(1 + t * t);
      f.planes[2 * k + side] = Plane<D>::through(eye, (axes[0] * t - outward) * scale);
    }
  for (std::size_t corner = 0; corner < f.corners.size(); ++corner) {
    const double depth = (corner & 1u) != 0 ? far : near;
    f.corners[corner] = eye + axes[0] * depth;
    for (std::size_t k = 1; k < D; ++k)
      f.corners[corner] +=
          axes[k] * (depth * tangents[k - 1] * ((corner >> k & 1u) != 0 ? 1.0 : -1.0));
  }
  return f;
}

struct Extent {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
};

template <int D>
Extent extent(const Frustum<D>& frustum, const Vec<D>& axis) {
  Extent e;
  for (const Vec<D>& corner : frustum.corners) {
    const double x = glm::dot(axis, corner);
    e.least = std::min(e.least, x);
    e.most = std::max(e.most, x);
  }
  return e;
}

template <int D>
Box<D> box_around(const Frustum<D>& frustum) {
  Box<D> box{frustum.corners[0], frustum.corners[0]};
  for (const Vec<D>& corner : frustum.corners) box = united(box, {corner, corner});
  return box;
}

template <int D>
Extent extent(const Box<D>& box, const Vec<D>& axis) {
  Extent e{0, 0};
  for (int i = 0; i < D; ++i) {
    const double a = axis[i] * box.lo[i], b = axis[i] * box.hi[i];
    e.least += std::min(a, b);
    e.most += std::max(a, b);
  }
  return e;
}

template <int D>
bool parts(const Vec<D>& axis, const Frustum<D>& frustum, const Box<D>& box) {
  const Extent a = extent<D>(frustum, axis), b = extent<D>(box, axis);
  return a.most < b.least || b.most < a.least;
}

// In 3D also the cross products of the frustum's edges with the box's.
bool crossed_edges_part(const Frustum<2>&, const Box<2>&) { return false; }
bool crossed_edges_part(const Frustum<3>& frustum, const Box<3>& box) {
  std::array<Vec<3>, 6> edges{frustum.axes[1], frustum.axes[2]};
  for (std::size_t i = 0; i < 4; ++i)
    edges[2 + i] = frustum.corners[2 * i + 1] - frustum.corners[2 * i];
  for (const Vec<3>& edge : edges)
    for (int i = 0; i < 3; ++i) {
      Vec<3> axis{0.0};
      axis[i] = 1;
      if (parts<3>(glm::cross(edge, axis), frustum, box)) return true;
    }
  return false;
}

}  // namespace

template <int D>
void require_valid(const Ray<D>& ray) {
  require_finite(ray.origin, "ray", "origin");
  require_finite(ray.direction, "ray", "direction");
  if (ray.direction == Vec<D>(0.0)) throw Refused("ray: direction has no length");
  if (!(ray.length >= 0)) throw Refused("ray: length is {}, must not be negative", ray.length);
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

Frustum<3> view_frustum(const Vec<3>& eye, const Vec<3>& target, const Vec<3>& up, double fov,
                        double aspect, double near, double far) {
  require_view(fov, near, far);
  require_finite(eye, "view", "eye");
  require_finite(target, "view", "target");
  if (!(aspect > 0) || !std::isfinite(aspect))
    throw Refused("view: aspect is {}, must be above 0", aspect);
  const Vec<3> forward = direction<3>(target - eye, "the way from eye to target");
  const Vec<3> right =
      direction<3>(glm::cross(forward, direction<3>(up, "up")), "up, seen from the eye,");
  const double tangent = tan(fov / 2);
  return frustum_of<3>(eye, {forward, right, glm::cross(right, forward)},
                       {tangent * aspect, tangent}, near, far);
}

Frustum<2> view_wedge(const Vec<2>& eye, const Vec<2>& toward, double opening, double near,
                      double far) {
  require_view(opening, near, far);
  require_finite(eye, "view", "eye");
  const Vec<2> forward = direction<2>(toward, "direction");
  return frustum_of<2>(eye, {forward, Vec<2>(forward.y, -forward.x)}, {tan(opening / 2)}, near,
                       far);
}

template <int D>
bool may_overlap(const Frustum<D>& frustum, const Box<D>& box) {
  constexpr double kError = 1024 * std::numeric_limits<double>::epsilon();
  const Box<D> around = box_around(frustum);
  double size = 0;  // of the numbers that are summed below
  for (int i = 0; i < D; ++i)
    size = std::max({size, std::abs(around.lo[i]), std::abs(around.hi[i])});
  // What lies outside the box around the frustum has no part in any overlap. Without it numbers
  // stay as small as the frustum's, however large the box is.
  const Box<D> part = common_part(box, around);
  for (int i = 0; i < D; ++i)
    if (part.lo[i] > part.hi[i] + kError * size) return false;
  for (const Plane<D>& plane : frustum.planes)
    if (extent<D>(part, plane.normal).most < plane.offset - kError * size) return false;
  return true;
}

template <int D>
bool overlap(const Frustum<D>& frustum, const Box<D>& box) {
  const Box<D> part = common_part(box, box_around(frustum));
  for (int i = 0; i < D; ++i)
    if (part.lo[i] > part.hi[i]) return false;
  for (const Plane<D>& plane : frustum.planes)
    if (parts<D>(plane.normal, frustum, part)) return false;
  return !crossed_edges_part(frustum, part);
}

template bool may_overlap(const Frustum<2>&, const Box<2>&);
template bool may_overlap(const Frustum<3>&, const Box<3>&);
template bool overlap(const Frustum<2>&, const Box<2>&);
template bool overlap(const Frustum<3>&, const Box<3>&);

}  // namespace lantern::geometry
