#include "physics/joint/constrained_motion.hpp"

#include <array>
#include <optional>
#include <utility>

#include "physics/forces.hpp"

namespace lantern::physics {
namespace {

// That of all bodies that forces move; nothing if there are several.
template <int D>
std::optional<Integrator> common_integrator(const Island<D>& island, const WorldConfig<D>& config) {
  std::optional<Integrator> common;
  for (const Body<D>& body : island.bodies) {
    if (!body.is_pushed()) continue;
    const Integrator its = body.integrator.value_or(config.integrator);
    if (common && *common != its) return std::nullopt;
    common = its;
  }
  return common;
}

// One part of a step, on the island's own bodies.
template <int D>
class PartMotion {
 public:
  PartMotion(const IslandMove<D>& move, double h)
      : island_(move.island), config_(move.config), h_(h), work_(move.work) {}

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
    const Integration& method = integration(integrator);
    const bool moved = method.with_joints.in<D>()(part);
    swing_ = part.swing;
    if (!moved) return false;
    end();
    return method.gains_energy || is_driven() || !has_gained(before);
  }
  double swing() const { return swing_; }

  void add_impulses(Scratch<Vec<D>>& sums) const {
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
  SmoothSystem<D> system_{island_.bodies, island_.forces, work_.force_evaluations};
  JointSystem<D> joints_{system_, island_.joints, work_};
  SmoothState<D> state_ = system_.start();
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

enum class MoveOutcome { moved, unsuited, failed };

// Into how many parts bodies that turn fast cut the step.
template <int D>
double parts_of_turning(const Island<D>& island, double h) {
  double fastest = 0;
  for (const Body<D>& body : island.bodies) {
    if (!body.is_pushed() || turns_alike(body)) continue;
    const Spin<D> spin = angular_velocity(body);
    fastest = std::max(fastest, std::sqrt(dot(spin, spin)));
  }
  return std::max(1.0, std::ceil(h * fastest / kJointSettings.most_turn));
}

// If the island is not moved, its bodies are as they were, but brought together and their
// velocities projected.
template <int D>
MoveOutcome try_to_move(const IslandMove<D>& move, Attempt attempt) {
  Island<D>& island = move.island;
  const double h = move.h, turning = parts_of_turning(island, h);
  if (turning > kJointSettings.most_parts) return MoveOutcome::failed;
  attempt.parts = static_cast<int>(turning);
  const Scratch<Body<D>> start = island.bodies;
  Scratch<Vec<D>> impulses;
  for (double swing = 0;; island.bodies = start) {
    impulses.assign(island.joints.size(), Vec<D>(0.0));
    int moved = 0;
    for (; moved < attempt.parts; ++moved) {
      PartMotion<D> part(move, h / attempt.parts);
      if (!part.is_suited()) {
        if (moved == 0) return MoveOutcome::unsuited;
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
      return MoveOutcome::failed;
    }
  }
  if (attempt.parts > 1) move.work.sub_steps += static_cast<std::uint64_t>(attempt.parts);
  for (std::size_t i = 0; i < impulses.size(); ++i) island.joints[i].impulse = impulses[i];
  return MoveOutcome::moved;
}

// Runge-Kutta on accelerations that satisfy the joints. An orientation is the start's, turned by a
// rotation vector u, whose rate follows from the angular velocity w (Munthe-Kaas):
//
//   du/dt = w - u x w / 2 + u x (u x w) / 12 + ...
//
// of which order 4 needs no more. What the method leaves undone of the joints, of its own order, is
// projected out along their impulses, of the places first and then of the velocities.

// A method each of whose looks is from where the one before leads.
struct Tableau {
  int looks;
  std::array<double, 4> way;     // to the next look, of h
  std::array<double, 4> weight;  // in the sum
};
constexpr Tableau kEuler{1, {}, {1}};
constexpr Tableau kClassical{4, {0.5, 0.5, 1}, {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6}};

double rotation_rate(double, double spin) { return spin; }
Vec<3> rotation_rate(const Vec<3>& u, const Vec<3>& spin) {
  const Vec<3> once = glm::cross(u, spin);
  return spin - once * 0.5 + glm::cross(u, once) / 12.0;
}

template <int D>
class RungeKutta {
 public:
  RungeKutta(ConstrainedPart<D>& part, const Tableau& tableau) : part_(part), tableau_(tableau) {}

  bool run() {
    for (int look = 0; look < tableau_.looks; ++look) {
      if (look > 0) {
        go(slopes_, tableau_.way[look - 1] * h_);
        joints_.look(state_);
        if (!joints_.factor()) return false;
      }
      find_slopes(tableau_.weight[look]);
      if (look == 0 &&
          !(h_ * h_ * joints_.swing_squared(joints_.last(), 1) <= kJointSettings.most_swing))
        return false;
    }
    go(sums_, h_);
    if (!joints_.close_gaps(state_)) return false;
    joints_.look(state_);
    return joints_.stop_parting(state_, true);
  }

 private:
  struct Slope {
    Vec<D> velocity{0.0}, acceleration{0.0};
    Spin<D> turning{0.0}, torque{0.0};
    Spin<D> turned{0.0};  // the rotation vector at which it was taken
  };

  void find_slopes(double weight) {
    pull_ = system_.evaluate(state_);
    joints_.hold_accelerations(state_, pull_, weight * h_);
    for (std::size_t n = 0; n < slopes_.size(); ++n) {
      const std::size_t i = system_.movers()[n];
      Slope& slope = slopes_[n];
      slope.velocity = system_.velocity(state_, i);
      slope.acceleration = pull_.acceleration[i];
      Slope& sum = sums_[n];
      sum.velocity += slope.velocity * weight;
      sum.acceleration += slope.acceleration * weight;
      if (!system_.turns(i)) continue;
      slope.turning = rotation_rate(slope.turned, system_.angular_velocity(state_, i));
      slope.torque = pull_.torque[i];
      sum.turning += slope.turning * weight;
      sum.torque += slope.torque * weight;
    }
  }

  // To where the slopes lead from the start.
  void go(Scratch<Slope>& slopes, double time) {
    const std::span<const Body<D>> bodies = system_.bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (bodies[i].kind != BodyKind::kinematic_body) continue;
      state_.shift[i] = time * bodies[i].velocity;
      state_.orientation[i] =
          turned(bodies[i].orientation, Spin<D>(bodies[i].kinematic_spin * time));
    }
    for (std::size_t n = 0; n < slopes.size(); ++n) {
      const std::size_t i = system_.movers()[n];
      state_.shift[i] = time * slopes[n].velocity;
      state_.kick[i] = time * slopes[n].acceleration;
      if (!system_.turns(i)) continue;
      slopes[n].turned = time * slopes[n].turning;
      state_.twist[i] = time * slopes[n].torque;
      state_.orientation[i] = turned(bodies[i].orientation, slopes[n].turned);
    }
  }

  ConstrainedPart<D>& part_;
  SmoothSystem<D>& system_ = part_.system;
  JointSystem<D>& joints_ = part_.joints;
  SmoothState<D>& state_ = part_.state;
  const double h_ = part_.h;
  const Tableau& tableau_;
  Pull<D> pull_;
  Scratch<Slope> slopes_{system_.movers().size()}, sums_ = slopes_;  // one a mover
};

}  // namespace

template <int D>
bool move_constrained(const IslandMove<D>& move) {
  Island<D>& island = move.island;
  const std::optional<Integrator> integrator = common_integrator(island, move.config);
  if (!integrator || integration(*integrator).with_joints.in<D>() == nullptr) return false;
  bool waits = false;
  for (JointRows<D>& rows : island.joints) waits |= rows.backoff.waits();
  if (waits) return false;
  const MoveOutcome outcome = try_to_move(move, Attempt{*integrator});
  for (JointRows<D>& rows : island.joints) {
    if (outcome == MoveOutcome::moved) rows.backoff = {};
    if (outcome == MoveOutcome::failed) rows.backoff.fail();
  }
  return outcome == MoveOutcome::moved;
}

template <int D>
bool constrained_explicit_euler(ConstrainedPart<D>& part) {
  return RungeKutta<D>(part, kEuler).run();
}

template <int D>
bool constrained_runge_kutta_4(ConstrainedPart<D>& part) {
  return RungeKutta<D>(part, kClassical).run();
}

// Half a kick along the joints, fly, half a kick: RATTLE, velocity Verlet with joints. Symplectic
// and the same backwards in time, with free rotation as with free flight.
template <int D>
bool constrained_verlet(ConstrainedPart<D>& part) {
  SmoothSystem<D>& system = part.system;
  JointSystem<D>& joints = part.joints;
  SmoothState<D>& state = part.state;
  const double h = part.h;
  Pull<D> pull = system.evaluate(state);
  system.kick(state, pull, h / 2);
  // If it fails, an estimate of the tension is there all the same.
  const bool held = joints.hold_at_end(state, h);
  // Half of the drag is explicit, half implicit: more than twice the velocity would turn it round.
  const double drag = system.fastest_drag() / 2;
  const double swing_squared = joints.swing_squared(joints.impulses(), h / 2);
  if (!part.follows(std::max(swing_squared, drag * drag)) || !held) return false;
  joints.look(state);
  if (!joints.factor()) return false;
  if (system.any_damping()) return constrained_damped_kick(part, h / 2);
  pull = system.evaluate(state);
  for (const std::size_t i : system.movers()) {
    state.kick[i] += h / 2 * pull.acceleration[i];
    state.twist[i] += h / 2 * pull.torque[i];
  }
  return joints.stop_parting(state, true);
}

#define LANTERN_INSTANTIATE(D)                                   \
  template bool move_constrained(const IslandMove<D>&);          \
  template bool constrained_explicit_euler(ConstrainedPart<D>&); \
  template bool constrained_runge_kutta_4(ConstrainedPart<D>&);  \
  template bool constrained_verlet(ConstrainedPart<D>&);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern::physics
