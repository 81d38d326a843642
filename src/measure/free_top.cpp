// Jacobi's solution (Whittaker, section 69; van Zon and Schofield, "Numerical implementation of the
// exact dynamics of free rigid bodies", Journal of Computational Physics 225, 2007). Axes 1, 2, 3
// are named so that L circles axis 3, and 2 is the middle one. With a = 1 / I:
//
//     L1 = A1 cn(u),  L2 = A2 sn(u),  L3 = A3 dn(u),   u = rate t + u0
//
// L stands still in the world and is the z axis there. Then tilt and spin are its polar angles in
// the body, and the precession about it is an elliptic integral of the third kind.
#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "base/error.hpp"
#include "measure/closed_forms.hpp"
#include "measure/elliptic.hpp"
#include "measure/precise.hpp"

namespace lantern {
namespace {

LongQuat about(const LongVec& axis, long double angle) {
  const long double s = std::sin(angle / 2);
  return {std::cos(angle / 2), axis.x * s, axis.y * s, axis.z * s};
}

LongQuat turned_by(const LongVec& vector) {
  const long double angle = glm::length(vector);
  return angle > 0 ? about(vector / angle, angle) : LongQuat(1, 0, 0, 0);
}

// The columns are the body's axes seen along those named 1, 2, 3: a turn, so that one is flipped if
// the order is left-handed.
LongQuat naming(const std::array<int, 3>& axis) {
  glm::mat<3, 3, long double> m(0.0L);
  const bool right_handed = (axis[1] - axis[0] + 3) % 3 == 1;
  for (int i = 0; i < 3; ++i) m[axis[i]][i] = i == 0 && !right_handed ? -1 : 1;
  return glm::quat_cast(m);
}

}  // namespace

FreeTop::FreeTop(const LongVec& inverse_inertia, const LongQuat& orientation,
                 const LongVec& momentum)
    : start_(orientation), momentum_(momentum), spin_(momentum * inverse_inertia) {
  fixed_ = glm::cross(momentum, spin_) == LongVec(0.0L);
  if (fixed_) return;
  std::array<int, 3> axis{0, 1, 2};
  std::stable_sort(axis.begin(), axis.end(),
                   [&](int i, int j) { return inverse_inertia[i] < inverse_inertia[j]; });
  // 2T - L^2 a2 tells which of the outer axes L circles.
  const auto part = [&](int i) {
    return (inverse_inertia[axis[i]] - inverse_inertia[axis[1]]) * momentum[axis[i]] *
           momentum[axis[i]];
  };
  const long double side = part(0) + part(2);
  if (side == 0) throw Refused("the body is on the boundary between two ways of tumbling");
  if (side < 0) std::swap(axis[0], axis[2]);
  const LongVec a(inverse_inertia[axis[0]], inverse_inertia[axis[1]], inverse_inertia[axis[2]]);
  const long double d31 = a[2] - a[0], d32 = a[2] - a[1], d21 = a[1] - a[0];
  names_ = naming(axis);
  const LongVec l = names_ * momentum;
  length_ = glm::length(l);
  inverse1_ = a[0];
  size_[0] = std::sqrt(l[0] * l[0] + l[1] * l[1] * (d32 / d31));
  size_[2] = std::copysign(std::sqrt(l[2] * l[2] + l[1] * l[1] * (d21 / d31)), l[2]);
  // L1' = L2 L3 (a3 - a2) tells which way L goes round.
  size_[1] = size_[0] * std::sqrt(d31 / d32) * (d32 * size_[2] > 0 ? -1 : 1);
  rate_ = std::abs(size_[2]) * std::sqrt(d32 * d31);
  m1_ = std::min(1.0L, side / (d32 * size_[2] * size_[2]));
  n_ = -d21 / d32;
  wobble_ = d31 * d21 / d32;
  half_period_ = 2 * quarter_period(m1_);
  half_integral_ = 2 * integral(half_period_ / 2);
  u0_ = argument_of({l[1] / size_[1], l[0] / size_[0], l[2] / size_[2]}, m1_);
  const Phase start = phase(0);
  integral0_ = start.half_turns * half_integral_ + integral(start.rest);
  base_ = orientation * glm::conjugate(names_) * glm::conjugate(to_momentum_frame(l, 0));
}

FreeTop::Phase FreeTop::phase(long double time) const {
  const Precise way = product(rate_, time);
  const long double half_turns = std::round((way.high + u0_) / half_period_);
  return {half_turns, std::fma(-half_turns, half_period_, way.high) + (way.low + u0_)};
}

LongVec FreeTop::named(long double time) const {
  const auto [half_turns, rest] = phase(time);
  const Jacobi f = jacobi(rest, m1_);
  const long double sign = std::fmod(half_turns, 2.0L) == 0 ? 1 : -1;
  return {sign * size_[0] * f.cn, sign * size_[1] * f.sn, size_[2] * f.dn};
}

// The integral of sn^2 / (1 - n sn^2) up to there.
long double FreeTop::integral(long double rest) const {
  const auto [s, c, d] = jacobi(rest, m1_);
  return s * s * s / 3 * carlson_rj(c * c, d * d, 1, 1 - n_ * s * s);
}

// precession' = |L| (a1 L1^2 + a2 L2^2) / (L1^2 + L2^2)
long double FreeTop::precession(long double time) const {
  const auto [half_turns, rest] = phase(time);
  const long double grown = half_turns * half_integral_ + integral(rest) - integral0_;
  return length_ * (inverse1_ * time + wobble_ / rate_ * grown);
}

LongQuat FreeTop::to_momentum_frame(const LongVec& l, long double precession) const {
  const LongVec x(1, 0, 0), z(0, 0, 1);
  return about(z, precession) * about(x, std::atan2(std::hypot(l.x, l.y), l.z)) *
         about(z, std::atan2(l.x, l.y));
}

LongQuat FreeTop::orientation(long double time) const {
  if (fixed_) return start_ * turned_by(spin_ * time);
  const LongQuat now = to_momentum_frame(named(time), precession(time));
  return base_ * now * names_;
}

LongVec FreeTop::momentum(long double time) const {
  return fixed_ ? momentum_ : glm::conjugate(names_) * named(time);
}

}  // namespace lantern
