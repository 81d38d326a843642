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
// where a turn is no longer small, the top is turned in closed form (free_top.hpp), which costs a
// few microseconds.
#include "physics/free_rotation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.hpp"
#include "physics/free_top.hpp"

namespace lantern::physics {
namespace {

// Turned about its own axis `axis`.
glm::dquat turned_about_own_axis(const glm::dquat& q, int axis, double angle) {
  Vec<3> v{0.0};
  v[axis] = std::sin(angle / 2);
  return q * glm::dquat(std::cos(angle / 2), v);
}

// The two terms that are left: axis and 1/Ii - m.
struct Split {
  int middle_axis;
  double middle;
  std::array<int, 2> axis;
  std::array<double, 2> excess;
};

// How far a splitting is good: the largest angle |excess| |L| h in radians, and the largest swing
// of energy, as `swing` below tells it, of which the true one is a third (splitting_2). Chosen so
// that over random tops of any shape the energy stayed within a thousandth.
struct Limits {
  double angle, swing;
};
constexpr Limits limits_of(RotationMethod method) {
  return method == RotationMethod::splitting_2 ? Limits{0.6, 0.004} : Limits{1.6, 0.04};
}

Split split(const Vec<3>& inverse_inertia) {
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](int i, int j) { return inverse_inertia[i] < inverse_inertia[j]; });
  const double middle = inverse_inertia[order[1]];
  return {order[1],
          middle,
          {order[0], order[2]},
          {inverse_inertia[order[0]] - middle, inverse_inertia[order[2]] - middle}};
}

// The leading term of Strang's error against the energy, by the largest that the outer components
// of L become: when the middle one is 0.
double swing(const Vec<3>& l, const Vec<3>& inverse_inertia, const Split& terms, double h) {
  const double low = -terms.excess[0], high = terms.excess[1];
  const Vec<3> square = l * l;
  const double middle = square[terms.middle_axis] / (low + high);
  const double most_low = square[terms.axis[0]] + high * middle;
  const double most_high = square[terms.axis[1]] + low * middle;
  return h * h * low * high * (low * most_low + high * most_high) * glm::dot(l, l) /
         glm::dot(inverse_inertia, square);
}

bool is_small(const Vec<3>& l, const Vec<3>& inverse_inertia, const Split& terms, double h,
              RotationMethod method) {
  const double low = -terms.excess[0], high = terms.excess[1];
  if (low == 0 || high == 0) return true;  // exact
  const Limits limits = limits_of(method);
  return std::max(low, high) * glm::length(l) * std::abs(h) <= limits.angle &&
         swing(l, inverse_inertia, terms, h) <= limits.swing;
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
  if (!is_small(own, inverse_inertia, terms, h, method)) {
    Vec<3> excess(0.0);
    for (int i = 0; i < 2; ++i) excess[terms.axis[i]] = terms.excess[i];
    q = q * tumbled_freely(own, excess, h);
  } else if (method == RotationMethod::splitting_2) {
    q = strang_step(q, l, terms, h);
  } else {
    for (const double part : {kSuzuki, kSuzuki, 1 - 4 * kSuzuki, kSuzuki, kSuzuki})
      q = strang_step(q, l, terms, part * h);
  }
  return turned(Rotation<3>{q}, l * (terms.middle * h));
}

}  // namespace

template <int D>
Rotation<D> freely_turned(const Body<D>& body, const Spin<D>& angular_momentum, double h,
                          RotationMethod method) {
  LANTERN_CHECK(static_cast<int>(method), !=,
                static_cast<int>(RotationMethod::explicit_gyroscopic));
  if (body.kind == BodyKind::static_body || body.asleep) return body.orientation;
  if (body.kind == BodyKind::kinematic_body)
    return turned(body.orientation, Spin<D>(body.kinematic_spin * h));
  if (angular_momentum == Spin<D>(0.0)) return body.orientation;
  if constexpr (D == 2) {
    return turned(body.orientation, angular_momentum * body.inverse_inertia * h);
  } else {
    return turned_as_top(body.orientation, body.inverse_inertia, angular_momentum, h, method);
  }
}

template <int D>
void turn_freely(Body<D>& body, double h, RotationMethod method, const Spin<D>& lag) {
  if (method != RotationMethod::explicit_gyroscopic) {
    body.orientation = freely_turned(body, body.angular_momentum + lag, h, method);
    return;
  }
  body.angular_momentum += lag;
  if (D == 2 || body.kind != BodyKind::dynamic_body) {
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

template Rotation<2> freely_turned(const Body<2>&, const Spin<2>&, double, RotationMethod);
template Rotation<3> freely_turned(const Body<3>&, const Spin<3>&, double, RotationMethod);
template void turn_freely(Body<2>&, double, RotationMethod, const Spin<2>&);
template void turn_freely(Body<3>&, double, RotationMethod, const Spin<3>&);

}  // namespace lantern::physics
