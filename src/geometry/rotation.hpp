// How a body is turned: an angle in 2D, a unit quaternion in 3D.
#pragma once

#include <cmath>
#include <type_traits>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>

#include "geometry/elementary.hpp"
#include "geometry/vec.hpp"

namespace lantern::geometry {

template <int D>
using Mat = glm::mat<D, D, double>;

// What turns: an angle, angular velocity, angular momentum or torque. One number in 2D
// (counter-clockwise), a vector along the axis in 3D.
template <int D>
using Spin = std::conditional_t<D == 2, double, Vec<3>>;

template <int D>
struct Rotation;

template <>
struct Rotation<2> {
  double angle = 0;  // radians, counter-clockwise; may pass a full turn
};

template <>
struct Rotation<3> {
  glm::dquat q{1, 0, 0, 0};  // w, x, y, z; of unit length
};

// The unit vector at an angle from the x axis, counter-clockwise.
inline Vec<2> unit_at(double angle) {
  const auto [s, c] = sin_cos(angle);
  return {c, s};
}

// Columns are the body's axes in the world: matrix(r) * local = world.
inline Mat<2> matrix(const Rotation<2>& r) {
  const auto [s, c] = sin_cos(r.angle);
  return {Vec<2>(c, s), Vec<2>(-s, c)};
}
inline Mat<3> matrix(const Rotation<3>& r) { return glm::mat3_cast(r.q); }

// Turned further about the world's axes by the rotation vector `by`, in radians.
inline Rotation<2> turned(const Rotation<2>& r, double by) { return {r.angle + by}; }
inline Rotation<3> turned(const Rotation<3>& r, const Vec<3>& by) {
  const double angle = glm::length(by);
  // sin(x/2)/x near 0 is 1/2, which needs no division.
  const auto [s, c] = sin_cos(angle / 2);
  const double k = angle > 1e-9 ? s / angle : 0.5;
  return {glm::normalize(glm::dquat(c, by * k) * r.q)};
}

// By which `from` must be turned to be `to`: in 3D at most half a turn.
inline double turn_between(const Rotation<2>& from, const Rotation<2>& to) {
  return to.angle - from.angle;
}
inline Vec<3> turn_between(const Rotation<3>& from, const Rotation<3>& to) {
  const glm::dquat q = to.q * glm::conjugate(from.q);
  const Vec<3> v = (q.w < 0 ? -1.0 : 1.0) * Vec<3>(q.x, q.y, q.z);
  const double size = glm::length(v);
  return v * (size > 1e-9 ? 2 * atan2(size, std::abs(q.w)) / size : 2.0);
}

// Of axis `axis`; in 2D there is one.
inline const double& spin_component(const double& spin, int) { return spin; }
inline double& spin_component(double& spin, int) { return spin; }
inline const double& spin_component(const Vec<3>& spin, int axis) { return spin[axis]; }
inline double& spin_component(Vec<3>& spin, int axis) { return spin[axis]; }
template <int D>
Spin<D> unit_spin(int axis) {
  if constexpr (D == 2) {
    return 1.0;
  } else {
    Spin<D> spin(0.0);
    spin[axis] = 1;
    return spin;
  }
}

inline double dot(double a, double b) { return a * b; }
inline double dot(const Vec<3>& a, const Vec<3>& b) { return glm::dot(a, b); }

// The lever's cross product, in either dimension: torque = cross(arm, force).
inline double cross(const Vec<2>& a, const Vec<2>& b) { return a.x * b.y - a.y * b.x; }
inline Vec<3> cross(const Vec<3>& a, const Vec<3>& b) { return glm::cross(a, b); }
// The velocity of a point at `arm` from the centre of a body that turns: spin x arm.
inline Vec<2> cross(double spin, const Vec<2>& arm) { return {-spin * arm.y, spin * arm.x}; }

}  // namespace lantern::geometry
