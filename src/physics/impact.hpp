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
};

template <int D>
struct Meeting {
  double time = 0;
  bool rests = false;  // too slow for an impact: from then on it is a contact
};

// The first moment within `within` seconds at which the two bodies touch and approach; nothing if
// there is none. By conservative advancement (Mirtich, "Impulse-based Dynamic Simulation", 1996):
// go on for as long as they surely cannot touch. What would part for less than a small share of
// `step` seconds only is said to rest. Farther apart than `reach` they are not looked at. `counted`
// grows by the narrow phase's calls.
template <int D>
std::optional<Meeting<D>> meeting(const Course<D>& a, const Course<D>& b, double within,
                                  double step, double reach, std::uint64_t& counted);

// How fast a body's surface can move because it turns, per radian: 0 for balls.
template <int D>
double turning_reach(const Shape<D>& shape);

// Half of the smallest width; endless for a half-space.
template <int D>
double thickness(const Shape<D>& shape);

// All pairs that touch and approach get the impulses of an impact, one pair after another until
// none approaches: so the blow runs through a row of balls. Returns how many impacts there were.
template <int D>
int resolve_impacts(Island<D>& island, WorldWork& work);

}  // namespace lantern
