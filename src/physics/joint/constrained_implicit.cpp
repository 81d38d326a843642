// Forces and joints solved together, by Newton's method on the velocities of a stage and the
// impulses p of the joints:
//
//   A dv - J^T dp = momentum that is missing     A: the matrix of an implicit step
//   J dv          = velocity that is missing     (implicit_stage.hpp)
//
// by the Schur complement J A^-1 J^T, which is full. Joints push along their lines at the stage, as
// springs do there: so a stiff spring beside a rod leaves nothing that would turn it. What their
// tension gives for a turn of these lines is part of A.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/scratch.hpp"
#include "physics/integrate/implicit_stage.hpp"
#include "physics/joint/constrained_motion.hpp"

namespace lantern::physics {
namespace {

// Of the fastest speed: so small a change of any velocity ends the rounds; after many, the second.
constexpr double kChange = 1e-14, kSmallChange = 1e-7;
constexpr double kGoodChange = 1e-3;  // after some rounds; else they lead nowhere
constexpr int kFewRounds = 12, kSomeRounds = 20;
// Stiffnesses along the joints, in units of their tension by size.
constexpr double kOutweighs[] = {64, 64e3, 64e6};

template <int D, int B>
class ImplicitStage {
 public:
  using Row = std::array<double, B>;

  ImplicitStage(ConstrainedPart<D>& part, double time) : part_(part), time_(time) {
    for (std::size_t i = 0; i < joints_.rows().size(); ++i) schur_.add_line(0);
  }

  // Velocities of the stage, `time` after the start, so that the joints hold after the whole step.
  bool run() {
    end_ = state_;
    Scratch<Row> momenta(system_.movers().size());
    double last = 0;
    for (int round = 0; round < kJointSettings.most_rounds; ++round) {
      system_.fly(state_, state_, time_);
      const Pull<D> pull = system_.evaluate(state_);
      joints_.look(state_);
      find_missing(pull, momenta);
      system_.fly(end_, state_, h_);
      joints_.find_errors(end_);
      Scratch<double> wanted = joints_.errors();
      for (double& value : wanted) value /= h_;
      if (!solve(momenta, std::move(wanted), time_ * time_)) return false;
      const double change = apply(momenta);
      if (!std::isfinite(change)) return false;
      if (change <= kChange) return true;
      if (round >= kSomeRounds && change >= kGoodChange) return false;
      if (round >= kFewRounds && change <= kSmallChange && change >= last / 2) return true;
      last = change;
    }
    return false;
  }

  // One solution with places as they are.
  bool kick() {
    const Pull<D> pull = system_.evaluate(state_);
    Scratch<Row> momenta(system_.movers().size());
    for (std::size_t n = 0; n < momenta.size(); ++n) {
      const std::size_t i = system_.movers()[n];
      add(momenta[n], pull.acceleration[i] / system_.bodies()[i].inverse_mass, pull.torque[i],
          time_);
    }
    Scratch<double> wanted = joints_.speeds(state_);
    for (double& value : wanted) value = -value;
    if (!solve(momenta, std::move(wanted), 0)) return false;
    return std::isfinite(apply(momenta));
  }

 private:
  static Scratch<Tie<D>> ties_of(const JointSystem<D>& joints) {
    Scratch<Tie<D>> ties;
    for (const auto& hold : joints.holds()) ties.push_back({{hold.joint->a, hold.joint->b}, {}});
    return ties;
  }

  // row += by * (direction, turn)
  static void add(Row& row, const Vec<D>& direction, const Spin<D>& turn, double by) {
    for (int c = 0; c < D; ++c) row[c] += by * direction[c];
    for (int c = D; c < B; ++c) row[c] += by * spin_component(turn, c - D);
  }

  static double along(const Row& row, const Vec<D>& direction, const Spin<D>& turn) {
    double sum = 0;
    for (int c = 0; c < D; ++c) sum += row[c] * direction[c];
    for (int c = D; c < B; ++c) sum += row[c] * spin_component(turn, c - D);
    return sum;
  }

  // Adds J^T of one row.
  void add_impulse(Scratch<Row>& momenta, std::size_t r, double impulse) const {
    const auto& row = joints_.rows()[r];
    const auto add_to = [&](std::uint32_t i, const Spin<D>& turn, double by) {
      if (system_.moves(i))
        add(momenta[system_.number(i)], row.direction, system_.turns(i) ? turn : Spin<D>(0.0), by);
    };
    add_to(row.a, row.turn_a, -impulse);
    add_to(row.b, row.turn_b, impulse);
  }

  double speed(const Scratch<Row>& velocities, std::size_t r) const {
    const auto& row = joints_.rows()[r];
    const auto of = [&](std::uint32_t i, const Spin<D>& turn) {
      if (!system_.moves(i)) return 0.0;
      return along(velocities[system_.number(i)], row.direction,
                   system_.turns(i) ? turn : Spin<D>(0.0));
    };
    return of(row.b, row.turn_b) - of(row.a, row.turn_a);
  }

  void find_missing(const Pull<D>& pull, Scratch<Row>& momenta) const {
    for (std::size_t n = 0; n < momenta.size(); ++n) {
      const std::size_t i = system_.movers()[n];
      const double mass = 1 / system_.bodies()[i].inverse_mass;
      momenta[n] = {};
      add(momenta[n], mass * (time_ * pull.acceleration[i] - state_.kick[i]),
          time_ * pull.torque[i] - state_.twist[i], 1);
    }
    for (std::size_t r = 0; r < joints_.rows().size(); ++r)
      add_impulse(momenta, r, joints_.impulses()[r]);
  }

  // The joints' forces at the stage, as springs that are stiff across only. They are made stiff
  // along, too, if the matrix has no factor else (springs that are compressed beside a rod): since
  // joints keep these lengths in any case, the solution is the same.
  void tie(double stiffness) {
    for (std::size_t j = 0; j < ties_.size(); ++j) {
      const auto& hold = joints_.holds()[j];
      Stretch<D>& s = ties_[j].stretch;
      const Vec<D> force = joints_.impulse(hold) / time_;
      s.arm_a = hold.arm_a;
      s.arm_b = hold.arm_b;
      const double size = glm::length(force);
      s.stiffness = stiffness;
      if (hold.width == 1) {
        s.direction = joints_.rows()[hold.first].direction;
        s.length = hold.length;
        s.tension = -glm::dot(force, s.direction);
      } else {
        s.direction = size > 0 ? force / size : force;
        s.tension = -size;
      }
    }
  }

  // Of the joints, by their size: a stiffness.
  double largest_tension() const {
    return greatest_of<double>(0, joints_.holds(), [&](const auto& hold) {
      return glm::length(joints_.impulse(hold)) / (time_ * hold.size);
    });
  }

  // A factor of the matrix; the stiffness along the joints, as it counts in it.
  std::optional<double> factor_matrix(double time_squared) {
    const auto attempt = [&](double stiffness, bool buckling, double heavier) {
      tie(stiffness);
      return matrix_.factor(state_, time_squared, time_, buckling, heavier);
    };
    if (attempt(0, true, 1)) return 0;
    const double tension = largest_tension();
    for (const double outweighs : kOutweighs)
      if (tension > 0 && attempt(outweighs * tension, true, 1))
        return outweighs * tension * time_squared;
    if (attempt(0, false, 1) || attempt(0, false, 8)) return 0;
    return std::nullopt;
  }

  // From missing momenta to velocities that bring the wanted speeds; impulses grow.
  bool solve(Scratch<Row>& momenta, Scratch<double> wanted, double time_squared) {
    const std::optional<double> stiffness = factor_matrix(time_squared);
    if (!stiffness) return false;
    for (std::size_t r = 0; r < wanted.size(); ++r) add_impulse(momenta, r, *stiffness * wanted[r]);
    const std::size_t count = wanted.size();
    answers_.resize(count);
    for (std::size_t r = 0; r < count; ++r) {
      answers_[r].assign(momenta.size(), Row{});
      add_impulse(answers_[r], r, 1);
      if (!matrix_.solve(answers_[r], kTolerance)) return false;
    }
    if (!matrix_.solve(momenta, kTolerance) || !factor()) return false;
    for (std::size_t r = 0; r < count; ++r) wanted[r] -= speed(momenta, r);
    joints_.count_solve();
    schur_.solve(wanted);
    for (std::size_t r = 0; r < count; ++r) {
      joints_.impulses()[r] += wanted[r];
      for (std::size_t n = 0; n < momenta.size(); ++n)
        for (int c = 0; c < B; ++c) momenta[n][c] += wanted[r] * answers_[r][n][c];
    }
    return true;
  }

  bool factor() {
    const auto entry = [&](std::size_t i, std::size_t j) { return speed(answers_[j], i); };
    if (schur_.factor(entry, kJointSettings.least_part)) return true;
    return schur_.factor([&](std::size_t i, std::size_t j) {
      return entry(i, j) * (i == j ? 1 + kJointSettings.compliance : 1);
    });
  }

  // Adds to the velocities; returns the largest change as a part of the fastest speed.
  double apply(const Scratch<Row>& change) {
    double fastest = 0, most = 0;
    for (std::size_t n = 0; n < change.size(); ++n) {
      const std::size_t i = system_.movers()[n];
      Vec<D> by(0.0);
      for (int c = 0; c < D; ++c) by[c] = change[n][c];
      state_.kick[i] += by / system_.gained(i);
      double moved = glm::length(by);
      double speed = glm::length(system_.velocity(state_, i)) + glm::length(state_.kick[i]);
      if constexpr (B > D) {
        if (system_.turns(i)) {
          Spin<D> spin(0.0);
          for (int c = D; c < B; ++c) spin_component(spin, c - D) = change[n][c];
          state_.twist[i] += system_.inertia_times(state_, i, spin);
          const double reach = turning_reach<D>(system_.bodies()[i].shape);
          moved += reach * std::sqrt(dot(spin, spin));
          const Spin<D> now = system_.angular_velocity(state_, i);
          speed += reach * std::sqrt(dot(now, now));
        }
      }
      // No number is the largest of all.
      if (!(moved <= most)) most = moved;
      fastest = std::max(fastest, speed);
    }
    return most > 0 ? most / fastest : most;
  }

  static constexpr double kTolerance = 1e-13;  // of solutions that are found step by step

  ConstrainedPart<D>& part_;
  SmoothSystem<D>& system_ = part_.system;
  JointSystem<D>& joints_ = part_.joints;
  SmoothState<D>& state_ = part_.state;
  const double h_ = part_.h, time_;
  Scratch<Tie<D>> ties_ = ties_of(joints_);
  MotionMatrix<D, B> matrix_{system_, LinearSolver::by_size, ties_};
  EnvelopeSystem schur_;
  Scratch<Scratch<Row>> answers_;  // to an impulse of 1 in each row
  SmoothState<D> end_;
};

// The step of a stage that lies at this share of it.
template <int D>
bool by_stage(ConstrainedPart<D>& part, double share) {
  SmoothSystem<D>& system = part.system;
  JointSystem<D>& joints = part.joints;
  SmoothState<D>& state = part.state;
  if (joints.rows().size() > kJointSettings.most_dense) return false;
  if (share < 1) system.take_means(part.h);
  const bool found = system.any_turns() ? ImplicitStage<D, kTurning<D>>(part, share * part.h).run()
                                        : ImplicitStage<D, D>(part, share * part.h).run();
  if (!found) return false;
  system.fly(state, state, part.h);
  system.take_means(0);
  for (const std::size_t i : system.movers()) {
    state.kick[i] /= share;
    state.twist[i] /= share;
  }
  for (double& impulse : joints.impulses()) impulse /= share;
  joints.look(state);
  return joints.factor() && joints.close_gaps(state) && joints.stop_parting(state, true);
}

}  // namespace

template <int D>
bool constrained_damped_kick(ConstrainedPart<D>& part, double time) {
  if (part.joints.rows().size() > kJointSettings.most_dense) return false;
  const bool found = part.system.any_turns() ? ImplicitStage<D, kTurning<D>>(part, time).kick()
                                             : ImplicitStage<D, D>(part, time).kick();
  return found && part.joints.stop_parting(part.state, true);
}

template <int D>
bool constrained_implicit_midpoint(ConstrainedPart<D>& part) {
  return by_stage(part, 0.5);
}

template <int D>
bool constrained_implicit_euler(ConstrainedPart<D>& part) {
  return by_stage(part, 1);
}

#define LANTERN_INSTANTIATE(D)                                        \
  template bool constrained_damped_kick(ConstrainedPart<D>&, double); \
  template bool constrained_implicit_midpoint(ConstrainedPart<D>&);   \
  template bool constrained_implicit_euler(ConstrainedPart<D>&);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern::physics
