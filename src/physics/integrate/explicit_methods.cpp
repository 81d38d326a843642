// The methods that look at forces where bodies are already. Forces are evaluated once a step, or as
// often as a method says; a step that is too long for the stiffest spring blows up.
#include "physics/integrate/implicit_stage.hpp"
#include "physics/joint/constrained_motion.hpp"

namespace lantern::physics {

// Explicit Euler: everything by what it was at the start of the step. A warning: an undamped spring
// gains energy at every step, however short.
template <int D>
void explicit_euler(SmoothSystem<D>& system, double h, std::vector<Increment<D>>& out) {
  const Pull<D> pull = system.evaluate(system.start());
  for (const std::size_t i : system.movers()) {
    const Vec<D> kick = h * pull.acceleration[i];
    const Spin<D> twist = h * pull.torque[i];
    out[i] = {kick, -h * kick, twist, -twist};  // flies with the velocity before the kick
  }
}
extern const Integration kExplicitEuler = {
    .name = "explicit_euler",
    .lag = 1,
    .gains_energy = true,
    .increments = {explicit_euler<2>, explicit_euler<3>},
    .with_joints = {constrained_explicit_euler<2>, constrained_explicit_euler<3>}};

// Semi-implicit (symplectic) Euler: forces of the start change the velocity, and the new velocity
// moves the body. As cheap as explicit Euler, yet the energy of a spring stays bounded.
template <int D>
void semi_implicit_euler(SmoothSystem<D>& system, double h, std::vector<Increment<D>>& out) {
  const Pull<D> pull = system.evaluate(system.start());
  for (const std::size_t i : system.movers())
    out[i] = {h * pull.acceleration[i], Vec<D>(0.0), h * pull.torque[i], Spin<D>(0.0)};
}
extern const Integration kSemiImplicitEuler = {
    .name = "semi_implicit_euler", .increments = {semi_implicit_euler<2>, semi_implicit_euler<3>}};

// Velocity Verlet: half a kick, fly, half a kick (Swope and others, J. Chem. Phys. 76, 1982).
//
// Drag and damping need the velocity that the second half-kick is about to make. Taken from before
// it they would cost an order and stability; so that half is implicit in the velocity alone. Forces
// are linear in it, so one system of linear equations does. A half explicit and a half implicit
// make damping c shrink a velocity by (1 - ch/2m)/(1 + ch/2m), never by more than 1: the only limit
// left is that of the springs, omega h < 2.
template <int D>
void velocity_verlet(SmoothSystem<D>& system, double h, std::vector<Increment<D>>& out) {
  SmoothState<D> state = system.start();
  system.kick(state, system.evaluate(state), h / 2);
  system.fly(state, state, h);
  SmoothState<D> end = state;
  if (system.any_damping()) {
    damped_kick(system, end, h / 2);
  } else {
    const Pull<D> pull = system.evaluate(state);
    for (const std::size_t i : system.movers()) {
      end.kick[i] += h / 2 * pull.acceleration[i];
      end.twist[i] += h / 2 * pull.torque[i];
    }
  }
  for (const std::size_t i : system.movers()) {
    const Vec<D> second = end.kick[i] - state.kick[i];
    out[i] = {end.kick[i], -h * second, end.twist[i], state.twist[i] - end.twist[i]};
  }
}
extern const Integration kVelocityVerlet = {
    .name = "velocity_verlet",
    .order = 2,
    .lag = 0.5,
    .increments = {velocity_verlet<2>, velocity_verlet<3>},
    .with_joints = {constrained_verlet<2>, constrained_verlet<3>}};

// The classical method of Runge and Kutta (Kutta 1901): four looks at the forces, at the start, two
// in the middle and one at the end, each from where the one before leads.
template <int D>
void runge_kutta_4(SmoothSystem<D>& system, double h, std::vector<Increment<D>>& out) {
  SmoothState<D> state = system.start();
  // A look from `time` after the start, on the way that the last state and its pull show.
  const auto look = [&](const Pull<D>& pull, double time) {
    system.fly(state, state, time);  // with the last velocities, before they are kicked anew
    system.kick(state, pull, time);
    return system.evaluate(state);
  };
  const Pull<D> one = system.evaluate(state);
  const Pull<D> two = look(one, h / 2);
  const Pull<D> three = look(two, h / 2);
  const Pull<D> four = look(three, h);

  // x1 = x0 + h v0 + h^2/6 (a1 + a2 + a3) and v1 = v0 + h/6 (a1 + 2 a2 + 2 a3 + a4), so that x1 -
  // x0 - h v1 = -h^2/6 (a2 + a3 + a4).
  for (const std::size_t i : system.movers()) {
    const Vec<D> later = two.acceleration[i] + three.acceleration[i] + four.acceleration[i];
    const Spin<D> later_torque = two.torque[i] + three.torque[i] + four.torque[i];
    out[i].kick = h / 6 *
                  (one.acceleration[i] + 2.0 * (two.acceleration[i] + three.acceleration[i]) +
                   four.acceleration[i]);
    out[i].drift = -h * h / 6 * later;
    out[i].twist =
        h / 6 * (one.torque[i] + 2.0 * (two.torque[i] + three.torque[i]) + four.torque[i]);
    out[i].lag = -h / 6 * later_torque;
  }
}
extern const Integration kRungeKutta4 = {
    .name = "runge_kutta_4",
    .order = 4,
    .lag = 0.5,
    .increments = {runge_kutta_4<2>, runge_kutta_4<3>},
    .with_joints = {constrained_runge_kutta_4<2>, constrained_runge_kutta_4<3>}};

}  // namespace lantern::physics
