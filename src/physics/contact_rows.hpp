// Contact constraints: bodies do not move into each other, and friction holds them back.
//
// Each point has one row along the normal and, with friction, one block across it. Rows are solved
// one after another, again and again (projected Gauss-Seidel; Catto, "Iterative Dynamics with
// Temporal Coherence", 2005): each finds the impulse after which its own condition holds, and the
// sum of impulses is clamped, not each single one.
//
//   normal     pn >= 0, and the bodies do not approach
//   friction   |pt| <= mu pn: a cone, so all directions are alike
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "physics/contacts.hpp"
#include "physics/solver_body.hpp"

namespace lantern::physics {

// The numbers of all methods that solve rows.
struct RowSettings {
  // What approaches slower than gravity makes in so many sub-steps does not bounce.
  double bounce_steps = 2;
  // Of the way that forces make in a sub-step: what is so near has no gap. (A gap must be closed by
  // a velocity, which the next sub-step must stop again: of gaps that are mere rounding that would
  // make noise in all the impulses of a stack.)
  double touching_way = 1e-4;
  // The part of penetration that one sub-step pushes out, and at most how fast, in units a second.
  // So stiffness grows with the rate of sub-steps (Catto, "Soft Constraints", 2011; Macklin et al.,
  // "Small Steps in Physics Simulation", 2019).
  double pushed_out = 0.25;
  double fastest_push = 4;
  double corner = 1e-3;         // of a body's size: so near to a corner of it is at the corner
  double hardly_slowed = 1e-3;  // of what friction alone would slow: balances forces
  // Of full friction: what stops a body within so little of it does not slip in the end.
  double slip_by_rounding = 1e-6;
  // Of the firmest point's impulse: one that presses less presses by rounding only.
  double presses_by_rounding = 1e-9;
  // When sweeps have done enough. Of the largest impulse: so small a change of any ends the sweeps.
  // In a stack of n boxes the last change stands for an error of (2n / pi)^2 times as much; the
  // motion that it leaves is a blow to the next direct solve, which would push as much the other
  // way, and so on.
  double change = 1e-12;
  // Of what impulses change: so little work is done by rounding.
  double work_by_rounding = 1e-9;
  double push = 1e-3;       // of the largest push out of penetration, and
  double no_matter = 1e-7;  // of the largest impulse: what is less than either is enough
};
inline constexpr RowSettings kRowSettings;

template <int D>
struct ContactPoint {
  std::uint32_t feature = 0;
  // From a body's centre to its surface: what turns with it (in its own axes) and what does not
  // (a ball that rolls keeps its lowest point).
  Vec<D> core_a{0.0}, core_b{0.0}, round_a{0.0}, round_b{0.0};
  Vec<D> arm_a{0.0}, arm_b{0.0};  // to the point where impulses act, in the world's axes
  double share = 0.5;             // where impulses act, from a's surface (0) to b's (1)
  double offset = 0;              // of the separation, against what the arms say
  double separation = 0;
  double gap = 0;                   // the same while they do not touch, else 0
  double inverse_normal_mass = 0;   // effective
  double inverse_tangent_mass = 0;  // in the direction in which it is largest
  double pn = 0;                    // normal impulse of this sub-step, N s
  Vec<D> pt{0.0};                   // friction impulse of this sub-step
  double bounce = 0;                // wanted speed of parting
  Vec<D> slip{0.0};                 // across the normal, before this sub-step's forces
  Vec<D> kicked_slip{0.0};          // and after them
  Vec<D> wanted_slip{0.0};          // mean over this sub-step, if it sticks
  double correction = 0;            // impulse that pushes out penetration, along the normal
  bool sticks = false;

  // The mean speed of parting, over `h` seconds, that a point which presses should have.
  double wanted_mean_speed(double h) const {
    if (gap > 0) return -gap / h;
    return std::min(-separation * kRowSettings.pushed_out / h, kRowSettings.fastest_push);
  }
};

// What one sweep did.
struct Sweep {
  double change = 0;   // largest change of an impulse
  double largest = 0;  // largest impulse
  // How many were solved.
  std::uint64_t normal_rows = 0;
  std::uint64_t friction_rows = 0;
  std::uint64_t joint_rows = 0;
};

// The contact of two bodies of an island.
template <int D>
struct ContactRows {
  std::uint32_t a = 0, b = 0;  // places among the island's bodies
  double friction = 0;
  double restitution = 0;
  Vec<D> normal{0.0};
  std::array<ContactPoint<D>, Manifold<D>::kMostPoints> room;
  int count = 0;

  std::span<ContactPoint<D>> points() { return {room.data(), static_cast<std::size_t>(count)}; }
  std::span<const ContactPoint<D>> points() const {
    return {room.data(), static_cast<std::size_t>(count)};
  }

  // Points from the narrow phase, with the impulses per second of points of the same feature.
  void set_points(const Manifold<D>& manifold, const Body<D>& body_a, const Body<D>& body_b,
                  const Mat<D>& axes_a, const Mat<D>& axes_b, const Contact<D>* remembered,
                  double scale);
  // Arms, separations and effective masses where the bodies are now; velocities are those before
  // the sub-step's forces. Points that approach faster than `threshold` bounce; those no farther
  // apart than `touching` have no gap.
  void refresh(const Body<D>& body_a, const Body<D>& body_b, const Mat<D>& axes_a,
               const Mat<D>& axes_b, const SolverBody<D>& solver_a, const SolverBody<D>& solver_b,
               double threshold, double touching);
  void warm_start(SolverBody<D>& body_a, SolverBody<D>& body_b);
  // One sweep over velocities, for a sub-step of `h` seconds.
  void solve_velocities(SolverBody<D>& body_a, SolverBody<D>& body_b, double h, Sweep& sweep);
  // What follows from the velocities found: the way that slipping points lag behind (see
  // sub_step.hpp), and how far sticking ones may still slide. `lag_a` and `lag_b` are the lags that
  // the integrator has already.
  void begin_correction(SolverBody<D>& body_a, SolverBody<D>& body_b, double lag_a, double lag_b);
  // One sweep over mean velocities: after `h` seconds, points that press touch without penetration,
  // or with a part of it.
  void correct_positions(SolverBody<D>& body_a, SolverBody<D>& body_b, double h, Sweep& sweep);
};

}  // namespace lantern::physics
