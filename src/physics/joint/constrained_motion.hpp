// Bodies that joints hold and nothing touches: the joints are part of the equations of motion,
// which each method of integration solves in its own way, so that it keeps its order.
//
//   velocity_verlet         RATTLE (Andersen, J. Comput. Phys. 52, 1983): impulses along the joints
//                           at the start, after which they hold at the end; and at the end, after
//                           which their velocities do. Bodies turn as they do freely in between.
//   explicit_euler,         Runge-Kutta on the accelerations that the joints leave, orientations by
//   runge_kutta_4           Munthe-Kaas (Appl. Numer. Math. 29, 1999); the end is projected
//   implicit_midpoint,      the stage is solved for velocities and joints' impulses together, by
//   implicit_euler          Newton's method; places hold at the end, velocities are projected
//
// Semi-implicit Euler is not among them: its joints are solved by rows, as contacts are, which only
// take energy, where with impulses along the joints it would rise and fall by some percent.
//
// See Hairer, Lubich, Wanner, "Geometric Numerical Integration", VII.1 and IV.4.
#pragma once

#include <cmath>

#include "physics/contact/island.hpp"
#include "physics/joint/joint_system.hpp"

namespace lantern::physics {

// Moves the island, whole or, where that does not converge, in parts. Joints' impulses are noted in
// its rows. Velocities at the start that do not satisfy the joints are projected first, which only
// takes energy.
//
// The tension of joints may swing bodies faster than an explicit method can follow: light links
// that carry a heavy end. Then the implicit midpoint moves them; and what that does not solve,
// implicit Euler does.
//
// False if this is not for them: they are moved by different integrators, joints are wide open, or
// even small parts do not converge (see JointSettings). The bodies are then as they were, but may
// have been brought together where a joint was a little open, and their velocities projected.
template <int D>
bool move_constrained(const IslandMove<D>& move);

// One part while it is made: the rows and their factor are those of the start.
template <int D>
struct ConstrainedPart {
  SmoothSystem<D>& system;
  JointSystem<D>& joints;
  SmoothState<D>& state;  // that of the start, then that of the end
  double h;
  double swing = 0;  // how fast the joints' tension swings bodies, radians a second, if it matters

  // Whether an explicit method can follow it.
  bool follows(double swing_squared) {
    swing = std::sqrt(swing_squared);
    return h * swing <= kJointSettings.most_swing;
  }
};

// How each method moves a part; false if it does not converge.
template <int D>
bool constrained_explicit_euler(ConstrainedPart<D>& part);
template <int D>
bool constrained_verlet(ConstrainedPart<D>& part);
template <int D>
bool constrained_runge_kutta_4(ConstrainedPart<D>& part);
template <int D>
bool constrained_implicit_midpoint(ConstrainedPart<D>& part);
template <int D>
bool constrained_implicit_euler(ConstrainedPart<D>& part);

// v := v + time a(x, v_new) by forces and joints together, places as they are; rows of the state.
template <int D>
bool constrained_damped_kick(ConstrainedPart<D>& part, double time);

}  // namespace lantern::physics
