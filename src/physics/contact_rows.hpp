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

#include <array>
#include <span>

#include "physics/contacts.hpp"
#include "physics/solver_body.hpp"

namespace lantern {

template <int D>
struct ContactPoint {
  std::uint32_t feature = 0;
  // From a body's centre to its surface: what turns with it (in its own axes) and what does not
  // (a ball that rolls keeps its lowest point).
  Vec<D> core_a{0.0}, core_b{0.0}, round_a{0.0}, round_b{0.0};
  Vec<D> arm_a{0.0}, arm_b{0.0};  // to the point where impulses act, in the world's axes
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
};

// The contact of two bodies of an island.
template <int D>
struct ContactRows {
  std::uint32_t a = 0, b = 0;  // places among the island's bodies
  double friction = 0;
  double restitution = 0;
  Vec<D> normal{0.0};
  double share = 0.5;  // where impulses act, from a's surface (0) to b's (1)
  std::array<ContactPoint<D>, Manifold<D>::kMostPoints> room;
  int count = 0;

  std::span<ContactPoint<D>> points() { return {room.data(), static_cast<std::size_t>(count)}; }
  std::span<const ContactPoint<D>> points() const {
    return {room.data(), static_cast<std::size_t>(count)};
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

// Points from the narrow phase, with the impulses per second of points of the same feature.
template <int D>
void set_points(ContactRows<D>& rows, const Manifold<D>& manifold, const Body<D>& a,
                const Body<D>& b, const Contact<D>* remembered, double scale);

// Arms, separations and effective masses where the bodies are now; velocities are those before the
// sub-step's forces. Points that approach faster than `threshold` bounce; those no farther apart
// than `touching` have no gap. (A gap must be closed by a velocity, which the next sub-step must
// stop again: of gaps that are mere rounding that would make noise in all the impulses of a stack.)
template <int D>
void refresh(ContactRows<D>& rows, const Body<D>& a, const Body<D>& b,
             const SolverBody<D>& solver_a, const SolverBody<D>& solver_b, double threshold,
             double touching);

template <int D>
void warm_start(ContactRows<D>& rows, SolverBody<D>& a, SolverBody<D>& b);

// One sweep over velocities, for a sub-step of `h` seconds.
template <int D>
void solve_velocities(ContactRows<D>& rows, SolverBody<D>& a, SolverBody<D>& b, double h,
                      Sweep& sweep);

// What follows from the velocities found: the way that slipping points lag behind (see
// sub_step.hpp), and how far sticking ones may still slide. `lag_a` and `lag_b` are the lags that
// the integrator has already.
template <int D>
void begin_correction(ContactRows<D>& rows, SolverBody<D>& a, SolverBody<D>& b, double lag_a,
                      double lag_b);

// The mean speed of parting, over `h` seconds, that a point which presses should have.
template <int D>
double wanted_mean_speed(const ContactPoint<D>& point, double h);

// One sweep over mean velocities: after `h` seconds, points that press touch without penetration,
// or with a part of it.
template <int D>
void correct_positions(ContactRows<D>& rows, SolverBody<D>& a, SolverBody<D>& b, double h,
                       Sweep& sweep);

}  // namespace lantern
