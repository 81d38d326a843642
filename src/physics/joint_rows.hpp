// Joint constraints, solved by the same sweeps as contacts; their impulses may push and pull.
#pragma once

#include <algorithm>

#include "physics/contact_rows.hpp"
#include "physics/joint.hpp"
#include "physics/solver_body.hpp"

namespace lantern::physics {

// How often joints are left to rows before they are tried as equations again, after that has
// failed: twice as long each time.
struct Backoff {
  int wait = 0;  // steps, or flights between impacts
  int next = 1;

  bool waits() { return wait > 0 && wait-- > 0; }
  void fail() {
    constexpr int kLongest = 64;
    wait = next;
    next = std::min(2 * next, kLongest);
  }
};

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

  // Arms, gap and direction where the bodies are; the rest is left as it was.
  void find_gap(const Body<D>& body_a, const Body<D>& body_b);
  Vec<D> error() const;  // what is to be taken from the gap
  void refresh(const Body<D>& body_a, const Body<D>& body_b, const SolverBody<D>& solver_a,
               const SolverBody<D>& solver_b);
  void warm_start(SolverBody<D>& body_a, SolverBody<D>& body_b);
  void solve_velocities(SolverBody<D>& body_a, SolverBody<D>& body_b, Sweep& sweep);
  // Mean velocities, too, keep the points together. (Gaps are closed by JointBlock, after the
  // bodies have moved.)
  void correct_positions(SolverBody<D>& body_a, SolverBody<D>& body_b, Sweep& sweep);
  // The square of the frequency at which the bodies swing by a tension, an upper bound: an end at
  // distance l about the other by tension / l, and a body by the tension times its arm.
  double swing_squared(const Body<D>& body_a, const Body<D>& body_b, double tension) const;
};

}  // namespace lantern::physics
