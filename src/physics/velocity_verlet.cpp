// Velocity Verlet: half a kick, fly, half a kick (Swope and others, J. Chem. Phys. 76, 1982).
//
// Drag and damping need the velocity that the second half-kick is about to make. Taken from before
// it they would cost an order and stability; so that half is implicit in the velocity alone. Forces
// are linear in it, so one system of linear equations does. A half explicit and a half implicit
// make damping c shrink a velocity by (1 - ch/2m)/(1 + ch/2m), never by more than 1: the only limit
// left is that of the springs, omega h < 2.
#include "physics/implicit_stage.hpp"
#include "physics/smooth_system.hpp"

namespace lantern::physics {

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

template void velocity_verlet(SmoothSystem<2>&, double, std::vector<Increment<2>>&);
template void velocity_verlet(SmoothSystem<3>&, double, std::vector<Increment<3>>&);

}  // namespace lantern::physics
