// What a world is told when it is made, and what it counts.
#pragma once

#include <cstdint>

#include "physics/contact_method.hpp"
#include "physics/motion_method.hpp"
#include "spatial/broad_phase.hpp"

namespace lantern {

template <int D>
struct WorldConfig {
  Vec<D> gravity{0.0};
  double gravitation = 0;  // see Forces
  Integrator integrator = Integrator::semi_implicit_euler;
  RotationMethod rotation = RotationMethod::splitting_2;  // where nothing holds a body
  ContactMethod contacts = ContactMethod::soft;
  BroadPhaseConfig<D> broad_phase;
  int sub_steps = 8;          // of soft contacts and of joints, 1 ... 1000
  int iterations = 10;        // of impulse contacts: sweeps a step, 1 ... 100000
  bool warm_start = true;     // begin with the impulses of the step before
  bool may_sleep = true;      // islands that rest are left out until something wakes them
  bool continuous = true;     // bouncing and fast bodies meet at the moment of impact
  int impact_budget = 10000;  // impacts located in one step of the world; later ones are soft
  double sleep_after = 0.5;   // seconds below both speeds
  double sleep_speed = 0.01;  // units a second
  double sleep_spin = 0.02;   // radians a second
};

// What the world really did since it was made.
struct WorldWork {
  std::uint64_t steps = 0;
  std::uint64_t force_evaluations = 0;  // of all forces of the bodies that move together
  std::uint64_t pair_tests = 0;         // boxes compared with boxes, in the broad phase
  std::uint64_t candidate_pairs = 0;    // that the broad phase handed on
  std::uint64_t narrow_tests = 0;       // contacts asked of the narrow phase
  std::uint64_t contact_points = 0;     // that it found, and that were solved
  std::uint64_t constraint_rows = 0;    // normal, friction and joint rows, times sweeps
  std::uint64_t friction_rows = 0;      // of those, friction
  std::uint64_t rotations_integrated = 0;
  std::uint64_t impacts_located = 0;
  std::uint64_t islands = 0;  // of awake bodies, in the last step
  std::uint64_t asleep = 0;   // bodies, after the last step
};

}  // namespace lantern
