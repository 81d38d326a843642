#include "physics/constrained_motion.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "physics/energy.hpp"
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
    case Integrator::velocity_verlet:
      return constrained_verlet(part);
    case Integrator::explicit_euler:
    case Integrator::runge_kutta_4:
      return constrained_runge_kutta(part, integrator);
    case Integrator::implicit_midpoint:
    case Integrator::implicit_euler:
      return constrained_implicit(part, integrator);
    case Integrator::semi_implicit_euler:
      break;  // see constrained_motion.hpp
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

  // Whether the joints can be solved here at all.
  bool is_suited() {
    gap_ = joints_.find_errors(state_);
    return joints_.can_be_solved() && !joints_.rows().empty() && !joints_.wide_open(h_);
  }

  // False, perhaps with the bodies at another start, if it does not converge. After `is_suited`.
  bool move(Integrator integrator) {
    if (!begin()) return false;
    ConstrainedPart<D> part{system_, joints_, state_, h_};
    const Energy before = energy<D>(island_.bodies, island_.forces);
    const bool moved = advance(part, integrator);
    swing_ = part.swing;
    if (!moved) return false;
    end();
    return integrator == Integrator::explicit_euler || is_driven() || !has_gained(before);
  }
  double swing() const { return swing_; }

  void add_impulses(std::vector<Vec<D>>& sums) const {
    for (const auto& hold : joints_.holds())
      sums[static_cast<std::size_t>(hold.joint - island_.joints.data())] += joints_.impulse(hold);
  }

 private:
  // Bodies are where the joints hold, and move as they let them.
  bool begin() {
    joints_.look(state_);
    if (!joints_.factor()) return false;
    if (gap_ > 1) {
      if (!joints_.close_gaps(state_)) return false;
      adopt_places();
      joints_.look(state_);
      if (!joints_.factor()) return false;
    }
    if (!joints_.stop_parting(state_, false)) return false;
    for (const std::size_t i : system_.movers()) adopt_velocities(i);
    return true;
  }

  // Whether anything does work on the island but its own forces.
  bool is_driven() const {
    return !island_.forces.pushes.empty() ||
           std::ranges::any_of(island_.bodies, [](const Body<D>& body) {
             return body.kind == BodyKind::kinematic_body;
           });
  }
  bool has_gained(const Energy& before) const {
    const Energy after = energy<D>(island_.bodies, island_.forces);
    return after.total() - before.total() > kJointSettings.most_gain * after.kinetic();
  }

  void adopt_places() {
    for (const std::size_t i : system_.movers()) {
      Body<D>& body = island_.bodies[i];
      body.position += std::exchange(state_.shift[i], Vec<D>(0.0));
      if (!system_.turns(i)) continue;
      if constexpr (D == 3)  // else its energy would not stay
        if (!turns_alike(body))
          body.angular_momentum = state_.orientation[i].q *
                                  (glm::conjugate(body.orientation.q) * body.angular_momentum);
      body.orientation = state_.orientation[i];
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
  double gap_ = 0, swing_ = 0;
};

// How a step is tried.
struct Attempt {
  Integrator integrator;
  int parts = 1;

  // The next one, after it has failed with bodies that swing so fast; false if there is none.
  bool go_on(double h, double swing) {
    const double needed = std::ceil(h * swing / kJointSettings.most_swing);
    const bool swings = needed > parts;  // with some more, for it may yet swing faster
    const double next = swings ? std::ceil(1.25 * needed) : 4 * parts;
    if (next <= kJointSettings.most_parts) {
      parts = static_cast<int>(next);
      return true;
    }
    parts = 1;
    const bool implicit = integrator == Integrator::implicit_midpoint;
    if (integrator == Integrator::implicit_euler) return false;
    integrator = implicit ? Integrator::implicit_euler : Integrator::implicit_midpoint;
    return true;
  }
};

enum class Outcome { moved, unsuited, failed };

// Into how many parts bodies that turn fast cut the step.
template <int D>
double parts_of_turning(const Island<D>& island, double h) {
  double fastest = 0;
  for (const Body<D>& body : island.bodies) {
    if (body.kind != BodyKind::dynamic_body || body.asleep || turns_alike(body)) continue;
    const Spin<D> spin = angular_velocity(body);
    fastest = std::max(fastest, std::sqrt(dot(spin, spin)));
  }
  return std::max(1.0, std::ceil(h * fastest / kJointSettings.most_turn));
}

// If the island is not moved, its bodies are as they were, but brought together and their
// velocities projected.
template <int D>
Outcome try_to_move(Island<D>& island, const WorldConfig<D>& config, Attempt attempt, double h,
                    WorldWork& work) {
  const double turning = parts_of_turning(island, h);
  if (turning > kJointSettings.most_parts) return Outcome::failed;
  attempt.parts = static_cast<int>(turning);
  const std::vector<Body<D>> start = island.bodies;
  std::vector<Vec<D>> impulses;
  for (double swing = 0;; island.bodies = start) {
    impulses.assign(island.joints.size(), Vec<D>(0.0));
    int moved = 0;
    for (; moved < attempt.parts; ++moved) {
      Part<D> part(island, config, h / attempt.parts, work);
      if (!part.is_suited()) {
        if (moved == 0) return Outcome::unsuited;
        break;
      }
      const bool good = part.move(attempt.integrator);
      swing = part.swing();
      if (!good) break;
      part.add_impulses(impulses);
    }
    if (moved == attempt.parts) break;
    if (!attempt.go_on(h, swing)) {
      island.bodies = start;
      return Outcome::failed;
    }
  }
  if (attempt.parts > 1) work.sub_steps += static_cast<std::uint64_t>(attempt.parts);
  for (std::size_t i = 0; i < impulses.size(); ++i) island.joints[i].impulse = impulses[i];
  return Outcome::moved;
}

}  // namespace

template <int D>
bool move_constrained(Island<D>& island, const WorldConfig<D>& config, double h, WorldWork& work) {
  const std::optional<Integrator> integrator = common_integrator(island, config);
  if (!integrator || *integrator == Integrator::semi_implicit_euler) return false;
  bool waits = false;
  for (JointRows<D>& rows : island.joints) waits |= rows.backoff.waits();
  if (waits) return false;
  const Outcome outcome = try_to_move(island, config, Attempt{*integrator}, h, work);
  for (JointRows<D>& rows : island.joints) {
    if (outcome == Outcome::moved) rows.backoff = {};
    if (outcome == Outcome::failed) rows.backoff.fail();
  }
  return outcome == Outcome::moved;
}

template bool move_constrained(Island<2>&, const WorldConfig<2>&, double, WorldWork&);
template bool move_constrained(Island<3>&, const WorldConfig<3>&, double, WorldWork&);

}  // namespace lantern::physics
