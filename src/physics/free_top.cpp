// In the body's axes L, of constant length, runs along the curve on which the energy is constant,
// too. It circles that one of the two outer axes, here z, of which W below is not negative. With
// the excesses c of z and -a of the other outer axis x, and n = L / |L|, it is by Jacobi's
// functions
//
//   n = (A1 cn u, -A2 sn u, A3 dn u)        u = u0 + rate |L| t
//   W = c nz^2 - a nx^2                     a constant: what is left of the energy
//   1 - m = W (a + c) / (c (W + a))         0 on the boundary between circling z and circling x
//
// (Whittaker, "Analytical Dynamics", art. 69.) The shortest turn S(n) that brings n to z is smooth,
// for nz never changes its sign, so that Euler's angles, which are not, can be done without:
//
//   turn = S(n(0))^-1 * (turn about z by X) * S(n(h))
//   X' = |L| (c nz - a nx^2 / (1 + nz)) = |L| (c + W / nz) nz / (1 + nz)
//
// Its integral is an arc tangent and an elliptic integral of the third kind, of Carlson's kind R_J,
// with the parameter -a / c, which is not in the way of any pole. Whole half periods are counted.
//
// In long double, as the integrals are: a body that has turned by millions of radians is then still
// right to the last digits of its inertia.
#include "physics/free_top.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/elliptic.hpp"

namespace lantern::physics {
namespace {

using Long = long double;
using LongVec = glm::vec<3, Long>;
using LongQuat = glm::qua<Long>;

// On the boundary itself L takes for ever to turn over. So near it no rounding tells the
// difference.
constexpr Long kLeastComplement = 1e-30L;

// Which of the body's axes are x, y and z, and which of them are turned round: a right-handed
// frame, in which L is above the plane of x and y.
struct Naming {
  std::array<int, 3> axis{};
  LongVec sign{1.0L};

  LongVec named(const LongVec& v) const {
    return sign * LongVec(v[axis[0]], v[axis[1]], v[axis[2]]);
  }
  glm::dquat unnamed(const LongQuat& q) const {
    const LongVec v = sign * LongVec(q.x, q.y, q.z);
    Vec<3> out;
    for (int i = 0; i < 3; ++i) out[axis[static_cast<std::size_t>(i)]] = static_cast<double>(v[i]);
    return {static_cast<double>(q.w), out};
  }
};

Naming naming(const LongVec& n, const LongVec& excess) {
  int low = 0, high = 0;
  for (int i = 1; i < 3; ++i) {
    if (excess[i] < excess[low]) low = i;
    if (excess[i] >= excess[high]) high = i;
  }
  if (excess[low] * n[low] * n[low] + excess[high] * n[high] * n[high] < 0) std::swap(low, high);
  Naming names{{low, 3 - low - high, high}};
  if ((names.axis[1] - names.axis[0] + 3) % 3 == 2) names.sign.y = -1;
  if (n[high] < 0) {
    names.sign.y = -names.sign.y;
    names.sign.z = -1;
  }
  return names;
}

LongQuat turn_to_z(const LongVec& n) { return glm::normalize(LongQuat(1 + n.z, n.y, -n.x, 0)); }

// The curve that L runs along, in the named axes.
class Curve {
 public:
  Curve(const LongVec& n, Long a, Long c) : ratio_(std::sqrt(1 + a / c)), n_(a / c) {
    const Long wobble = (a + c) * n.x * n.x + c * n.y * n.y;
    const Long spin = (a + c) * n.z * n.z + a * n.y * n.y;
    size_ = {std::sqrt(wobble / (a + c)), std::sqrt(wobble / c), std::sqrt(spin / (a + c))};
    rate = std::sqrt(c * spin);
    const Long side = std::max(c * n.z * n.z - a * n.x * n.x, 0.0L);
    m1_ = std::clamp(side * (a + c) / (c * spin), kLeastComplement, 1.0L);
  }

  // Where n is: an argument within a quarter period of 0, or half a period further (`over`).
  Jacobi at(const LongVec& n, bool& over) const {
    Jacobi f{size_.y > 0 ? -n.y / size_.y : 0, size_.x > 0 ? n.x / size_.x : 1, 1};
    over = f.cn < 0;
    const Long length = std::hypot(f.sn, f.cn) * (over ? -1 : 1);
    f.sn /= length;
    f.cn /= length;
    f.dn = std::sqrt(f.cn * f.cn + m1_ * f.sn * f.sn);
    return f;
  }
  LongVec point(const Jacobi& f, bool over) const {
    const Long sign = over ? -1 : 1;
    return size_ * LongVec(sign * f.cn, -sign * f.sn, f.dn);
  }
  Long argument(const Jacobi& f) const { return argument_of(f, m1_); }
  Jacobi functions(Long u) const { return jacobi(u, m1_); }
  Long half_period() const { return 2 * quarter_period(m1_); }
  // By how much X + a |L| t has grown since the argument was 0, and over half a period.
  Long turned(const Jacobi& f) const {
    const Long s = f.sn;
    return std::atan2(ratio_ * s, f.cn) +
           s * s * s * third() * carlson_rj(f.cn * f.cn, f.dn * f.dn, 1, 1 + n_ * s * s);
  }
  Long half_turn() const {
    return std::numbers::pi_v<Long> + 2 * third() * carlson_rj(0, m1_, 1, 1 + n_);
  }

  Long rate = 0;  // of the argument, for each radian |L| t

 private:
  Long third() const { return n_ * ratio_ / (3 * size_.z); }

  LongVec size_{0.0L};  // A1, A2, A3
  Long m1_ = 1;         // 1 - m
  Long ratio_ = 1;      // sqrt(1 + a / c)
  Long n_ = 0;          // a / c
};

}  // namespace

glm::dquat tumbled_freely(const Vec<3>& momentum, const Vec<3>& excess, double h) {
  const LongVec l(momentum), own(excess);
  const Long length = glm::length(l);
  const Naming names = naming(l / length, own);
  const LongVec n = names.named(l / length);
  const Long a = std::abs(own[names.axis[0]]), c = std::abs(own[names.axis[2]]);
  // If z is the axis of the least inverse inertia, all signs are the other way round.
  const Long time = length * h * (own[names.axis[2]] < 0 ? -1 : 1);
  const Curve curve(n, a, c);
  bool over = false;
  const Jacobi from = curve.at(n, over);
  const Long argument = curve.argument(from) + curve.rate * time, half = curve.half_period();
  const Long halves = std::round(argument / half);
  const Jacobi to = curve.functions(argument - halves * half);
  if (std::fmod(halves, 2.0L) != 0) over = !over;
  const Long x = halves * curve.half_turn() + (curve.turned(to) - curve.turned(from)) - a * time;
  const LongQuat about_z(std::cos(x / 2), 0, 0, std::sin(x / 2));
  return names.unnamed(glm::conjugate(turn_to_z(n)) * about_z * turn_to_z(curve.point(to, over)));
}

}  // namespace lantern::physics
