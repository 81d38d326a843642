// Random worlds that hold contacts and joints to the law of energy.
#pragma once

#include <cstdint>
#include <string>

#include "measure/energy_trial.hpp"

namespace lantern::measure {

// Runs the world of this seed, flat if it is even: 2 to 12 boxes, balls and capsules of aspects to
// 1 : 1000, spins to 1e4 rad/s and mass ratios to 1e6, with any friction and restitution to 1, with
// or without gravity, floor, walls, pins, rods, a constant push, overlaps at the start; in steps of
// 1/240 s to 1/10 s, 1 to 16 sub-steps, 1 to 50 sweeps, by any integrator but explicit Euler. About
// 1.5 s, in 30 steps or more. The same seed is the same scene for each method.
EnergyTrial random_trial(std::uint64_t seed, ContactMethod method, const WatchEnergy& watch = {});

// What the scene of this seed is, in one line.
std::string random_scene_text(std::uint64_t seed);

}  // namespace lantern::measure
