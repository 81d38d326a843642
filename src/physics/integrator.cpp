#include "physics/integrator.hpp"

#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "physics/smooth_system.hpp"

namespace lantern {
namespace {

constexpr std::array<std::pair<Integrator, std::string_view>, 6> kNames{{
    {Integrator::explicit_euler, "explicit_euler"},
    {Integrator::semi_implicit_euler, "semi_implicit_euler"},
    {Integrator::velocity_verlet, "velocity_verlet"},
    {Integrator::runge_kutta_4, "runge_kutta_4"},
    {Integrator::implicit_midpoint, "implicit_midpoint"},
    {Integrator::implicit_euler, "implicit_euler"},
}};

}  // namespace

std::string_view to_string(Integrator integrator) {
  for (const auto& [value, name] : kNames)
    if (value == integrator) return name;
  return "?";
}

std::optional<Integrator> integrator_named(std::string_view name) {
  for (const auto& [value, known] : kNames)
    if (known == name) return value;
  return std::nullopt;
}

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
