// The classical method of Runge and Kutta (Kutta 1901): four looks at the forces, at the start, two
// in the middle and one at the end, each from where the one before leads.
#include "physics/smooth_system.hpp"

namespace lantern::physics {

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

  // x1 = x0 + h v0 + h^2/6 (a1 + a2 + a3) and v1 = v0 + h/6 (a1 + 2 a2 + 2 a3 + a4), so that
  // x1 - x0 - h v1 = -h^2/6 (a2 + a3 + a4).
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

template void runge_kutta_4(SmoothSystem<2>&, double, std::vector<Increment<2>>&);
template void runge_kutta_4(SmoothSystem<3>&, double, std::vector<Increment<3>>&);

}  // namespace lantern::physics
