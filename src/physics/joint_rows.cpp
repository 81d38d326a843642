#include "physics/joint_rows.hpp"

#include <algorithm>

#include <glm/matrix.hpp>

namespace lantern {
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

template <int D>
Vec<D> error(const JointRows<D>& rows) {
  if (rows.joint.kind == JointKind::pin) return rows.gap;
  return rows.gap - rows.direction * rows.joint.length;
}

}  // namespace

template <int D>
void refresh(JointRows<D>& rows, const Body<D>& a, const Body<D>& b, const SolverBody<D>& solver_a,
             const SolverBody<D>& solver_b) {
  rows.arm_a = matrix(a.orientation) * rows.joint.at_a;
  rows.arm_b = matrix(b.orientation) * rows.joint.at_b;
  rows.gap = (b.position - a.position) + rows.arm_b - rows.arm_a;
  if (rows.joint.kind == JointKind::pin) {
    rows.solve = glm::inverse(response(rows, solver_a, solver_b));
    return;
  }
  const double length = glm::length(rows.gap);
  rows.direction = length > 0 ? rows.gap / length : Vec<D>(0.0);
  rows.inverse_mass =
      inverse_effective_mass(solver_a, rows.arm_a, solver_b, rows.arm_b, rows.direction);
  rows.impulse = rows.direction * glm::dot(rows.direction, rows.impulse);
}

template <int D>
void warm_start(JointRows<D>& rows, SolverBody<D>& a, SolverBody<D>& b) {
  a.apply(-rows.impulse, rows.arm_a);
  b.apply(rows.impulse, rows.arm_b);
}

template <int D>
void solve_velocities(JointRows<D>& rows, SolverBody<D>& a, SolverBody<D>& b, Sweep& sweep) {
  const Vec<D> impulse = impulse_for(rows, -relative_velocity(a, rows.arm_a, b, rows.arm_b));
  rows.impulse += impulse;
  a.apply(-impulse, rows.arm_a);
  b.apply(impulse, rows.arm_b);
  sweep.change = std::max(sweep.change, glm::length(impulse));
  sweep.largest = std::max(sweep.largest, glm::length(rows.impulse));
  sweep.joint_rows += rows.joint.kind == JointKind::pin ? D : 1;
}

template <int D>
double wanted_mean_speed(const JointRows<D>& rows, const Vec<D>& direction, double h) {
  return -glm::dot(error(rows), direction) / h;
}

template <int D>
void correct_positions(JointRows<D>& rows, SolverBody<D>& a, SolverBody<D>& b, double h,
                       Sweep& sweep) {
  const Vec<D> impulse =
      impulse_for(rows, -error(rows) / h - relative_mean_velocity(a, rows.arm_a, b, rows.arm_b));
  a.correct(-impulse, rows.arm_a);
  b.correct(impulse, rows.arm_b);
  sweep.change = std::max(sweep.change, glm::length(impulse));
  sweep.joint_rows += rows.joint.kind == JointKind::pin ? D : 1;
}

#define LANTERN_INSTANTIATE(D)                                                               \
  template void refresh(JointRows<D>&, const Body<D>&, const Body<D>&, const SolverBody<D>&, \
                        const SolverBody<D>&);                                               \
  template void warm_start(JointRows<D>&, SolverBody<D>&, SolverBody<D>&);                   \
  template void solve_velocities(JointRows<D>&, SolverBody<D>&, SolverBody<D>&, Sweep&);     \
  template double wanted_mean_speed(const JointRows<D>&, const Vec<D>&, double);             \
  template void correct_positions(JointRows<D>&, SolverBody<D>&, SolverBody<D>&, double, Sweep&);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern
