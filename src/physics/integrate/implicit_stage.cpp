// Velocities that agree with the forces they lead to, found by Newton's method.
#include "physics/integrate/implicit_stage.hpp"

#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"
#include "physics/joint/constrained_motion.hpp"

namespace lantern::physics {

namespace {

// Newton's method on the momentum that is missing. Near the solution it doubles the number of right
// digits each time. Far from it two things may go wrong, and each has a cure:
//
// - The way that the equations show may lead up instead of down in energy, because compressed
//   springs want to buckle. Then that part of the equations is left out.
// - The way may be too long. A search along it stops where nothing is missing along it. But in a
//   curved valley (a stiff spring that swings) each such step is tiny, while whole steps climb the
//   wall, fall back and are there. So whole steps are tried first, and undone if they do not help.
constexpr double kEpsilon = 0x1p-52;
constexpr double kNothing = 0x1p-430;  // N s; of less, squares are beyond numbers
constexpr double kShare = 1e-9;        // of what is missing, that an iteration may leave so
constexpr int kMostSteps = 200;
constexpr int kWholeSteps = 10;  // tried before as many searches

template <int D, int B>
class Newton {
 public:
  using Row = std::array<double, B>;

  Newton(SmoothSystem<D>& system, double time, LinearSolver solver)
      : system_(system), matrix_(system, solver), time_(time) {}

  // False if it does not converge.
  bool run(SmoothState<D>& state) {
    if (!guess(state)) return false;
    SmoothState<D> before;
    double lacked = 0;
    for (int step = 0; step < kMostSteps; ++step) {
      if (done(state, step)) return sharpen(state);
      const int phase = step % (2 * kWholeSteps);
      if (phase == 0) {
        before = state;
        lacked = lack();
      } else if (phase == kWholeSteps && !(lack() < 0.01 * lacked)) {
        state = before;
        look(state);
      }
      Scratch<Row> direction;
      if (!solve(
              state, time_ * time_, kShare, [&] { return missing_; }, direction))
        return false;
      if (phase < kWholeSteps) {
        go(state, SmoothState<D>(state), direction, 1);
        look(state);
      } else {
        search(state, direction);
      }
    }
    return false;
  }

  // One solution with places as they are. False if there is none.
  bool kick(SmoothState<D>& state) {
    pull_ = system_.evaluate(state);
    Scratch<Row> momenta(system_.movers().size()), step;
    for (std::size_t n = 0; n < momenta.size(); ++n) {
      const std::size_t i = system_.movers()[n];
      put(momenta[n], time_ / system_.bodies()[i].inverse_mass * pull_.acceleration[i],
          time_ * pull_.torque[i]);
    }
    if (!solve(
            state, 0, kEpsilon, [&] { return momenta; }, step))
      return false;
    go(state, SmoothState<D>(state), step, 1);
    return true;
  }

 private:
  static void put(Row& row, const Vec<D>& linear, const Spin<D>& angular) {
    for (int c = 0; c < D; ++c) row[c] = linear[c];
    for (int c = D; c < B; ++c) row[c] = spin_component(angular, c - D);
  }

  // The velocities for the momenta rows(), which may depend on the matrix. False if numbers fail.
  template <class Rows>
  bool solve(const SmoothState<D>& state, double time_squared, double tolerance, Rows&& rows,
             Scratch<Row>& solution) {
    const auto attempt = [&](bool buckling, double heavier) {
      if (!matrix_.factor(state, time_squared, time_, buckling, heavier)) return false;
      solution = rows();
      return matrix_.solve(solution, tolerance);
    };
    if (attempt(true, 1)) return true;
    for (double heavier = 1; heavier < 1e18; heavier *= 8)
      if (attempt(false, heavier)) return true;
    return false;
  }

  // Where forces that are linear about the start lead: the solution itself if they are linear. A
  // free flight would be no good guess, since a stiff spring never lets the body fly so far; and
  // from the wrong side of an anchor Newton's method finds a solution of no meaning.
  bool guess(SmoothState<D>& state) {
    pull_ = system_.evaluate(state);
    find_missing(state);
    const auto linear = [&] {
      Scratch<Row> rows = missing_;
      matrix_.subtract_stretching(state, time_, rows);
      return rows;
    };
    Scratch<Row> step;
    if (!solve(state, time_ * time_, kShare, linear, step)) return false;
    go(state, SmoothState<D>(state), step, 1);
    look(state);
    return true;
  }

  // Evaluates the forces where the state's velocities lead, and what momentum is missing.
  void look(SmoothState<D>& state) {
    system_.fly(state, state, time_);
    pull_ = system_.evaluate(state);
    find_missing(state);
  }

  void find_missing(const SmoothState<D>& state) {
    missing_.assign(system_.movers().size(), Row{});
    for (std::size_t n = 0; n < missing_.size(); ++n) {
      const std::size_t i = system_.movers()[n];
      const double mass = 1 / system_.bodies()[i].inverse_mass;
      put(missing_[n], mass * (time_ * pull_.acceleration[i] - state.kick[i]),
          time_ * pull_.torque[i] - state.twist[i]);
    }
  }

  // A stiff spring's momentum along its line has a rounding that would hide much of what is missing
  // across it. It takes one more step, not looked at, to find that; where there is none, nothing is
  // lost.
  bool sharpen(SmoothState<D>& state) {
    Scratch<Row> step;
    if (!are_missing_only(32 * kEpsilon, sizes(state, false, true)) &&
        solve(
            state, time_ * time_, kShare, [&] { return missing_; }, step))
      go(state, SmoothState<D>(state), step, 1);
    return true;
  }

  // state = before + share * step
  void go(SmoothState<D>& state, const SmoothState<D>& before, const Scratch<Row>& step,
          double share) const {
    for (std::size_t n = 0; n < step.size(); ++n) {
      const std::size_t i = system_.movers()[n];
      for (int c = 0; c < D; ++c)
        state.kick[i][c] = before.kick[i][c] + share / system_.gained(i) * step[n][c];
      if constexpr (B > D) {
        if (!system_.turns(i)) continue;
        Spin<D> spin(0.0);
        for (int c = D; c < B; ++c) spin_component(spin, c - D) = step[n][c];
        state.twist[i] = before.twist[i] + system_.inertia_times(before, i, share * spin);
      }
    }
  }

  double along(const Scratch<Row>& direction) const {
    double sum = 0;
    for (std::size_t n = 0; n < direction.size(); ++n)
      for (int c = 0; c < B; ++c) sum += direction[n][c] * missing_[n][c];
    return sum;
  }
  double lack() const { return std::sqrt(along(missing_)); }

  // Goes along the direction: all the way if that is no worse, else to about where nothing is
  // missing along it, which is bracketed since it was too near at first and too far at last.
  void search(SmoothState<D>& state, const Scratch<Row>& direction) {
    const SmoothState<D> before = state;
    const double first = along(direction);
    double near = 0, near_value = first, far = 1;
    double share = 1;
    for (int i = 0; i < 40; ++i) {
      go(state, before, direction, share);
      look(state);
      const double value = along(direction);
      const bool too_far = !(value >= -0.5 * first);
      if (!too_far && (share == 1 || value <= 0.5 * first)) return;
      (too_far ? far : near) = share;
      if (!too_far) near_value = value;
      const double part = near_value / (near_value - value);  // where a straight line would cross
      share = near + (far - near) * (too_far && part > 0.1 && part < 0.9 ? part : 0.5);
    }
  }

  // What is missing is no more than rounding makes, or, after many steps, little.
  bool done(const SmoothState<D>& state, int steps) const {
    const double allowed = steps < 20 ? 8 * kEpsilon : steps < 60 ? 1e-13 : 1e-10;
    return are_missing_only(allowed, sizes(state, steps >= 20));
  }
  bool are_missing_only(double allowed,
                        const std::pair<Scratch<double>, Scratch<double>>& sizes) const {
    const auto& [linear, angular] = sizes;
    for (std::size_t n = 0; n < missing_.size(); ++n) {
      const std::size_t i = system_.movers()[n];
      for (int c = 0; c < B; ++c)
        if (!(std::abs(missing_[n][c]) <= kNothing + allowed * (c < D ? linear[i] : angular[i])))
          return false;
    }
    return true;
  }

  // Of the momenta and angular momenta that cancel when nothing is missing, a sum of sizes a body.
  // `rounded`: a velocity near 0 counts as much as the two parts of which it is the sum, for it has
  // their rounding. `taut`: of a spring its tension, not all that may be lost of it by rounding.
  std::pair<Scratch<double>, Scratch<double>> sizes(const SmoothState<D>& state, bool rounded,
                                                    bool taut = false) const {
    const auto speed = [&](std::size_t i) {
      return size_of(system_.velocity(state, i)) + (rounded ? size_of(state.kick[i]) : 0);
    };
    const std::span<const Body<D>> bodies = system_.bodies();
    const Forces<D>& forces = system_.forces();
    Scratch<double> linear(bodies.size(), 0.0), angular = linear;
    for (const std::size_t i : system_.movers()) {
      const Body<D>& body = bodies[i];
      linear[i] = (size_of(state.kick[i]) + time_ * size_of(forces.gravity)) / body.inverse_mass +
                  time_ * body.linear_drag * speed(i);
      if (!system_.turns(i)) continue;
      angular[i] = size_of(state.twist[i]) + time_ * size_of(pull_.torque[i]) +
                   time_ * body.angular_drag * size_of(system_.angular_velocity(state, i));
      for (int axis = 0; rounded && axis < (D == 2 ? 1 : 3); ++axis)
        angular[i] += system_.drag_part(i, axis, time_) * size_of(state.twist[i]);
    }
    const auto add = [&](std::size_t i, double arm, double momentum) {
      linear[i] += momentum;
      angular[i] += arm * momentum;
    };
    system_.each_stretch(state, [&](const Ends& ends, const Stretch<D>& s, double rest) {
      const auto [a, b] = ends;
      const double arm_a = size_of(s.arm_a), arm_b = size_of(s.arm_b);
      const double speeds = speed(a) + speed(b);
      const double lengths = s.length + rest + arm_a + arm_b + size_of(state.shift[a]) +
                             size_of(state.shift[b]) + (rounded ? time_ * speeds : 0);
      const double momentum = time_ * (taut ? std::abs(s.tension)
                                            : std::abs(s.stiffness) * lengths + s.damping * speeds);
      add(a, arm_a, momentum);
      add(b, arm_b, momentum);
    });
    for (std::size_t k = 0; k < forces.pushes.size(); ++k) {
      const Push<D>& push = forces.pushes[k];
      add(system_.pushed()[k], size_of(push.at), time_ * size_of(push.force));
    }
    return {linear, angular};
  }

  SmoothSystem<D>& system_;
  MotionMatrix<D, B> matrix_;
  double time_;
  Pull<D> pull_;
  Scratch<Row> missing_;
};

// The body that goes farthest astray: the first whose speed is no number, else the fastest.
template <int D>
const std::string& culprit(const SmoothSystem<D>& system, const SmoothState<D>& state) {
  std::size_t worst = system.movers().front();
  double most = -1;
  for (const std::size_t i : system.movers()) {
    const Vec<D> velocity = system.velocity(state, i);
    double speed = 0;  // the largest component: its square may be beyond all numbers
    for (int axis = 0; axis < D; ++axis) speed = std::max(speed, std::abs(velocity[axis]));
    for (int axis = 0; axis < D; ++axis)
      if (!std::isfinite(velocity[axis])) return system.bodies()[i].name;
    if (speed > most) {
      most = speed;
      worst = i;
    }
  }
  return system.bodies()[worst].name;
}

}  // namespace

template <int D>
SmoothState<D> implicit_stage(SmoothSystem<D>& system, double time, std::string_view method,
                              double h, LinearSolver solver) {
  SmoothState<D> state = system.start();
  const bool found = system.any_turns() ? Newton<D, kTurning<D>>(system, time, solver).run(state)
                                        : Newton<D, D>(system, time, solver).run(state);
  if (!found)
    throw Refused(fmt::format("body '{}': {} does not converge at a step of {} s",
                              culprit(system, state), method, h));
  return state;
}

template <int D>
void damped_kick(SmoothSystem<D>& system, SmoothState<D>& state, double time, LinearSolver solver) {
  const bool found = system.any_turns() ? Newton<D, kTurning<D>>(system, time, solver).kick(state)
                                        : Newton<D, D>(system, time, solver).kick(state);
  if (!found)
    throw Refused(
        fmt::format("body '{}': damping has no solution over {} s", culprit(system, state), time));
}

template SmoothState<2> implicit_stage(SmoothSystem<2>&, double, std::string_view, double,
                                       LinearSolver);
template SmoothState<3> implicit_stage(SmoothSystem<3>&, double, std::string_view, double,
                                       LinearSolver);
template void damped_kick(SmoothSystem<2>&, SmoothState<2>&, double, LinearSolver);
template void damped_kick(SmoothSystem<3>&, SmoothState<3>&, double, LinearSolver);

}  // namespace lantern::physics
