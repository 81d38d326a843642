#include "physics/joint_rows.hpp"

#include <algorithm>

#include <glm/matrix.hpp>

namespace lantern::physics {
namespace {

// Column j is the relative velocity that an impulse of 1 along axis j gives.
template <int D>
Mat<D> response(const JointRows<D>& rows, const SolverBody<D>& a, const SolverBody<D>& b) {
  Mat<D> k(a.inverse_mass + b.inverse_mass);
  for (int j = 0; j < D; ++j) {
    Vec<D> axis{0.0};
    axis[j] = 1;
    const Spin<D> spin_a = a.inverse_inertia * cross(rows.arm_a, axis);
    const Spin<D> spin_b = b.inverse_inertia * cross(rows.arm_b, axis);
    k[j] += cross(spin_a, rows.arm_a) + cross(spin_b, rows.arm_b);
  }
  return k;
}

// The impulse that adds `wanted` to the relative velocity.
template <int D>
Vec<D> impulse_for(const JointRows<D>& rows, const Vec<D>& wanted) {
  if (rows.joint.kind == JointKind::pin) return rows.solve * wanted;
  if (rows.inverse_mass == 0) return Vec<D>(0.0);
  return rows.direction * (glm::dot(rows.direction, wanted) / rows.inverse_mass);
}

}  // namespace

template <int D>
void JointRows<D>::find_gap(const Body<D>& body_a, const Body<D>& body_b) {
  arm_a = matrix(body_a.orientation) * joint.at_a;
  arm_b = matrix(body_b.orientation) * joint.at_b;
  gap = (body_b.position - body_a.position) + arm_b - arm_a;
  if (joint.kind == JointKind::pin) return;
  const double length = glm::length(gap);
  direction = length > 0 ? gap / length : Vec<D>(0.0);
}

template <int D>
Vec<D> JointRows<D>::error() const {
  return joint.kind == JointKind::pin ? gap : gap - direction * joint.length;
}

template <int D>
void JointRows<D>::refresh(const Body<D>& body_a, const Body<D>& body_b,
                           const SolverBody<D>& solver_a, const SolverBody<D>& solver_b) {
  find_gap(body_a, body_b);
  if (joint.kind == JointKind::pin) {
    solve = glm::inverse(response(*this, solver_a, solver_b));
    return;
  }
  inverse_mass = inverse_effective_mass(solver_a, arm_a, solver_b, arm_b, direction);
  impulse = direction * glm::dot(direction, impulse);
}

template <int D>
void JointRows<D>::warm_start(SolverBody<D>& body_a, SolverBody<D>& body_b) {
  body_a.apply(-impulse, arm_a);
  body_b.apply(impulse, arm_b);
}

template <int D>
void JointRows<D>::solve_velocities(SolverBody<D>& body_a, SolverBody<D>& body_b, Sweep& sweep) {
  const Vec<D> gained = impulse_for(*this, -relative_velocity(body_a, arm_a, body_b, arm_b));
  impulse += gained;
  body_a.apply(-gained, arm_a);
  body_b.apply(gained, arm_b);
  sweep.change = std::max(sweep.change, glm::length(gained));
  sweep.largest = std::max(sweep.largest, glm::length(impulse));
  sweep.joint_rows += joint.kind == JointKind::pin ? D : 1;
}

template <int D>
void JointRows<D>::correct_positions(SolverBody<D>& body_a, SolverBody<D>& body_b, Sweep& sweep) {
  const Vec<D> gained = impulse_for(*this, -relative_mean_velocity(body_a, arm_a, body_b, arm_b));
  body_a.correct(-gained, arm_a);
  body_b.correct(gained, arm_b);
  sweep.change = std::max(sweep.change, glm::length(gained));
  sweep.joint_rows += joint.kind == JointKind::pin ? D : 1;
}

template <int D>
double JointRows<D>::swing_squared(const Body<D>& body_a, const Body<D>& body_b,
                                   double tension) const {
  const auto swing = [&](const Body<D>& body, const Vec<D>& at) {
    if (body.kind != BodyKind::dynamic_body || body.asleep) return 0.0;
    double most = 0;
    for (int i = 0; i < (D == 2 ? 1 : 3); ++i)
      most = std::max(most, spin_component(body.inverse_inertia, i));
    return glm::length(at) * most +
           (joint.kind == JointKind::distance ? body.inverse_mass / joint.length : 0);
  };
  return tension * (swing(body_a, joint.at_a) + swing(body_b, joint.at_b));
}

template struct JointRows<2>;
template struct JointRows<3>;

}  // namespace lantern::physics
