// Implicit Euler: the forces are those at the end of the step. Stable at any step, but it eats the
// energy of every spring (Baraff and Witkin, "Large steps in cloth simulation", 1998; they stop
// after one Newton iteration, this does not).
#include "physics/implicit_stage.hpp"
#include "physics/smooth_system.hpp"

namespace lantern::physics {

template <int D>
void implicit_euler(SmoothSystem<D>& system, double h, std::vector<Increment<D>>& out) {
  const SmoothState<D> end = implicit_stage(system, h, "implicit_euler", h);
  for (const std::size_t i : system.movers())
    out[i] = {end.kick[i], Vec<D>(0.0), end.twist[i], Spin<D>(0.0)};
}

template void implicit_euler(SmoothSystem<2>&, double, std::vector<Increment<2>>&);
template void implicit_euler(SmoothSystem<3>&, double, std::vector<Increment<3>>&);

}  // namespace lantern::physics
