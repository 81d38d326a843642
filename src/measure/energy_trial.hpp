// Holds a world to the law of energy: without motors, and with a restitution of at most 1, contacts
// and joints may take energy, not give it.
#pragma once

#include "physics/world.hpp"

namespace lantern::measure {

// What the energy may gain, in parts of the largest kinetic energy so far.
inline constexpr double kEnergyAllowance = 1e-3;

// In joules. What moves slower than 1e-3 units a second counts as if it were as quick.
struct EnergyMoment {
  double time = 0;       // seconds
  double energy = 0;     // less the work of constant pushes
  double permitted = 0;  // that of the start, and what overlaps explain
  double kinetic = 0;    // the largest so far
  double excess() const { return (energy - permitted) / kinetic; }
};
using WatchEnergy = std::function<void(const EnergyMoment&)>;

struct EnergyTrial {
  double excess = 0;   // the largest over the run; endless if it broke off
  double time = 0;     // seconds, when that was
  std::string reason;  // why it broke off; empty if it did not
};

// Takes the steps, and looks before the first and after each. Pushes must go through the centres of
// their bodies, so that their work is the way of the centres along them.
//
// Bodies that overlap at the start may rise by as much as they overlap: against gravity and pushes,
// all bodies by the sum of all depths. They may get no speed from it.
template <int D>
EnergyTrial follow_energy(World<D>& world, double step, int steps, const WatchEnergy& watch = {});

// The sum of the deepest overlaps of all pairs that collide, units.
template <int D>
double overlap_of(const World<D>& world);

// Runs the world of this seed, flat if it is even: 2 to 12 boxes, balls and capsules of aspects to
// 1 : 1000, spins to 1e4 rad/s and mass ratios to 1e6, with any friction and restitution to 1, with
// or without gravity, floor, walls, pins, rods, a constant push, overlaps at the start; in steps of
// 1/240 s to 1/10 s, 1 to 16 sub-steps, 1 to 50 sweeps, by any integrator but explicit Euler. About
// 1.5 s, in 30 steps or more. The same seed is the same scene for each method.
EnergyTrial random_trial(std::uint64_t seed, ContactMethod method, const WatchEnergy& watch = {});

// What the scene of this seed is, in one line.
std::string random_scene_text(std::uint64_t seed);

}  // namespace lantern::measure
