// The bodies and forces of one step, as every method of integration sees them: a state to be
// evaluated, and how a state is made from the one at the start.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/stop.hpp"
#include "physics/body.hpp"
#include "physics/forces.hpp"
#include "physics/integrator.hpp"

namespace lantern::physics {

// All that moves, at some moment within the step, one entry a body. Everything is kept as the
// difference from the start of the step: so nothing is lost by rounding far from the origin.
template <int D>
struct SmoothState {
  std::vector<Vec<D>> shift;   // of the position
  std::vector<Vec<D>> kick;    // of the velocity
  std::vector<Spin<D>> twist;  // of the angular momentum
  std::vector<Rotation<D>> orientation;
};

// What all forces together do to each body; zero for those that no force moves.
template <int D>
struct Pull {
  std::vector<Vec<D>> acceleration;
  std::vector<Spin<D>> torque;
};

// Where the ends of a spring, or two that attract each other, are in the span of bodies.
struct Ends {
  std::size_t a = 0;
  std::size_t b = 0;
};

template <int D>
class SmoothSystem {
 public:
  // Bodies and forces must outlive the system. Throws Refused for a spring or push on a body that
  // is not there.
  SmoothSystem(std::span<const Body<D>> bodies, const Forces<D>& forces,
               std::uint64_t& evaluations);

  // The bodies that forces move: dynamic, awake, not of infinite mass. In their order.
  const std::vector<std::size_t>& movers() const { return movers_; }
  bool moves(std::size_t i) const { return moves_[i] != 0; }
  // Whether any force can turn the body. If not, its torque is not evaluated and is zero.
  bool turns(std::size_t i) const { return turns_[i] != 0; }
  bool any_turns() const { return any_turns_; }
  // Something else than forces turns the body, too, if it can be turned: what a joint holds.
  void turn_also(std::size_t i);
  // Whether some force depends on velocity.
  bool any_damping() const { return any_damping_; }

  std::span<const Body<D>> bodies() const { return bodies_; }
  const Forces<D>& forces() const { return forces_; }
  // One a spring.
  const std::vector<Ends>& ends() const { return ends_; }
  // Whether every two bodies attract each other.
  bool any_attraction() const { return !masses_.empty(); }
  // f(ends) for each spring, then for every two bodies that attract each other and of which one
  // moves. There may be millions of these: they are kept nowhere, and Stopped is thrown between.
  template <class F>
  void each_two(F&& f) const;
  // f(ends, stretch as it is in the state, rest length) for the same.
  template <class F>
  void each_stretch(const SmoothState<D>& state, F&& f) const;
  const std::vector<std::size_t>& pushed() const { return pushed_; }  // bodies, one a push

  SmoothState<D> start() const;
  // Velocities are those of the start and `pull` for `time`.
  void kick(SmoothState<D>& state, const Pull<D>& pull, double time) const;
  // Places are those of the start and the velocities of `with` for `time`; `with` may be `state`.
  // Kinematic bodies are where they are at that time.
  void fly(SmoothState<D>& state, const SmoothState<D>& with, double time) const;

  // All forces, once. Counts as one evaluation.
  Pull<D> evaluate(const SmoothState<D>& state);
  // The same, into the memory of a pull that there is.
  void evaluate(const SmoothState<D>& state, Pull<D>& pull);

  Vec<D> velocity(const SmoothState<D>& state, std::size_t i) const;
  Spin<D> angular_velocity(const SmoothState<D>& state, std::size_t i) const;
  // Inertia of a body that turns, in the world's axes: angular velocity to angular momentum.
  Spin<D> inertia_times(const SmoothState<D>& state, std::size_t i, const Spin<D>& spin) const;

 private:
  void find_what_turns();
  bool can_be_turned(std::size_t i) const;
  Vec<D> between(const SmoothState<D>& state, const Ends& ends) const;
  Stretch<D> stretch(const SmoothState<D>& state, std::size_t spring) const;
  template <class F>
  void each_attraction(F&& f) const;  // f(ends, strength)

  std::span<const Body<D>> bodies_;
  const Forces<D>& forces_;
  std::uint64_t& evaluations_;
  std::vector<std::size_t> movers_;
  std::vector<char> moves_;
  std::vector<char> turns_;
  std::vector<Ends> ends_;
  std::vector<double> masses_;       // by which bodies attract; none if they do not
  std::vector<std::size_t> pushed_;  // one a push
  bool any_turns_ = false;
  bool any_damping_ = false;
};

// The two of lower places first, in their order.
template <int D>
template <class F>
void SmoothSystem<D>::each_attraction(F&& f) const {
  for (std::size_t i = 0; i < masses_.size(); ++i) {
    stop_if_asked();
    for (std::size_t j = i + 1; j < masses_.size(); ++j) {
      const double strength = forces_.gravitation * masses_[i] * masses_[j];
      if (strength > 0 && (moves(i) || moves(j))) f(Ends{i, j}, strength);
    }
  }
}

template <int D>
template <class F>
void SmoothSystem<D>::each_two(F&& f) const {
  for (const Ends& ends : ends_) f(ends);
  each_attraction([&](const Ends& ends, double) { f(ends); });
}

template <int D>
template <class F>
void SmoothSystem<D>::each_stretch(const SmoothState<D>& state, F&& f) const {
  for (std::size_t k = 0; k < ends_.size(); ++k) {
    stop_if_asked();
    f(ends_[k], stretch(state, k), forces_.springs[k].rest_length);
  }
  each_attraction([&](const Ends& ends, double strength) {
    f(ends, attracted<D>(strength, between(state, ends)), 0.0);
  });
}

// The methods. `out` holds one zero increment a body. Each is defined in the file of its name.
template <int D>
void explicit_euler(SmoothSystem<D>& system, double h, std::vector<Increment<D>>& out);
template <int D>
void semi_implicit_euler(SmoothSystem<D>& system, double h, std::vector<Increment<D>>& out);
template <int D>
void velocity_verlet(SmoothSystem<D>& system, double h, std::vector<Increment<D>>& out);
template <int D>
void runge_kutta_4(SmoothSystem<D>& system, double h, std::vector<Increment<D>>& out);
template <int D>
void implicit_midpoint(SmoothSystem<D>& system, double h, std::vector<Increment<D>>& out);
template <int D>
void implicit_euler(SmoothSystem<D>& system, double h, std::vector<Increment<D>>& out);

}  // namespace lantern::physics
