// When two bodies meet, and what happens then.
#pragma once

#include <optional>

#include "physics/island.hpp"

namespace lantern {

// How a body flies for a while: x(t) = position + t velocity + t^2 bend.
template <int D>
struct Course {
  const Body<D>* body = nullptr;
  Vec<D> velocity{0.0};
  Vec<D> bend{0.0};
  RotationMethod rotation = RotationMethod::splitting_2;
  double held = 0;  // acceleration that forces would give it, if it did not rest on something
};

template <int D>
struct Meeting {
  double time = 0;
  bool rests = false;  // too slow for an impact: from then on it is a contact
};

// The first moment within `within` seconds at which the two bodies touch and approach; nothing if
// there is none. By conservative advancement (Mirtich, "Impulse-based Dynamic Simulation", 1996):
// go on for as long as they surely cannot touch. What approaches more slowly than `slow` is said to
// rest. Farther apart than `reach` they are not looked at. `counted` grows by the narrow phase's
// calls.
template <int D>
std::optional<Meeting<D>> meeting(const Course<D>& a, const Course<D>& b, double within,
                                  double slow, double reach, std::uint64_t& counted);

// A bounce that would end within a small share of `step` seconds is none. So a ball that bounces
// lower and lower comes to rest after finitely many impacts. This is the speed of such a bounce.
template <int D>
double slowest_impact(const Course<D>& a, const Course<D>& b, double step);

// How fast a body's surface can move because it turns, per radian: 0 for balls.
template <int D>
double turning_reach(const Shape<D>& shape);

// Half of the smallest width; endless for a half-space.
template <int D>
double thickness(const Shape<D>& shape);

// All pairs that touch and approach get the impulses of an impact, one pair after another until
// none approaches: so the blow runs through a row of balls. Pairs between which it does not come to
// an end become contacts. Returns how many impacts there were.
template <int D>
int resolve_impacts(Island<D>& island, WorldWork& work);

}  // namespace lantern
