// Impacts: bodies that bounce or are fast meet at the very moment, not at the end of a step.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "physics/contact_solver.hpp"
#include "physics/impact_log.hpp"

namespace lantern::physics {

// The numbers of impacts: how their times are found, and how the blows are resolved.
struct ImpactSettings {
  int most_advances = 200;            // towards one impact
  double overshoot = 1.05;            // of the way to where they would meet at their speed
  int most_cuts = 60;                 // of the time between apart and overlapping
  double near = 1e-9;                 // of the thinner one's thickness: points so near each other
                                      // touch at a time; what gets no nearer in half of all
                                      // advances is there
  double touches = 1e-15;             // of the sizes: so near is at the moment of the impact
  double shortest_bounce = 1.0 / 32;  // of a step: one that would be shorter is none
  int most_rests = 3;                 // in a step: a pair that rests so often does not bounce again
  double speed_by_rounding = 1e-12;   // of both speeds: what approaches slower is at rest
  int bouncing_rounds = 64;           // through all touching pairs, in one impact
  int most_rounds = 96;               // the last ones without restitution
  int most_point_sweeps = 200;        // over the points of one pair
  double change = 1e-15;              // of the largest impulse: so small a one ends these sweeps
  double touching = 4e-9;             // of the thinner one's: so near is struck, too
  double gain_by_rounding = 1e-12;    // of the blow's energy: so small a gain of it is none
};
inline constexpr ImpactSettings kImpactSettings;

// How a body flies for a while: x(t) = position + t velocity + t^2 bend.
template <int D>
struct Trajectory {
  const Body<D>* body = nullptr;
  Vec<D> velocity{0.0};
  Vec<D> bend{0.0};
  RotationMethod rotation = RotationMethod::splitting_2;
  double held = 0;  // acceleration that forces would give it, if it did not rest on something
};

template <int D>
double thinner(const Body<D>& a, const Body<D>& b) {
  return std::min(thickness<D>(a.shape), thickness<D>(b.shape));
}

struct TimeOfImpact {
  double seconds = 0;
  bool rests = false;  // too slow for an impact: from then on it is a contact
};

// The first moment within `within` seconds at which the two bodies touch and approach; nothing if
// there is none. By conservative advancement (Mirtich, "Impulse-based Dynamic Simulation", 1996):
// go on for as long as they surely cannot touch. What approaches more slowly than `slow` is said to
// rest. Farther apart than `reach` they are not looked at. `work` counts each look at the two, by
// the narrow phase. `looks`, if there is one, is told each, `begun` seconds after its step began.
template <int D>
std::optional<TimeOfImpact> time_of_impact(const Trajectory<D>& a, const Trajectory<D>& b,
                                           double within, double slow, double reach,
                                           WorldWork& work,
                                           std::vector<ImpactLook<D>>* looks = nullptr,
                                           double begun = 0);

// A bounce that would end within a small share of `step` seconds is none. So a ball that bounces
// lower and lower comes to rest after finitely many impacts. This is the speed of such a bounce.
template <int D>
double slowest_impact(const Trajectory<D>& a, const Trajectory<D>& b, double step);

// Moves the island by a step of `h` seconds, from impact to impact and on to the end; in between by
// the solver. At most `budget` impacts are located; it shrinks by those that were. `log` is told of
// them.
template <int D>
void move_through_impacts(Island<D>& island, const ContactSolver<D>& solver,
                          const WorldConfig<D>& config, double h, int& budget, WorldWork& work,
                          ImpactLog<D>& log);

}  // namespace lantern::physics
