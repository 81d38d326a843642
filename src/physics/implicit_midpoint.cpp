// Implicit midpoint: the forces are those halfway between the start and the end of the step. The
// first half is a step of implicit Euler, the second repeats its kick. Symplectic and stable at any
// step; the energy of linear springs is kept to rounding (Hairer, Lubich, Wanner, IV.2 and VI.4).
#include "physics/implicit_stage.hpp"
#include "physics/smooth_system.hpp"

namespace lantern::physics {

template <int D>
void implicit_midpoint(SmoothSystem<D>& system, double h, std::vector<Increment<D>>& out) {
  const SmoothState<D> middle = implicit_stage(system, h / 2, "implicit_midpoint", h);
  for (const std::size_t i : system.movers()) {
    const Vec<D> half = middle.kick[i];
    const Spin<D> half_twist = middle.twist[i];
    out[i] = {2.0 * half, -h * half, 2.0 * half_twist, -half_twist};
  }
}

template void implicit_midpoint(SmoothSystem<2>&, double, std::vector<Increment<2>>&);
template void implicit_midpoint(SmoothSystem<3>&, double, std::vector<Increment<3>>&);

}  // namespace lantern::physics
