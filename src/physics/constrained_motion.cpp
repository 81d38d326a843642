#include "physics/constrained_motion.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "physics/free_rotation.hpp"

namespace lantern::physics {
namespace {

// That of all bodies that forces move; nothing if there are several.
template <int D>
std::optional<Integrator> common_integrator(const Island<D>& island, const WorldConfig<D>& config) {
  std::optional<Integrator> common;
  for (const Body<D>& body : island.bodies) {
    if (body.kind != BodyKind::dynamic_body || body.asleep) continue;
    const Integrator its = body.integrator.value_or(config.integrator);
    if (common && *common != its) return std::nullopt;
    common = its;
  }
  return common;
}

template <int D>
bool advance(ConstrainedPart<D>& part, Integrator integrator) {
  switch (integrator) {
    case Integrator::semi_implicit_euler:
    case Integrator::velocity_verlet:
      return constrained_splitting(part, integrator);
    case Integrator::explicit_euler:
    case Integrator::runge_kutta_4:
      return constrained_runge_kutta(part, integrator);
    case Integrator::implicit_midpoint:
    case Integrator::implicit_euler:
      return constrained_implicit(part, integrator);
  }
  return false;
}

// One part of a step, on the island's own bodies.
template <int D>
class Part {
 public:
  Part(Island<D>& island, const WorldConfig<D>& config, double h, WorldWork& work)
      : island_(island),
        config_(config),
        h_(h),
        work_(work),
        system_(island.bodies, island.forces, work.force_evaluations),
        joints_(system_, island.joints, work),
        state_(system_.start()) {}

  // False, perhaps with the bodies at another start, if it does not converge.
  bool move(Integrator integrator) {
    if (!joints_.can_be_solved() || joints_.rows().empty() || !begin()) return false;
    ConstrainedPart<D> part{system_, joints_, state_, h_};
    if (!advance(part, integrator)) return false;
    end();
    return true;
  }

  void add_impulses(std::vector<Vec<D>>& sums) const {
    for (const auto& hold : joints_.holds())
      sums[static_cast<std::size_t>(hold.joint - island_.joints.data())] += joints_.impulse(hold);
  }

 private:
  // Bodies are where the joints hold, and move as they let them.
  bool begin() {
    const double gap = joints_.find_errors(state_);
    if (joints_.wide_open(h_)) return false;
    joints_.look(state_);
    if (!joints_.factor()) return false;
    if (gap > 1) {
      if (!joints_.close_gaps(state_)) return false;
      adopt_places();
      joints_.look(state_);
      if (!joints_.factor()) return false;
    }
    if (!joints_.stop_parting(state_, false)) return false;
    for (const std::size_t i : system_.movers()) adopt_velocities(i);
    return true;
  }

  void adopt_places() {
    for (const std::size_t i : system_.movers()) {
      island_.bodies[i].position += std::exchange(state_.shift[i], Vec<D>(0.0));
      if (system_.turns(i)) island_.bodies[i].orientation = state_.orientation[i];
    }
  }

  void adopt_velocities(std::size_t i) {
    island_.bodies[i].velocity += std::exchange(state_.kick[i], Vec<D>(0.0));
    island_.bodies[i].angular_momentum += std::exchange(state_.twist[i], Spin<D>(0.0));
  }

  void end() {
    for (std::size_t i = 0; i < island_.bodies.size(); ++i) {
      Body<D>& body = island_.bodies[i];
      if (!system_.moves(i)) {
        fly(body, {}, h_, config_.rotation, work_);
        continue;
      }
      body.position += state_.shift[i];
      adopt_velocities(i);
      if (body.inverse_inertia == Spin<D>(0.0)) continue;
      if (system_.turns(i))
        body.orientation = state_.orientation[i];
      else if (body.angular_momentum != Spin<D>(0.0))
        turn_freely(body, h_, body.rotation.value_or(config_.rotation));
      else
        continue;
      ++work_.rotations_integrated;
    }
  }

  Island<D>& island_;
  const WorldConfig<D>& config_;
  double h_;
  WorldWork& work_;
  SmoothSystem<D> system_;
  JointSystem<D> joints_;
  SmoothState<D> state_;
};

}  // namespace

template <int D>
bool move_constrained(Island<D>& island, const WorldConfig<D>& config, double h, WorldWork& work) {
  const std::optional<Integrator> integrator = common_integrator(island, config);
  if (!integrator) return false;
  const std::vector<Body<D>> start = island.bodies;
  std::vector<Vec<D>> impulses;
  for (int parts = 1; parts <= kJointSettings.most_parts; parts *= 2) {
    impulses.assign(island.joints.size(), Vec<D>(0.0));
    bool moved = true;
    for (int i = 0; moved && i < parts; ++i) {
      Part<D> part(island, config, h / parts, work);
      moved = part.move(*integrator);
      if (moved) part.add_impulses(impulses);
    }
    if (moved) {
      if (parts > 1) work.sub_steps += static_cast<std::uint64_t>(parts);
      for (std::size_t i = 0; i < impulses.size(); ++i) island.joints[i].impulse = impulses[i];
      return true;
    }
    island.bodies = start;
  }
  return false;
}

template bool move_constrained(Island<2>&, const WorldConfig<2>&, double, WorldWork&);
template bool move_constrained(Island<3>&, const WorldConfig<3>&, double, WorldWork&);

}  // namespace lantern::physics
