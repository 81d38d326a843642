// What the implicit methods share: velocities that must agree with the forces they lead to.
#pragma once

#include <string_view>

#include "physics/integrate/motion_matrix.hpp"

namespace lantern::physics {

// The state `time` after the start whose own forces lead to it: v = v0 + time a(x0 + time v, v), an
// implicit Euler step, solved to rounding. Throws Refused, naming the method and the step `h`, if
// that does not converge. The solver is chosen by the size; tests hold them against each other.
template <int D>
SmoothState<D> implicit_stage(SmoothSystem<D>& system, double time, std::string_view method,
                              double h, LinearSolver solver = LinearSolver::by_size);

// Kicks `state`, whose places stay, for `time` by forces that use the velocities after the kick:
// v := v + time a(x, v_new). One evaluation and one linear solution. Throws Refused if numbers fail
// (damping beyond 1e16 times mass / time).
template <int D>
void damped_kick(SmoothSystem<D>& system, SmoothState<D>& state, double time,
                 LinearSolver solver = LinearSolver::by_size);

}  // namespace lantern::physics
