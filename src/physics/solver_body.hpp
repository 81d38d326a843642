// A body while constraints are solved: just its velocities and what resists their change.
#pragma once

#include <array>
#include <cmath>
#include <type_traits>

#include "physics/body.hpp"

namespace lantern::physics {

// Inverse inertia in the world's axes.
template <int D>
using Inertia = std::conditional_t<D == 2, double, Mat<3>>;

template <int D>
struct SolverBody {
  double inverse_mass = 0;
  Inertia<D> inverse_inertia{0.0};
  Vec<D> velocity{0.0};
  Spin<D> spin{0.0};
  Spin<D> twist{0.0};  // angular momentum gained from constraints
  // How the body really moves over the sub-step: its mean velocities. They differ from the
  // above by what pushes out penetration, which must not become motion (split impulses).
  Vec<D> mean_velocity{0.0};
  Spin<D> mean_spin{0.0};
  Spin<D> lag{0.0};           // of the angular momentum while the body turns, see Increment
  Spin<D> turning_spin{0.0};  // the mean spin that this gives

  void apply(const Vec<D>& impulse, const Vec<D>& arm) {
    const Spin<D> turn = cross(arm, impulse);
    velocity += impulse * inverse_mass;
    spin += inverse_inertia * turn;
    twist += turn;
  }
  // The same for an impulse of `size` along `direction`, of which is known how it turns the body.
  void apply_along(const Vec<D>& direction, const Spin<D>& turn, const Spin<D>& gained,
                   double size) {
    velocity += direction * (size * inverse_mass);
    spin += gained * size;
    twist += turn * size;
  }
  void correct_along(const Vec<D>& direction, const Spin<D>& gained, double size) {
    mean_velocity += direction * (size * inverse_mass);
    mean_spin += gained * size;
  }
  void correct(const Vec<D>& impulse, const Vec<D>& arm) {
    mean_velocity += impulse * inverse_mass;
    mean_spin += inverse_inertia * cross(arm, impulse);
  }
};

template <int D>
Vec<D> relative_velocity(const SolverBody<D>& a, const Vec<D>& arm_a, const SolverBody<D>& b,
                         const Vec<D>& arm_b) {
  return (b.velocity + cross(b.spin, arm_b)) - (a.velocity + cross(a.spin, arm_a));
}
template <int D>
Vec<D> relative_mean_velocity(const SolverBody<D>& a, const Vec<D>& arm_a, const SolverBody<D>& b,
                              const Vec<D>& arm_b) {
  return (b.mean_velocity + cross(b.mean_spin, arm_b)) -
         (a.mean_velocity + cross(a.mean_spin, arm_a));
}

// Unit vectors across a unit vector and each other.
inline std::array<Vec<2>, 1> tangents(const Vec<2>& n) { return {Vec<2>(-n.y, n.x)}; }
inline std::array<Vec<3>, 2> tangents(const Vec<3>& n) {
  const Vec<3> other = std::abs(n.x) < 0.6 ? Vec<3>(1, 0, 0) : Vec<3>(0, 1, 0);
  const Vec<3> s = glm::normalize(glm::cross(n, other));
  return {s, glm::cross(n, s)};
}

// How much relative velocity along `direction` an impulse of 1 along it gives: the inverse of the
// effective mass.
template <int D>
double inverse_effective_mass(const SolverBody<D>& a, const Vec<D>& arm_a, const SolverBody<D>& b,
                              const Vec<D>& arm_b, const Vec<D>& direction) {
  const Spin<D> turn_a = cross(arm_a, direction);
  const Spin<D> turn_b = cross(arm_b, direction);
  const Spin<D> gained_a = a.inverse_inertia * turn_a;
  const Spin<D> gained_b = b.inverse_inertia * turn_b;
  return a.inverse_mass + b.inverse_mass + dot(turn_a, gained_a) + dot(turn_b, gained_b);
}

}  // namespace lantern::physics
