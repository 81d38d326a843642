#include "measure/energy_trial.hpp"

#include <algorithm>
#include <limits>

#include "base/error.hpp"
#include "physics/forces.hpp"

namespace lantern::measure {
namespace {

constexpr double kAtRest = 1e-3;  // units a second: slower than this counts as this

template <int D>
double moving_mass(const World<D>& world) {
  double mass = 0;
  for (const Body<D>& body : world.bodies())
    if (body.inverse_mass > 0) mass += 1 / body.inverse_mass;
  return mass;
}

// Joules that raise everything by `depth`.
template <int D>
double lifted_by(const World<D>& world, double depth) {
  double force = glm::length(world.forces().gravity) * moving_mass(world);
  for (const Push<D>& push : world.forces().pushes) force += glm::length(push.force);
  return force * depth;
}

template <int D>
bool pass_through(const World<D>& world, BodyId a, BodyId b) {
  return std::ranges::any_of(world.joints(), [&](const auto& entry) {
    const Joint<D>& joint = entry.second;
    return !joint.collide && ((joint.a == a && joint.b == b) || (joint.a == b && joint.b == a));
  });
}

}  // namespace

template <int D>
double overlap_between(const Body<D>& a, const Body<D>& b) {
  const auto manifold = collide<D>(placed(a), placed(b), 0.0);
  double depth = 0;
  if (manifold)
    for (const ManifoldPoint<D>& point : manifold->points())
      depth = std::max(depth, -point.separation);
  return depth;
}

template <int D>
double overlap_of(const World<D>& world) {
  const auto& bodies = world.bodies();
  double depth = 0;
  for (std::size_t j = 0; j < bodies.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const Body<D>&a = bodies[i], &b = bodies[j];
      const bool meet = a.collides && b.collides && (a.moves() || b.moves());
      if (meet && !pass_through(world, a.id, b.id)) depth += overlap_between(a, b);
    }
  return depth;
}

template <int D>
EnergyTrial follow_energy(World<D>& world, double step, int steps, const WatchEnergy& watch) {
  EnergyTrial trial{-std::numeric_limits<double>::infinity(), 0, {}};
  const auto look = [&](EnergyMoment& moment) {
    const Energy now = energy<D>(world.bodies(), world.forces());
    moment.time = world.time();
    moment.energy = now.total();
    for (const Push<D>& push : world.forces().pushes)
      moment.energy -= glm::dot(push.force, world.find(push.body)->position);
    moment.kinetic = std::max(moment.kinetic, now.kinetic());
  };
  EnergyMoment moment;
  moment.kinetic = moving_mass(world) * kAtRest * kAtRest / 2;
  look(moment);
  moment.permitted = moment.energy + lifted_by(world, overlap_of(world));
  try {
    for (int i = 0; i <= steps; ++i) {
      if (i > 0) {
        world.step(step);
        look(moment);
      }
      if (watch) watch(moment);
      if (moment.excess() > trial.excess) trial = {moment.excess(), moment.time, {}};
    }
  } catch (const Refused& refused) {
    trial = {std::numeric_limits<double>::infinity(), world.time(), refused.what()};
  }
  return trial;
}

template double overlap_between(const Body<2>&, const Body<2>&);
template double overlap_between(const Body<3>&, const Body<3>&);
template double overlap_of(const World<2>&);
template double overlap_of(const World<3>&);
template EnergyTrial follow_energy(World<2>&, double, int, const WatchEnergy&);
template EnergyTrial follow_energy(World<3>&, double, int, const WatchEnergy&);

}  // namespace lantern::measure
