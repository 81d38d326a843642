// Joint constraints, solved by the same sweeps as contacts; their impulses may push and pull.
#pragma once

#include <algorithm>

#include <glm/matrix.hpp>

#include "physics/contact/contact_rows.hpp"
#include "physics/joint.hpp"

namespace lantern::physics {

// The numbers of joints that are solved as equations.
struct JointSettings {
  double rounding = 0x1p-49;   // of the lengths and speeds that cancel: so small an error is none
  double near_rounding = 1e6;  // times that, where solving once more makes it no smaller
  int most_rounds = 40;        // of Newton's method
  double least_part = 1e-11;   // of a row, that those before it do not say
  double compliance = 1e-10;   // of rows that say the same twice
  int compliant_rounds = 4;    // in which accelerations are mended
  double wide_open = 1e-3;     // of a joint's size: a wider gap at the start is eased out by rows
  double fastest_closing = 4;  // units a second, the same
  // Of h times the frequency that the joints' tension makes: explicit methods are stable below 2.
  double most_swing = 1;
  // Radians in a part, of bodies whose inertia is not alike about all axes: farther on, a joint's
  // impulses would find other energies.
  double most_turn = 0.25;
  double most_gain = 1e-2;  // of kinetic energy, in a part: more is no solution of these equations
  int most_parts = 16;      // into which a step is cut if it does not converge whole
  // Of joints beside contacts: rounds in which gaps are closed, to so small a part of the way that
  // may be moved; and products for one factor.
  int closing_rounds = 8;
  double damping = 1e-2;                // of rows, where gaps close by no straight way
  double swept_compliance = 1e-6;       // of rows that say the same twice
  double shortest_sub_step = 1.0 / 64;  // of a step; joints that swing fast cut it so far
  double closed = 1e-9;
  double most_work = 4e6;
  std::size_t most_dense = 512;  // rows of implicit methods, whose matrix is full
};
inline constexpr JointSettings kJointSettings;

template <int D>
struct JointRows {
  Joint<D> joint = {};
  std::uint32_t place = 0;     // among the world's joints
  std::uint32_t a = 0, b = 0;  // places among the island's bodies
  Vec<D> arm_a{0.0}, arm_b{0.0};
  Vec<D> gap{0.0};          // from a's point to b's
  Vec<D> direction{0.0};    // of a rod, from a's point to b's
  Mat<D> solve{0.0};        // from an error of velocity to the impulse that mends it
  double inverse_mass = 0;  // effective, of a rod
  Vec<D> impulse{0.0};      // upon b, of this sub-step, N s
  Backoff backoff = {};
  double seconds = 0;  // of the sub-step of the last step that it is from; 0: there was none

  int width() const { return joint.kind == JointKind::pin ? D : 1; }  // in rows

  // Arms, gap and direction where the bodies are; the rest is left as it was.
  void find_gap(const Body<D>& body_a, const Body<D>& body_b) {
    arm_a = matrix(body_a.orientation) * joint.at_a;
    arm_b = matrix(body_b.orientation) * joint.at_b;
    gap = (body_b.position - body_a.position) + arm_b - arm_a;
    if (joint.kind == JointKind::pin) return;
    const double length = glm::length(gap);
    direction = length > 0 ? gap / length : Vec<D>(0.0);
  }

  // What is to be taken from the gap.
  Vec<D> error() const {
    return joint.kind == JointKind::pin ? gap : gap - direction * joint.length;
  }

  void refresh(const Body<D>& body_a, const Body<D>& body_b, const SolverBody<D>& solver_a,
               const SolverBody<D>& solver_b) {
    find_gap(body_a, body_b);
    if (joint.kind == JointKind::pin) {
      solve = glm::inverse(response(solver_a, solver_b));
      return;
    }
    inverse_mass = inverse_effective_mass(solver_a, arm_a, solver_b, arm_b, direction);
    impulse = direction * glm::dot(direction, impulse);
  }

  void warm_start(SolverBody<D>& body_a, SolverBody<D>& body_b) {
    body_a.apply(-impulse, arm_a);
    body_b.apply(impulse, arm_b);
  }

  void solve_velocities(SolverBody<D>& body_a, SolverBody<D>& body_b, Sweep& sweep) {
    const Vec<D> gained = impulse_for(-relative_velocity(body_a, arm_a, body_b, arm_b));
    impulse += gained;
    body_a.apply(-gained, arm_a);
    body_b.apply(gained, arm_b);
    sweep.change = std::max(sweep.change, glm::length(gained));
    sweep.largest = std::max(sweep.largest, glm::length(impulse));
    sweep.joint_rows += width();
  }

  // Mean velocities, too, keep the points together. (Gaps are closed by JointBlock, after the
  // bodies have moved.)
  void correct_positions(SolverBody<D>& body_a, SolverBody<D>& body_b, Sweep& sweep) {
    const Vec<D> gained = impulse_for(-relative_mean_velocity(body_a, arm_a, body_b, arm_b));
    body_a.correct(-gained, arm_a);
    body_b.correct(gained, arm_b);
    sweep.change = std::max(sweep.change, glm::length(gained));
    sweep.joint_rows += width();
  }

  // The square of the frequency at which the bodies swing by a tension, an upper bound: an end at
  // distance l about the other by tension / l, and a body by the tension times its arm.
  double swing_squared(const Body<D>& body_a, const Body<D>& body_b, double tension) const {
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

 private:
  // Column j is the relative velocity that an impulse of 1 along axis j gives.
  Mat<D> response(const SolverBody<D>& body_a, const SolverBody<D>& body_b) const {
    Mat<D> k(body_a.inverse_mass + body_b.inverse_mass);
    for (int j = 0; j < D; ++j) {
      const Spin<D> spin_a = body_a.inverse_inertia * cross(arm_a, unit_vec<D>(j));
      const Spin<D> spin_b = body_b.inverse_inertia * cross(arm_b, unit_vec<D>(j));
      k[j] += cross(spin_a, arm_a) + cross(spin_b, arm_b);
    }
    return k;
  }

  // The impulse that adds `wanted` to the relative velocity.
  Vec<D> impulse_for(const Vec<D>& wanted) const {
    if (joint.kind == JointKind::pin) return solve * wanted;
    if (inverse_mass == 0) return Vec<D>(0.0);
    return direction * (glm::dot(direction, wanted) / inverse_mass);
  }
};

extern template struct JointRows<2>;
extern template struct JointRows<3>;

}  // namespace lantern::physics
