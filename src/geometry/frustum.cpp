#include "geometry/frustum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "base/error.hpp"
#include "geometry/not_finite.hpp"

namespace lantern::geometry {
namespace {

void require_view(double angle, double near, double far) {
  if (!(angle > 0 && angle < std::numbers::pi))
    throw Refused(fmt::format("view: the opening angle is {}, must lie between 0 and pi", angle));
  if (!(near >= 0) || !(near < far) || !std::isfinite(far))
    throw Refused(fmt::format(
        "view: near is {}, far is {}; must be finite, near not negative and less than far", near,
        far));
}

template <int D>
Vec<D> direction(const Vec<D>& v, const char* field) {
  require_finite(v, "view", field);
  const double length = glm::length(v);
  if (!(length > 0) || !std::isfinite(length))
    throw Refused(fmt::format("view: {} has no length", field));
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

Frustum<3> view_frustum(const Vec<3>& eye, const Vec<3>& target, const Vec<3>& up, double fov,
                        double aspect, double near, double far) {
  require_view(fov, near, far);
  require_finite(eye, "view", "eye");
  require_finite(target, "view", "target");
  if (!(aspect > 0) || !std::isfinite(aspect))
    throw Refused(fmt::format("view: aspect is {}, must be above 0", aspect));
  const Vec<3> forward = direction<3>(target - eye, "the way from eye to target");
  const Vec<3> right =
      direction<3>(glm::cross(forward, direction<3>(up, "up")), "up, seen from the eye,");
  const double tangent = std::tan(fov / 2);
  return frustum_of<3>(eye, {forward, right, glm::cross(right, forward)},
                       {tangent * aspect, tangent}, near, far);
}

Frustum<2> view_wedge(const Vec<2>& eye, const Vec<2>& toward, double opening, double near,
                      double far) {
  require_view(opening, near, far);
  require_finite(eye, "view", "eye");
  const Vec<2> forward = direction<2>(toward, "direction");
  return frustum_of<2>(eye, {forward, Vec<2>(forward.y, -forward.x)}, {std::tan(opening / 2)}, near,
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
