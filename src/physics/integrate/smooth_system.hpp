// The bodies and forces of one step, as every method of integration sees them: a state to be
// evaluated, and how a state is made from the one at the start.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "base/scratch.hpp"
#include "base/stop.hpp"
#include "physics/body.hpp"
#include "physics/integrate/integrator.hpp"

namespace lantern::physics {

// All that moves, at some moment within the step, one entry a body. Everything is kept as the
// difference from the start of the step: so nothing is lost by rounding far from the origin.
template <int D>
struct SmoothState {
  Scratch<Vec<D>> shift;   // of the position
  Scratch<Vec<D>> kick;    // of the velocity
  Scratch<Spin<D>> twist;  // of the angular momentum
  Scratch<Rotation<D>> orientation;
};

// What all forces together do to each body; zero for those that no force moves.
template <int D>
struct Pull {
  Scratch<Vec<D>> acceleration;
  Scratch<Spin<D>> torque;
};

// Where the ends of a spring, or two that attract each other, are in the span of bodies.
struct Ends {
  std::size_t a = 0;
  std::size_t b = 0;
};

// Of a vector, or of a spin in the plane.
inline double size_of(double spin) { return std::abs(spin); }
template <int D>
double size_of(const glm::vec<D, double>& v) {
  return glm::length(v);
}

// Drag c on a mass m takes z = h c / m times the mean velocity u = v + share (v' - v) over a step
// of h seconds, by which the body also moves: it leaves it a way of m v / c. Half the change is of
// second order, but would turn velocities round, at each step anew, where z > 2; there the share is
// the least by which nothing does (Liniger and Willoughby, SIAM J. Numer. Anal. 7, 1970, fit it).
inline double drag_share(double z) { return z > 2 ? 1 - 1 / z : 0.5; }
inline double mean_gain(double z) { return 2 * drag_share(z); }  // of half the change

// f(axis, component) of each component of a spin in a body's own axes.
template <class F>
double by_own_axes(const Rotation<2>&, double spin, F&& f) {
  return f(0, spin);
}
template <class F>
Vec<3> by_own_axes(const Rotation<3>& r, const Vec<3>& spin, F&& f) {
  const Vec<3> own = glm::conjugate(r.q) * spin;
  return r.q * Vec<3>(f(0, own.x), f(1, own.y), f(2, own.z));
}

template <int D>
class SmoothSystem {
 public:
  // Bodies and forces must outlive the system. Throws Refused for a spring or push on a body that
  // is not there.
  SmoothSystem(std::span<const Body<D>> bodies, const Forces<D>& forces, std::uint64_t& evaluations)
      : bodies_(bodies),
        forces_(forces),
        evaluations_(evaluations),
        number_(bodies.size()),
        moves_(bodies.size(), 0),
        turns_(bodies.size(), 0) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const Body<D>& body = bodies[i];
      if (!body.is_pushed() || !(body.inverse_mass > 0)) continue;
      moves_[i] = 1;
      number_[i] = movers_.size();
      movers_.push_back(i);
    }
    if (!forces.springs.empty() || !forces.pushes.empty()) {
      const BodyLookup<D> lookup(bodies);
      for (const Spring<D>& spring : forces.springs) {
        ends_.push_back({lookup.index_of(spring.a, "spring"), lookup.index_of(spring.b, "spring")});
        if (spring.damping > 0) any_damping_ = true;
      }
      for (const Push<D>& push : forces.pushes)
        pushed_.push_back(lookup.index_of(push.body, "push"));
    }
    if (forces.gravitation > 0)
      for (const Body<D>& body : bodies) masses_.push_back(attracting_mass(body));
    find_what_turns();
  }

  // The bodies that forces move: dynamic, awake, not of infinite mass. In their order.
  const Scratch<std::size_t>& movers() const { return movers_; }
  std::size_t number(std::size_t mover) const { return number_[mover]; }  // among these
  bool moves(std::size_t i) const { return moves_[i] != 0; }
  // Whether any force can turn the body. If not, its torque is not evaluated and is zero.
  bool turns(std::size_t i) const { return turns_[i] != 0; }
  bool any_turns() const { return any_turns_; }
  // Something else than forces turns the body, too, if it can be turned: what a joint holds.
  void turn_also(std::size_t i) {
    if (!can_be_turned(i)) return;
    turns_[i] = 1;
    any_turns_ = true;
  }

  // Whether some force depends on velocity.
  bool any_damping() const { return any_damping_ || (drag_acts_ && fastest_drag() > 0); }

  // The part z of a velocity that drag takes in `h` seconds, of the angular momentum about an axis
  // of the body, and of any, at most, in a second.
  double drag_part(std::size_t i, double h) const {
    return h * bodies_[i].linear_drag * bodies_[i].inverse_mass;
  }
  double drag_part(std::size_t i, int axis, double h) const {
    return h * bodies_[i].angular_drag * spin_component(bodies_[i].inverse_inertia, axis);
  }
  double fastest_drag() const {
    double most = 0;
    for (const std::size_t i : movers_)
      for (int axis = 0; axis < (D == 2 ? 1 : 3); ++axis)
        most = std::max({most, drag_part(i, 1), turns(i) ? drag_part(i, axis, 1) : 0});
    return most;
  }
  // A spin times f(z) of each of the body's own axes, as these lie.
  template <class F>
  Spin<D> by_drag(std::size_t i, const Rotation<D>& axes, const Spin<D>& spin, double h,
                  F&& f) const {
    return by_own_axes(axes, spin, [&](int axis, double component) {
      return component * f(drag_part(i, axis, h));
    });
  }
  // Drag is no force of this system any more.
  void leave_drag() { drag_acts_ = false; }
  double linear_drag(std::size_t i) const { return drag_acts_ ? bodies_[i].linear_drag : 0; }
  double angular_drag(std::size_t i) const { return drag_acts_ ? bodies_[i].angular_drag : 0; }
  // From now on the kicks (twists) of a state are half of those over `h` seconds, and its
  // velocities are the mean ones; 0: they are the state's own again.
  void take_means(double h) { mean_over_ = h * fastest_drag() > 2 ? h : 0; }
  // How much of a kick (twist) these gain.
  double gained(std::size_t i) const { return mean_gain(drag_part(i, mean_over_)); }
  Spin<D> gained_twist(const SmoothState<D>& state, std::size_t i) const {
    if (mean_over_ == 0) return state.twist[i];
    return by_drag(i, state.orientation[i], state.twist[i], mean_over_, mean_gain);
  }

  std::span<const Body<D>> bodies() const { return bodies_; }
  const Forces<D>& forces() const { return forces_; }
  // One a spring.
  const Scratch<Ends>& ends() const { return ends_; }
  // Whether every two bodies attract each other.
  bool any_attraction() const { return !masses_.empty(); }
  // f(ends) for each spring, then for every two bodies that attract each other and of which one
  // moves. There may be millions of these: they are kept nowhere, and Stopped is thrown between.
  template <class F>
  void each_two(F&& f) const {
    for (const Ends& ends : ends_) f(ends);
    each_attraction([&](const Ends& ends, double) { f(ends); });
  }

  // f(ends, stretch as it is in the state, rest length) for the same.
  template <class F>
  void each_stretch(const SmoothState<D>& state, F&& f) const {
    for (std::size_t k = 0; k < ends_.size(); ++k) {
      stop_if_asked();
      f(ends_[k], stretch(state, k), forces_.springs[k].rest_length);
    }
    each_attraction([&](const Ends& ends, double strength) {
      f(ends, attracted<D>(strength, between(state, ends)), 0.0);
    });
  }

  const Scratch<std::size_t>& pushed() const { return pushed_; }  // bodies, one a push

  SmoothState<D> start() const {
    const Scratch<Vec<D>> none(bodies_.size(), Vec<D>(0.0));
    SmoothState<D> state{none, none, Scratch<Spin<D>>(bodies_.size(), Spin<D>(0.0)), {}};
    for (const Body<D>& body : bodies_) state.orientation.push_back(body.orientation);
    return state;
  }

  // Velocities are those of the start and `pull` for `time`.
  void kick(SmoothState<D>& state, const Pull<D>& pull, double time) const {
    for (const std::size_t i : movers_) {
      state.kick[i] = time * pull.acceleration[i];
      if (turns(i)) state.twist[i] = time * pull.torque[i];
    }
  }

  // Places are those of the start and the velocities of `with` for `time`; `with` may be `state`.
  // Kinematic bodies are where they are at that time. Or places go on from those of the state.
  void fly(SmoothState<D>& state, const SmoothState<D>& with, double time,
           bool goes_on = false) const {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Body<D>& body = bodies_[i];
      if (body.kind == BodyKind::static_body || body.asleep) continue;
      const Vec<D> way = time * velocity(with, i);
      state.shift[i] = goes_on ? state.shift[i] + way : way;
      // A body that only turns freely still moves the ends of its springs, if any are off its
      // centre; then it is among those that turn, unless it is not to be turned by forces.
      if (turns(i) || !body.may_turn || body.kind == BodyKind::kinematic_body)
        state.orientation[i] =
            freely_turned(body, goes_on ? state.orientation[i] : body.orientation,
                          body.angular_momentum + gained_twist(with, i), time);
    }
  }

  // All forces, once. Counts as one evaluation.
  Pull<D> evaluate(const SmoothState<D>& state) {
    Pull<D> pull;
    ++evaluations_;
    pull.acceleration.assign(bodies_.size(), Vec<D>(0.0));
    pull.torque.assign(bodies_.size(), Spin<D>(0.0));
    for (const std::size_t i : movers_) {
      const Body<D>& body = bodies_[i];
      pull.acceleration[i] = forces_.gravity;
      if (linear_drag(i) > 0)
        pull.acceleration[i] -= linear_drag(i) * body.inverse_mass * velocity(state, i);
      if (angular_drag(i) > 0 && turns(i))
        pull.torque[i] = -angular_drag(i) * angular_velocity(state, i);
    }
    const auto apply = [&](std::size_t i, const Vec<D>& arm, const Vec<D>& force) {
      if (moves(i)) pull.acceleration[i] += bodies_[i].inverse_mass * force;
      if (turns(i)) pull.torque[i] += cross(arm, force);
    };
    each_stretch(state, [&](const Ends& ends, const Stretch<D>& s, double) {
      const Vec<D> force = s.tension * s.direction;
      apply(ends.a, s.arm_a, force);
      apply(ends.b, s.arm_b, -force);
    });
    for (std::size_t k = 0; k < pushed_.size(); ++k)
      apply(pushed_[k], forces_.pushes[k].at, forces_.pushes[k].force);
    return pull;
  }

  Vec<D> velocity(const SmoothState<D>& state, std::size_t i) const {
    const Body<D>& body = bodies_[i];
    if (body.kind == BodyKind::static_body || body.asleep) return Vec<D>(0.0);
    return body.velocity + gained(i) * state.kick[i];
  }

  Spin<D> angular_velocity(const SmoothState<D>& state, std::size_t i) const {
    const Body<D>& body = bodies_[i];
    if (body.kind == BodyKind::static_body || body.asleep) return Spin<D>(0.0);
    if (body.kind == BodyKind::kinematic_body) return body.kinematic_spin;
    return spin_of(body, state.orientation[i], body.angular_momentum + gained_twist(state, i));
  }

  // Inertia of a body that turns, in the world's axes: from the angular velocity to the twist that
  // gains it.
  Spin<D> inertia_times(const SmoothState<D>& state, std::size_t i, const Spin<D>& spin) const {
    return by_own_axes(state.orientation[i], spin, [&](int axis, double component) {
      return component / (spin_component(bodies_[i].inverse_inertia, axis) *
                          mean_gain(drag_part(i, axis, mean_over_)));
    });
  }

 private:
  void find_what_turns() {
    const Vec<D> centre(0.0);
    for (const std::size_t i : movers_)
      if (bodies_[i].angular_drag > 0) turns_[i] = 1;
    for (std::size_t k = 0; k < forces_.springs.size(); ++k) {
      if (forces_.springs[k].at_a != centre) turns_[ends_[k].a] = 1;
      if (forces_.springs[k].at_b != centre) turns_[ends_[k].b] = 1;
    }
    for (std::size_t k = 0; k < pushed_.size(); ++k)
      if (forces_.pushes[k].at != centre) turns_[pushed_[k]] = 1;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (!can_be_turned(i)) turns_[i] = 0;
      if (turns_[i] != 0) any_turns_ = true;
    }
  }

  bool can_be_turned(std::size_t i) const {
    return moves_[i] != 0 && bodies_[i].may_turn && bodies_[i].turns_about_every_axis();
  }

  // The difference of the places at the start first: far from the origin it is the exact part.
  Vec<D> between(const SmoothState<D>& state, const Ends& ends) const {
    return (bodies_[ends.b].position - bodies_[ends.a].position) +
           (state.shift[ends.b] - state.shift[ends.a]);
  }

  Stretch<D> stretch(const SmoothState<D>& state, std::size_t spring) const {
    const auto [a, b] = ends_[spring];
    const Spring<D>& s = forces_.springs[spring];
    const auto motion = [&](std::size_t i, bool off_centre) -> EndMotion<D> {
      const Spin<D> spin = off_centre ? angular_velocity(state, i) : Spin<D>(0.0);
      return {state.orientation[i], velocity(state, i), spin};
    };
    return stretched<D>(s, between(state, ends_[spring]), motion(a, s.at_a != Vec<D>(0.0)),
                        motion(b, s.at_b != Vec<D>(0.0)));
  }

  // f(ends, strength), the two of lower places first, in their order.
  template <class F>
  void each_attraction(F&& f) const {
    for (std::size_t i = 0; i < masses_.size(); ++i) {
      stop_if_asked();
      for (std::size_t j = i + 1; j < masses_.size(); ++j) {
        const double strength = forces_.gravitation * masses_[i] * masses_[j];
        if (strength > 0 && (moves(i) || moves(j))) f(Ends{i, j}, strength);
      }
    }
  }

  // At an orientation that need not be the body's.
  static Spin<D> spin_of(const Body<D>& body, const Rotation<D>& orientation,
                         const Spin<D>& momentum) {
    return by_own_axes(orientation, momentum, [&](int axis, double component) {
      return component * spin_component(body.inverse_inertia, axis);
    });
  }

  std::span<const Body<D>> bodies_;
  const Forces<D>& forces_;
  std::uint64_t& evaluations_;
  Scratch<std::size_t> movers_, number_;
  Scratch<char> moves_;
  Scratch<char> turns_;
  Scratch<Ends> ends_;
  Scratch<double> masses_;       // by which bodies attract; none if they do not
  Scratch<std::size_t> pushed_;  // one a push
  double mean_over_ = 0;         // seconds; 0: velocities are those of the state
  bool any_turns_ = false;
  bool any_damping_ = false;  // of springs
  bool drag_acts_ = true;
};

}  // namespace lantern::physics
