// Explicit Euler: everything by what it was at the start of the step. A warning: an undamped spring
// gains energy at every step, however short.
#include "physics/smooth_system.hpp"

namespace lantern::physics {

template <int D>
void explicit_euler(SmoothSystem<D>& system, double h, std::vector<Increment<D>>& out) {
  const Pull<D> pull = system.evaluate(system.start());
  for (const std::size_t i : system.movers()) {
    const Vec<D> kick = h * pull.acceleration[i];
    const Spin<D> twist = h * pull.torque[i];
    out[i] = {kick, -h * kick, twist, -twist};  // flies with the velocity before the kick
  }
}

template void explicit_euler(SmoothSystem<2>&, double, std::vector<Increment<2>>&);
template void explicit_euler(SmoothSystem<3>&, double, std::vector<Increment<3>>&);

}  // namespace lantern::physics
