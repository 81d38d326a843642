// Semi-implicit (symplectic) Euler: forces of the start change the velocity, and the new velocity
// moves the body. As cheap as explicit Euler, yet the energy of a spring stays bounded.
#include "physics/smooth_system.hpp"

namespace lantern::physics {

template <int D>
void semi_implicit_euler(SmoothSystem<D>& system, double h, std::vector<Increment<D>>& out) {
  const Pull<D> pull = system.evaluate(system.start());
  for (const std::size_t i : system.movers())
    out[i] = {h * pull.acceleration[i], Vec<D>(0.0), h * pull.torque[i], Spin<D>(0.0)};
}

template void semi_implicit_euler(SmoothSystem<2>&, double, std::vector<Increment<2>>&);
template void semi_implicit_euler(SmoothSystem<3>&, double, std::vector<Increment<3>>&);

}  // namespace lantern::physics
