#include "physics/integrate/integrator.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"
#include "physics/integrate/smooth_system.hpp"

namespace lantern::physics {

// Each is in the file of its method.
extern const Integration kExplicitEuler, kSemiImplicitEuler, kVelocityVerlet, kRungeKutta4,
    kImplicitMidpoint, kImplicitEuler;

namespace {

MethodList<Integrator, Integration>& methods() {
  static MethodList<Integrator, Integration> list = {&kExplicitEuler,    &kSemiImplicitEuler,
                                                     &kVelocityVerlet,   &kRungeKutta4,
                                                     &kImplicitMidpoint, &kImplicitEuler};
  return list;
}

// Those of the dynamic bodies, each once; the world's own if there are none.
template <int D>
std::vector<Integrator> integrators_of(const WorldConfig<D>& config,
                                       std::span<const Body<D>> bodies) {
  std::vector<Integrator> used;
  for (const Body<D>& body : bodies) {
    if (body.kind != BodyKind::dynamic_body) continue;
    const Integrator its = body.integrator.value_or(config.integrator);
    if (std::find(used.begin(), used.end(), its) == used.end()) used.push_back(its);
  }
  if (used.empty()) used.push_back(config.integrator);
  return used;
}

template <int D>
void find_increments_in_step(Integrator integrator, std::span<const Body<D>> bodies,
                             const Forces<D>& forces, double h, std::vector<Increment<D>>& out,
                             WorldWork& work) {
  try {
    find_increments(integrator, bodies, forces, h, out, work.force_evaluations);
  } catch (const Refused& refused) {
    throw Refused(fmt::format("{} in step {}", refused.what(), work.steps + 1));
  }
}

// Whether there is a force, and a body that it could move.
template <int D>
bool any_force(std::span<const Body<D>> bodies, const Forces<D>& forces) {
  const bool on_any = forces.gravity != Vec<D>(0.0) || forces.gravitation > 0 ||
                      !forces.springs.empty() || !forces.pushes.empty();
  return std::any_of(bodies.begin(), bodies.end(), [&](const Body<D>& body) {
    if (!body.is_pushed()) return false;
    return on_any || body.linear_drag > 0 || body.angular_drag > 0;
  });
}

}  // namespace

const Integration& integration(Integrator integrator) { return methods()[integrator]; }
Integrator add_integrator(const Integration& method) { return methods().add(method); }
std::string_view to_string(Integrator integrator) { return integration(integrator).name; }
std::optional<Integrator> integrator_named(std::string_view name) { return methods().named(name); }
std::vector<std::string_view> integrator_names() { return methods().names(); }

template <int D>
void find_increments(Integrator integrator, std::span<const Body<D>> bodies,
                     const Forces<D>& forces, double h, std::vector<Increment<D>>& out,
                     std::uint64_t& evaluations) {
  if (!std::isfinite(h) || !(h > 0)) throw Refused(fmt::format("time step {} is not allowed", h));
  SmoothSystem<D> system(bodies, forces, evaluations);
  out.assign(bodies.size(), Increment<D>{});
  integration(integrator).increments.in<D>()(system, h, out);
}

template <int D>
void find_increments_if_any(const WorldConfig<D>& config, std::span<const Body<D>> bodies,
                            const Forces<D>& forces, double h, std::vector<Increment<D>>& out,
                            WorldWork& work) {
  if (!any_force(bodies, forces)) {
    out.assign(bodies.size(), {});
    return;
  }
  const std::vector<Integrator> used = integrators_of(config, bodies);
  if (used.size() == 1) {
    find_increments_in_step<D>(used[0], bodies, forces, h, out, work);
    return;
  }
  // No spring ties bodies of different methods (World::add_spring), so those of one method are all
  // that it needs to know: the others stand still meanwhile, as if they slept.
  out.assign(bodies.size(), {});
  std::vector<Increment<D>> some;
  for (const Integrator integrator : used) {
    std::vector<Body<D>> its(bodies.begin(), bodies.end());
    for (Body<D>& body : its)
      if (body.kind == BodyKind::dynamic_body &&
          body.integrator.value_or(config.integrator) != integrator)
        body.asleep = true;
    find_increments_in_step<D>(integrator, its, forces, h, some, work);
    for (std::size_t i = 0; i < its.size(); ++i)
      if (its[i].kind == BodyKind::dynamic_body && !its[i].asleep) out[i] = some[i];
  }
}

#define LANTERN_INSTANTIATE(D)                                                                  \
  template void find_increments(Integrator, std::span<const Body<D>>, const Forces<D>&, double, \
                                std::vector<Increment<D>>&, std::uint64_t&);                    \
  template void find_increments_if_any(const WorldConfig<D>&, std::span<const Body<D>>,         \
                                       const Forces<D>&, double, std::vector<Increment<D>>&,    \
                                       WorldWork&);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern::physics
