#include "physics/integrator.hpp"

#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"
#include "physics/smooth_system.hpp"

namespace lantern::physics {
namespace {

// In the order of the enumerators.
template <int D>
constexpr void (*kMethods[])(SmoothSystem<D>&, double, std::vector<Increment<D>>&) = {
    explicit_euler<D>, semi_implicit_euler<D>, velocity_verlet<D>,
    runge_kutta_4<D>,  implicit_midpoint<D>,   implicit_euler<D>};

}  // namespace

template <int D>
void find_increments(Integrator integrator, std::span<const Body<D>> bodies,
                     const Forces<D>& forces, double h, std::vector<Increment<D>>& out,
                     std::uint64_t& evaluations) {
  if (!std::isfinite(h) || !(h > 0)) throw Refused(fmt::format("time step {} is not allowed", h));
  SmoothSystem<D> system(bodies, forces, evaluations);
  out.assign(bodies.size(), Increment<D>{});
  kMethods<D>[static_cast<std::size_t>(integrator)](system, h, out);
}

template void find_increments(Integrator, std::span<const Body<2>>, const Forces<2>&, double,
                              std::vector<Increment<2>>&, std::uint64_t&);
template void find_increments(Integrator, std::span<const Body<3>>, const Forces<3>&, double,
                              std::vector<Increment<3>>&, std::uint64_t&);

}  // namespace lantern::physics
