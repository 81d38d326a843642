// What a world is told when it is made, and what it counts.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "physics/methods.hpp"
#include "spatial/broad_phase_config.hpp"

namespace lantern::physics {

template <int D>
struct WorldConfig {
  Vec<D> gravity{0.0};
  double gravitation = 0;  // see Forces
  Integrator integrator = Integrator::semi_implicit_euler;
  RotationMethod rotation = RotationMethod::exact;  // where nothing holds a body
  ContactMethod contacts = ContactMethod::soft;
  BroadPhaseConfig<D> broad_phase = {};
  int sub_steps = 8;  // of soft contacts, 1 ... 1000
  // How deep two bodies may lie in each other at the end of a step, in units of length, or as deep
  // as before it if that is more (impact/depth_bound.hpp); 0 asks for the least that is tried,
  // 1e-6. Soft contacts of many bodies are swept accordingly, by 0 all rows at once. What cannot be
  // kept is counted (errors_missed). None: contacts do what they do, and nothing is measured.
  std::optional<double> wanted_error = std::nullopt;
  int iterations = 10;        // of impulse contacts: sweeps a step, 1 ... 100000
  bool warm_start = true;     // begin with the impulses of the step before
  bool may_sleep = true;      // islands that rest are left out until something wakes them
  bool continuous = true;     // bouncing and fast bodies meet at the moment of impact
  int impact_budget = 10000;  // impacts located in one step of the world; later ones are soft
  double sleep_after = 0.5;   // seconds below both speeds
  double sleep_speed = 0.01;  // units a second
  double sleep_spin = 0.02;   // radians a second
};

// What the world really did since it was made, each counted where it is done: 0 is not at all.
struct WorldWork {
  std::uint64_t steps = 0;
  std::uint64_t retries = 0;  // steps made anew because a body went farther than looked for
  std::uint64_t force_evaluations = 0;  // of all forces of the bodies that move together
  std::uint64_t broad_phases = 0;       // more than one in a step that is retried or wakes bodies
  std::uint64_t pair_tests = 0;         // boxes compared with boxes, in the broad phase
  std::uint64_t candidate_pairs = 0;    // that the broad phase handed on
  std::uint64_t narrow_pairs = 0;       // of those, tested by the narrow phase, each once a step
  std::uint64_t narrow_tests = 0;    // made: a pair may be looked at again in each part of a step
  std::uint64_t contact_points = 0;  // that it found, and that were solved
  std::uint64_t islands_solved = 0;  // groups of bodies that the contact solver was given
  std::uint64_t sub_steps = 0;       // into which their steps were cut; 0 where none is cut
  // Rows solved: one by one in a sweep, each as often as it was; or all of an island at once.
  std::uint64_t constraint_rows = 0;  // the sum of the next four
  std::uint64_t normal_rows = 0;
  std::uint64_t friction_rows = 0;
  std::uint64_t joint_rows = 0;
  std::uint64_t direct_rows = 0;
  std::uint64_t direct_solves = 0;  // of all rows at once
  std::uint64_t rotations_integrated = 0;
  std::uint64_t impact_looks = 0;     // at two bodies, to find the moment at which they meet
  std::uint64_t impacts_located = 0;  // and struck, in the steps as they were made in the end
  std::uint64_t errors_missed = 0;    // pairs that a step left deeper than `wanted_error`
  std::uint64_t rest_checks = 0;      // bodies looked at whether they may fall asleep
  // Of the last step alone.
  std::uint64_t islands = 0;  // of awake bodies
  std::uint64_t asleep = 0;   // bodies
};

// Every counter that only grows, by name: what ran between two moments is the difference of each.
struct WorldCounter {
  std::string_view name;
  std::uint64_t WorldWork::*count;
};
inline constexpr auto kWorldCounters =
    std::to_array<WorldCounter>({{"steps", &WorldWork::steps},
                                 {"retries", &WorldWork::retries},
                                 {"force_evaluations", &WorldWork::force_evaluations},
                                 {"broad_phases", &WorldWork::broad_phases},
                                 {"pair_tests", &WorldWork::pair_tests},
                                 {"candidate_pairs", &WorldWork::candidate_pairs},
                                 {"narrow_pairs", &WorldWork::narrow_pairs},
                                 {"narrow_tests", &WorldWork::narrow_tests},
                                 {"contact_points", &WorldWork::contact_points},
                                 {"islands_solved", &WorldWork::islands_solved},
                                 {"sub_steps", &WorldWork::sub_steps},
                                 {"constraint_rows", &WorldWork::constraint_rows},
                                 {"normal_rows", &WorldWork::normal_rows},
                                 {"friction_rows", &WorldWork::friction_rows},
                                 {"joint_rows", &WorldWork::joint_rows},
                                 {"direct_rows", &WorldWork::direct_rows},
                                 {"direct_solves", &WorldWork::direct_solves},
                                 {"rotations_integrated", &WorldWork::rotations_integrated},
                                 {"impact_looks", &WorldWork::impact_looks},
                                 {"impacts_located", &WorldWork::impacts_located},
                                 {"errors_missed", &WorldWork::errors_missed},
                                 {"rest_checks", &WorldWork::rest_checks}});

// What was done between two moments of one world; `islands` and `asleep` are those of the later.
inline WorldWork work_between(const WorldWork& before, WorldWork after) {
  for (const WorldCounter& counter : kWorldCounters) after.*counter.count -= before.*counter.count;
  return after;
}

}  // namespace lantern::physics
