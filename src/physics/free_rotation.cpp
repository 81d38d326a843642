#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <glm/gtc/quaternion.hpp>

#include "base/check.hpp"
#include "geometry/elementary.hpp"
#include "geometry/elliptic.hpp"
#include "physics/body.hpp"

namespace lantern::physics {
namespace {

// The free top in closed form: how a body that nothing holds turns over any time, however fast.
//
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
// In twice the digits of a double: a body that has turned by millions of radians is then still
// right to the last digits of its inertia.

using Long = Twofold;
using LongVec = glm::vec<3, Long>;
using LongQuat = glm::qua<Long>;

// On the boundary itself L takes for ever to turn over. So near it no rounding tells the
// difference.
constexpr Long kLeastComplement = 1e-30;

// Which of the body's axes are x, y and z, and which of them are turned round: a right-handed
// frame, in which L is above the plane of x and y.
struct Naming {
  std::array<int, 3> axis{};
  LongVec sign{1.0};

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

LongQuat turn_to_z(const LongVec& n) {
  const Long w = 1 + n.z, size = sqrt(w * w + n.x * n.x + n.y * n.y);
  return {w / size, n.y / size, -n.x / size, 0};
}

// The curve that L runs along, in the named axes.
class Curve {
 public:
  Curve(const LongVec& n, Long a, Long c) : ratio_(sqrt(1 + a / c)), n_(a / c) {
    const Long wobble = (a + c) * n.x * n.x + c * n.y * n.y;
    const Long spin = (a + c) * n.z * n.z + a * n.y * n.y;
    size_ = {sqrt(wobble / (a + c)), sqrt(wobble / c), sqrt(spin / (a + c))};
    rate = sqrt(c * spin);
    const Long side = std::max<Long>(c * n.z * n.z - a * n.x * n.x, 0);
    m1_ = std::clamp<Long>(side * (a + c) / (c * spin), kLeastComplement, Long(1));
  }

  // Where n is: an argument within a quarter period of 0, or half a period further (`over`).
  Jacobi<Long> at(const LongVec& n, bool& over) const {
    Jacobi<Long> f{size_.y > 0 ? -n.y / size_.y : 0, size_.x > 0 ? n.x / size_.x : 1, 1};
    over = f.cn < 0;
    const Long length = sqrt(f.sn * f.sn + f.cn * f.cn) * (over ? -1 : 1);
    f.sn /= length;
    f.cn /= length;
    f.dn = sqrt(f.cn * f.cn + m1_ * f.sn * f.sn);
    return f;
  }
  LongVec point(const Jacobi<Long>& f, bool over) const {
    const Long sign = over ? -1 : 1;
    return size_ * LongVec(sign * f.cn, -sign * f.sn, f.dn);
  }
  Long argument(const Jacobi<Long>& f) const { return argument_of(f, m1_); }
  Jacobi<Long> functions(Long u) const { return jacobi(u, m1_); }
  Long half_period() const { return 2 * quarter_period(m1_); }
  // By how much X + a |L| t has grown since the argument was 0, and over half a period.
  Long turned(const Jacobi<Long>& f) const {
    const Long s = f.sn;
    return atan2(ratio_ * s, f.cn) +
           s * s * s * third() * carlson_rj<Long>(f.cn * f.cn, f.dn * f.dn, 1, 1 + n_ * s * s);
  }
  Long half_turn() const { return kTwofoldPi + 2 * third() * carlson_rj<Long>(0, m1_, 1, 1 + n_); }

  Long rate = 0;  // of the argument, for each radian |L| t

 private:
  Long third() const { return n_ * ratio_ / (3 * size_.z); }

  LongVec size_{0.0};  // A1, A2, A3
  Long m1_ = 1;        // 1 - m
  Long ratio_ = 1;     // sqrt(1 + a / c)
  Long n_ = 0;         // a / c
};

// The turn in the body's own axes, q(h) = q(0) * turn, of a body whose angular momentum has the
// components `momentum` along them, not all 0. `excess` are the inverse moments of inertia less the
// middle one: one is 0, one below, one above. What is taken off all three would turn the body about
// its angular momentum besides. `h` may be negative: back in time.
glm::dquat tumbled_freely(const Vec<3>& momentum, const Vec<3>& excess, double h) {
  const LongVec l(momentum), own(excess);
  const Long length = sqrt(l.x * l.x + l.y * l.y + l.z * l.z);
  const Naming names = naming(l / length, own);
  const LongVec n = names.named(l / length);
  const Long a = abs(own[names.axis[0]]), c = abs(own[names.axis[2]]);
  // If z is the axis of the least inverse inertia, all signs are the other way round.
  const Long time = length * h * (own[names.axis[2]] < 0 ? -1 : 1);
  const Curve curve(n, a, c);
  bool over = false;
  const Jacobi<Long> from = curve.at(n, over);
  const Long argument = curve.argument(from) + curve.rate * time, half = curve.half_period();
  const double halves = std::round(double(argument / half));
  const Jacobi<Long> to = curve.functions(argument - halves * half);
  if (std::fmod(halves, 2) != 0) over = !over;
  const Long x = halves * curve.half_turn() + (curve.turned(to) - curve.turned(from)) - a * time;
  const auto [sine, cosine] = sin_cos(x / 2);
  const LongQuat about_z(cosine, 0, 0, sine);
  return names.unnamed(glm::conjugate(turn_to_z(n)) * about_z * turn_to_z(curve.point(to, over)));
}

// The same for steps in which the argument of Jacobi's functions grows by `kBrief` at most, and ten
// times as fast: the series in the time of Euler's equation n' = n x w and of q' = q w / 2, where w
// are the excesses times n (Moore, "Interval Analysis", 1966, 11). Its ratio is at most that to the
// nearest pole, a quarter period of at least pi / 2 off the real axis.
constexpr double kBrief = 0.1;
glm::dquat tumbled_briefly(const Vec<3>& momentum, const Vec<3>& excess, double h) {
  constexpr int kMost = 20;
  std::array<Vec<3>, kMost> n{momentum}, w{h * (excess * momentum)};
  std::array<glm::dquat, kMost> q{glm::dquat(1, 0, 0, 0)};
  glm::dquat sum = q[0];
  for (std::size_t k = 1; k < kMost; ++k) {
    n[k] = Vec<3>(0.0);
    q[k] = glm::dquat(0, 0, 0, 0);
    for (std::size_t i = 0; i < k; ++i) {
      n[k] += glm::cross(n[i], w[k - 1 - i]);
      q[k] += q[i] * glm::dquat(0, w[k - 1 - i]);
    }
    n[k] /= static_cast<double>(k);
    q[k] /= static_cast<double>(2 * k);
    w[k] = h * (excess * n[k]);
    sum += q[k];
    if (glm::length(q[k]) + glm::length(q[k - 1]) < 0x1p-60) break;
  }
  return sum;
}

// The splitting of Touma and Wisdom ("Lie-Poisson integrators for rigid body dynamics in the solar
// system", Astron. J. 107, 1994), a variant of McLachlan's and Reich's three rotations (Hairer,
// Lubich, Wanner, "Geometric Numerical Integration", VII.5.3).
//
// Each term Li^2/2Ii alone would turn the body about its own axis i by h Li/Ii, exactly. Three such
// turns in a row make a step. It is better to take one inverse inertia m out of the sum first:
//
//   energy = m |L|^2/2  +  sum of (1/Ii - m) Li^2/2
//
// The first term turns the body about L, which stays as it is, and so commutes with all others:
// no error comes of it. If m is the middle one of the three, one term of the sum is gone, and the
// two that are left are as small as can be; if two inertias are equal only one is left, and if all
// are, none: then the step is exact.
//
// Its energy swings by a part of the step's square. Where that would be more than a thousandth, or
// where a turn is no longer small, the top is turned exactly.

// Turned about its own axis `axis`.
glm::dquat turned_about_own_axis(const glm::dquat& q, int axis, double angle) {
  Vec<3> v{0.0};
  const auto [sine, cosine] = sin_cos(angle / 2);
  v[axis] = sine;
  return q * glm::dquat(cosine, v);
}

// The two terms that are left: axis and 1/Ii - m.
struct Split {
  int middle_axis;
  double middle;
  std::array<int, 2> axis;
  std::array<double, 2> excess;
};

Split split(const Vec<3>& inverse_inertia) {
  std::array<int, 3> order{0, 1, 2};
  std::ranges::sort(order, {}, [&](int i) { return std::pair(inverse_inertia[i], i); });
  const double middle = inverse_inertia[order[1]];
  return {order[1],
          middle,
          {order[0], order[2]},
          {inverse_inertia[order[0]] - middle, inverse_inertia[order[2]] - middle}};
}

// Of the two terms, twice the largest that they become: when the middle component of L is 0.
std::array<double, 2> largest_terms(const Vec<3>& l, const Split& terms) {
  const double low = -terms.excess[0], high = terms.excess[1];
  const Vec<3> square = l * l;
  const double middle = low * high / (low + high) * square[terms.middle_axis];
  return {low * square[terms.axis[0]] + middle, high * square[terms.axis[1]] + middle};
}

// Whether the argument of Jacobi's functions (see `Curve`) grows by so little that the series does.
bool is_brief(const Vec<3>& l, const Split& terms, double h) {
  const auto [low, high] = largest_terms(l, terms);
  return (terms.excess[1] - terms.excess[0]) * std::max(low, high) * h * h <= kBrief * kBrief;
}

// Whether a splitting is good: the largest angle |excess| |L| h in radians, and the leading term of
// Strang's error against the energy, of which the true one is a third (splitting_2). Chosen so that
// over random tops of any shape the energy stayed within a thousandth.
bool is_small(const Vec<3>& l, const Vec<3>& inverse_inertia, const Split& terms, double h,
              RotationMethod method) {
  if (method == RotationMethod::exact) return false;
  const bool second = method == RotationMethod::splitting_2;
  const auto [low, high] = largest_terms(l, terms);
  const double swing = h * h * -terms.excess[0] * terms.excess[1] * (low + high) * glm::dot(l, l) /
                       glm::dot(inverse_inertia, l * l);
  return std::max(-terms.excess[0], terms.excess[1]) * glm::length(l) * std::abs(h) <=
             (second ? 0.6 : 1.6) &&
         swing <= (second ? 0.004 : 0.04);
}

// Strang: half a turn about one axis, a whole one about the other, half of the first.
glm::dquat strang_step(glm::dquat q, const Vec<3>& l, const Split& terms, double h) {
  const auto turn = [&](int term, double time) {
    if (terms.excess[term] == 0) return;
    const int axis = terms.axis[term];
    const double own = (glm::conjugate(q) * l)[axis];  // component of L along the body's axis
    q = turned_about_own_axis(q, axis, time * own * terms.excess[term]);
  };
  turn(0, h / 2);
  turn(1, h);
  turn(0, h / 2);
  return q;
}

// Suzuki's five steps of second order make one of fourth (Phys. Lett. A 146, 1990). Longer, but of
// far smaller error than Yoshida's three, whose middle step goes back 1.7 h.
constexpr double kSuzuki = 0.41449077179437571;  // 1 / (4 - cbrt(4))

Rotation<3> turned_as_top(const Rotation<3>& r, const Vec<3>& inverse_inertia, const Vec<3>& l,
                          double h, RotationMethod method) {
  const Split terms = split(inverse_inertia);
  glm::dquat q = r.q;
  const Vec<3> own = glm::conjugate(q) * l;
  const bool one_term = terms.excess[0] == 0 || terms.excess[1] == 0;  // which any step turns right
  if (!one_term && !is_small(own, inverse_inertia, terms, h, method)) {
    Vec<3> excess(0.0);
    for (int i = 0; i < 2; ++i) excess[terms.axis[i]] = terms.excess[i];
    q = q * (is_brief(own, terms, h) ? tumbled_briefly(own, excess, h)
                                     : tumbled_freely(own, excess, h));
  } else if (one_term || method == RotationMethod::splitting_2) {
    q = strang_step(q, l, terms, h);
  } else {
    for (const double part : {kSuzuki, kSuzuki, 1 - 4 * kSuzuki, kSuzuki, kSuzuki})
      q = strang_step(q, l, terms, part * h);
  }
  return turned(Rotation<3>{q}, l * (terms.middle * h));
}

}  // namespace

std::string_view to_string(RotationMethod method) {
  using enum RotationMethod;
  return method == exact         ? "exact"
         : method == splitting_2 ? "splitting_2"
         : method == splitting_4 ? "splitting_4"
                                 : "explicit_gyroscopic";
}

template <int D>
Rotation<D> freely_turned(const Body<D>& body, const Rotation<D>& from,
                          const Spin<D>& angular_momentum, double h, RotationMethod method) {
  LANTERN_CHECK(static_cast<int>(method), !=,
                static_cast<int>(RotationMethod::explicit_gyroscopic));
  if (body.kind == BodyKind::static_body || body.asleep) return from;
  if (body.kind == BodyKind::kinematic_body) return turned(from, Spin<D>(body.kinematic_spin * h));
  if (angular_momentum == Spin<D>(0.0)) return from;
  if constexpr (D == 2) {
    return turned(from, angular_momentum * body.inverse_inertia * h);
  } else {
    return turned_as_top(from, body.inverse_inertia, angular_momentum, h, method);
  }
}

template <int D>
void turn_freely(Body<D>& body, double h, RotationMethod method, const Spin<D>& lag) {
  if (method != RotationMethod::explicit_gyroscopic) {
    body.orientation = freely_turned(body, body.angular_momentum + lag, h, method);
    return;
  }
  body.angular_momentum += lag;
  if (D == 2 || !body.is_dynamic()) {
    body.orientation = freely_turned(body, h);  // nothing wanders in the plane
  } else if constexpr (D == 3) {
    if (!body.asleep && body.turns_about_every_axis()) {
      // Euler's equation in the body's axes: I w' = L x w.
      const glm::dquat q = body.orientation.q;
      const Vec<3> l = glm::conjugate(q) * body.angular_momentum;
      const Vec<3> w = l * body.inverse_inertia;
      const Vec<3> next = w + h * (body.inverse_inertia * glm::cross(l, w));
      body.orientation = turned(body.orientation, q * (next * h));
      body.angular_momentum = body.orientation.q * (next / body.inverse_inertia);
    }
  }
  body.angular_momentum -= lag;
}

template Rotation<2> freely_turned(const Body<2>&, const Rotation<2>&, const Spin<2>&, double,
                                   RotationMethod);
template Rotation<3> freely_turned(const Body<3>&, const Rotation<3>&, const Spin<3>&, double,
                                   RotationMethod);
template void turn_freely(Body<2>&, double, RotationMethod, const Spin<2>&);
template void turn_freely(Body<3>&, double, RotationMethod, const Spin<3>&);

}  // namespace lantern::physics
