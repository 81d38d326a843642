#include "physics/integrator.hpp"

#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"
#include "physics/smooth_system.hpp"

namespace lantern {

template <int D>
void find_increments(Integrator integrator, std::span<const Body<D>> bodies,
                     const Forces<D>& forces, double h, std::vector<Increment<D>>& out,
                     std::uint64_t& evaluations) {
  if (!std::isfinite(h) || !(h > 0)) throw Refused(fmt::format("time step {} is not allowed", h));
  SmoothSystem<D> system(bodies, forces, evaluations);
  out.assign(bodies.size(), Increment<D>{});
  switch (integrator) {
    case Integrator::explicit_euler:
      return explicit_euler(system, h, out);
    case Integrator::semi_implicit_euler:
      return semi_implicit_euler(system, h, out);
    case Integrator::velocity_verlet:
      return velocity_verlet(system, h, out);
    case Integrator::runge_kutta_4:
      return runge_kutta_4(system, h, out);
    case Integrator::implicit_midpoint:
      return implicit_midpoint(system, h, out);
    case Integrator::implicit_euler:
      return implicit_euler(system, h, out);
  }
}

template void find_increments(Integrator, std::span<const Body<2>>, const Forces<2>&, double,
                              std::vector<Increment<2>>&, std::uint64_t&);
template void find_increments(Integrator, std::span<const Body<3>>, const Forces<3>&, double,
                              std::vector<Increment<3>>&, std::uint64_t&);

}  // namespace lantern
