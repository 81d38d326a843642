// Bodies under forces alone: their state as solver bodies, what their motion would be, and so how
// they fly where nothing touches them.
#include <algorithm>

#include <fmt/format.h>

#include "base/error.hpp"
#include "physics/free_rotation.hpp"
#include "physics/island.hpp"

namespace lantern::physics {
namespace {

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
    if (body.kind != BodyKind::dynamic_body || body.asleep) return false;
    return on_any || body.linear_drag > 0 || body.angular_drag > 0;
  });
}

}  // namespace

template <int D>
SolverBody<D> solver_body_of(const Body<D>& body) {
  SolverBody<D> solved;
  solved.velocity = body.moves() ? body.velocity : Vec<D>(0.0);
  if (body.asleep) solved.velocity = Vec<D>(0.0);
  if (turns<D>(body.shape) && body.moves()) solved.spin = angular_velocity(body);
  if (body.kind != BodyKind::dynamic_body || body.asleep) return solved;
  solved.inverse_mass = body.inverse_mass;
  if (body.inverse_inertia != Spin<D>(0.0)) solved.inverse_inertia = world_inverse_inertia(body);
  return solved;
}

template <int D>
void fly(Body<D>& body, const Increment<D>& increment, double h, RotationMethod worlds,
         WorldWork& work) {
  if (!body.moves() || body.asleep) return;
  if (increment.kick != Vec<D>(0.0)) body.velocity += increment.kick;
  body.position += body.velocity * h;
  if (increment.drift != Vec<D>(0.0)) body.position += increment.drift;
  body.angular_momentum += increment.twist;
  const Spin<D> turning = body.kind == BodyKind::kinematic_body
                              ? body.kinematic_spin
                              : body.angular_momentum + increment.lag;
  if (turning == Spin<D>(0.0)) return;
  if (body.kind == BodyKind::dynamic_body && body.inverse_inertia == Spin<D>(0.0)) return;
  turn_freely(body, h, body.rotation.value_or(worlds), increment.lag);
  ++work.rotations_integrated;
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

#define LANTERN_INSTANTIATE(D)                                                               \
  template SolverBody<D> solver_body_of(const Body<D>&);                                     \
  template void fly(Body<D>&, const Increment<D>&, double, RotationMethod, WorldWork&);      \
  template void find_increments_if_any(const WorldConfig<D>&, std::span<const Body<D>>,      \
                                       const Forces<D>&, double, std::vector<Increment<D>>&, \
                                       WorldWork&);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern::physics
