// Joint constraints, solved by the same sweeps as contacts; their impulses may push and pull.
#pragma once

#include "physics/contact_rows.hpp"
#include "physics/joint.hpp"
#include "physics/solver_body.hpp"

namespace lantern::physics {

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
  double seconds = 0;       // of the sub-step of the last step that it is from; 0: there was none

  void refresh(const Body<D>& body_a, const Body<D>& body_b, const SolverBody<D>& solver_a,
               const SolverBody<D>& solver_b);
  void warm_start(SolverBody<D>& body_a, SolverBody<D>& body_b);
  void solve_velocities(SolverBody<D>& body_a, SolverBody<D>& body_b, Sweep& sweep);
  // The mean relative velocity along `along` that mends the joint in `h` seconds.
  double wanted_mean_speed(const Vec<D>& along, double h) const;
  // After `h` seconds the points are where the joint wants them.
  void correct_positions(SolverBody<D>& body_a, SolverBody<D>& body_b, double h, Sweep& sweep);
};

}  // namespace lantern::physics
