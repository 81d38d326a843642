// Impacts: bodies that bounce or are fast meet at the very moment, not at the end of a step.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "physics/contact/contact_solver.hpp"

namespace lantern::physics {

// The numbers of impacts: how their times are found, and how the blows are resolved.
struct ImpactSettings {
  int most_advances = 200;  // towards one impact
  double overshoot = 1.05;  // of the way to where they would meet at their speed
  int most_cuts = 60;       // of the time between apart and overlapping
  // Of the thinner one's thickness: points so near each other touch at a time; what gets no nearer
  // in half of all advances is there.
  double near = 1e-9;
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

// Two bodies that may meet.
template <int D>
struct Encounter {
  const Trajectory<D>&a, &b;
  double within;                           // seconds
  double slow;                             // what approaches more slowly is said to rest
  double reach;                            // farther apart they are not looked at
  WorldWork& work;                         // counts each look at the two, by the narrow phase
  std::vector<ImpactLook<D>>* looks = {};  // is told each, if there is one,
  double begun = 0;                        // so many seconds after its step began
};

struct TimeOfImpact {
  double seconds = 0;
  bool rests = false;  // too slow for an impact: from then on it is a contact
};

// The first moment at which the two bodies touch and approach; nothing if there is none. By
// conservative advancement (Mirtich, "Impulse-based Dynamic Simulation", 1996): go on for as long
// as they surely cannot touch.
template <int D>
std::optional<TimeOfImpact> time_of_impact(const Encounter<D>& of);

// A body at a moment of its free flight.
template <int D>
struct Flying {
  Shape<D> shape{};
  Vec<D> position{0.0};
  Mat<D> axes{1.0};  // of its core, as columns
  Vec<D> velocity{0.0};
  Spin<D> spin{0.0};   // radians a second
  double pull = 0;     // its centre is accelerated by so much, never more
  double fastest = 0;  // it never spins faster
  double swerve = 0;   // acceleration of a point that is 1 from the centre, by turning alone
};

// The most that a free body's spin becomes as it wanders: exact, since the energy and |L| are kept.
template <int D>
double fastest_spin(const Body<D>& body);

// Seconds, at most `within`, in which the two are sure not to touch. `normal` points from a to b
// and nearly parts them; the better it does, the longer. What is no deeper than `depth` along it
// counts as apart: touching bodies may part.
//
// They are apart as long as all corners are on their sides of a plane. Planes that stay as they
// are, and such as turn with a or with b, are tried: the last is best for a corner near a face.
// Along each corners fly on parabolas at worst.
template <int D>
double sure_advance(const Flying<D>& a, const Flying<D>& b, const Vec<D>& normal, double depth,
                    double within);

// Moves the island from impact to impact and on to the end; in between by the solver. At most
// `budget` impacts are located; it shrinks by those that were. `log` is told of them.
template <int D>
void move_through_impacts(const IslandMove<D>& move, const ContactSolver& solver, int& budget,
                          ImpactLog<D>& log);

}  // namespace lantern::physics
