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
#include "physics/free_rotation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.hpp"

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
  double middle;
  std::array<int, 2> axis;
  std::array<double, 2> excess;
};

Split split(const Vec<3>& inverse_inertia) {
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](int i, int j) { return inverse_inertia[i] < inverse_inertia[j]; });
  const double middle = inverse_inertia[order[1]];
  return {middle,
          {order[0], order[2]},
          {inverse_inertia[order[0]] - middle, inverse_inertia[order[2]] - middle}};
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

Rotation<3> turned_by_splitting(const Rotation<3>& r, const Vec<3>& inverse_inertia,
                                const Vec<3>& l, double h, RotationMethod method) {
  const Split terms = split(inverse_inertia);
  glm::dquat q = r.q;
  if (method == RotationMethod::splitting_2) {
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
    return turned_by_splitting(body.orientation, body.inverse_inertia, angular_momentum, h, method);
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
