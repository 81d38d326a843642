// How smooth forces (gravity, drag, springs, those of the user) change the state in one step. Each
// method is a function and a row that says what it is: comparing two functions shows the
// difference.
//
// A method gives each body's increment instead of its new state, so that contacts may change the
// velocity in between: v += kick; (contacts change v); x += h v + drift. The orientation follows
// the angular momentum by free rotation (body.hpp): L += twist; (contacts change L); turn
// freely for h with L + lag, then by turn. Without the lag the turning is of first order in a
// changing torque, whatever the method; with it, in space, of second order at most.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "base/scratch.hpp"
#include "physics/forces.hpp"
#include "physics/methods.hpp"
#include "physics/world_config.hpp"

namespace lantern::physics {

template <int D>
struct Increment {
  Vec<D> kick{0.0};    // of the velocity
  Vec<D> drift{0.0};   // of the position, beyond h times the new velocity
  Spin<D> twist{0.0};  // of the angular momentum
  Spin<D> lag{0.0};    // of the angular momentum while the body turns, beyond the new one
  Spin<D> turn{0.0};   // of the orientation, beyond that, about the world's axes
};

template <int D>
class SmoothSystem;
template <int D>
struct ConstrainedPart;

// Fills in the increments over `h` seconds of the system's movers; `out` holds one zero increment a
// body.
template <int D>
using FindIncrements = void (*)(SmoothSystem<D>& system, double h, std::span<Increment<D>> out);
// Moves bodies whose joints are part of the equations (joint/constrained_motion.hpp); false if that
// does not converge.
template <int D>
using MoveConstrained = bool (*)(ConstrainedPart<D>& part);

struct Integration {
  std::string_view name;
  int order = 1;              // in h, of the error of smooth motion
  double lag = 0;             // of the mean velocity behind the new one, as a part of its change
  bool implicit = false;      // solves equations for the end of the step
  bool gains_energy = false;  // by itself, at any step
  // Refuses drag, damping, joints and contacts: it knows forces that follow from places alone.
  bool of_places = false;
  BothDimensions<FindIncrements> increments = {};
  BothDimensions<MoveConstrained> with_joints = {};  // if there is none, rows hold the joints
};

const Integration& integration(Integrator integrator);
// One more method, which outlives all worlds; before any is made. What scenarios call it is its
// name.
Integrator add_integrator(const Integration& method);

// Increments over `h` > 0 seconds, one a body; zero for those that no force moves (static,
// kinematic, asleep). Deterministic: the same input gives the same bits. `evaluations` grows by the
// number of times that all forces were evaluated. Throws Refused, naming the method and the step,
// if an implicit method does not converge, for a step that is not above 0, and for a spring or push
// on a body that is not there, or for drag and damping that the method does not know. A step beyond
// an explicit method's limit gives increments that grow, in the end beyond all numbers: it is for
// the caller to look.
template <int D>
void find_increments(Integrator integrator, std::span<const Body<D>> bodies,
                     const Forces<D>& forces, double h, Scratch<Increment<D>>& out,
                     std::uint64_t& evaluations);

// The same, each body's by its own method, or by the world's; all zero if there is no force.
template <int D>
void find_increments_if_any(const WorldConfig<D>& config, std::span<const Body<D>> bodies,
                            const Forces<D>& forces, double h, Scratch<Increment<D>>& out,
                            WorldWork& work);

}  // namespace lantern::physics
