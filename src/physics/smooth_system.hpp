// The bodies and forces of one step, as every method of integration sees them: a state to be
// evaluated, and how a state is made from the one at the start.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "physics/body.hpp"
#include "physics/forces.hpp"
#include "physics/integrator.hpp"

namespace lantern {

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
  // Whether some force depends on velocity.
  bool any_damping() const { return any_damping_; }

  std::span<const Body<D>> bodies() const { return bodies_; }
  const Forces<D>& forces() const { return forces_; }
  // One a spring, then one for every two bodies that attract each other.
  const std::vector<Ends>& ends() const { return ends_; }
  const std::vector<std::size_t>& pushed() const { return pushed_; }  // bodies, one a push

  SmoothState<D> start() const;
  // Velocities are those of the start and `pull` for `time`.
  void kick(SmoothState<D>& state, const Pull<D>& pull, double time) const;
  // Places are those of the start and the velocities of `with` for `time`; `with` may be `state`.
  // Kinematic bodies are where they are at that time.
  void fly(SmoothState<D>& state, const SmoothState<D>& with, double time) const;

  // All forces, once. Counts as one evaluation.
  Pull<D> evaluate(const SmoothState<D>& state);

  Vec<D> velocity(const SmoothState<D>& state, std::size_t i) const;
  Spin<D> angular_velocity(const SmoothState<D>& state, std::size_t i) const;
  // Of one of the ends, as it is in the state.
  Stretch<D> stretch(const SmoothState<D>& state, std::size_t end) const;
  // Inertia of a body that turns, in the world's axes: angular velocity to angular momentum.
  Spin<D> inertia_times(const SmoothState<D>& state, std::size_t i, const Spin<D>& spin) const;

 private:
  void find_what_attracts();
  void find_what_turns();

  std::span<const Body<D>> bodies_;
  const Forces<D>& forces_;
  std::uint64_t& evaluations_;
  std::vector<std::size_t> movers_;
  std::vector<char> moves_;
  std::vector<char> turns_;
  std::vector<Ends> ends_;
  std::vector<double> strengths_;    // of attraction, after the springs
  std::vector<std::size_t> pushed_;  // one a push
  bool any_turns_ = false;
  bool any_damping_ = false;
};

extern template class SmoothSystem<2>;
extern template class SmoothSystem<3>;

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

}  // namespace lantern
