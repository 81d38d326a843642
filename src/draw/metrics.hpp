// Measures of the page, in units of a page that is 900 high, and the helpers that use them.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "draw/draw_list.hpp"

namespace lantern {

inline constexpr double kLeastCaption = 23.4;  // 2.6 % of 900
inline constexpr double kLeastLabel = 17.1;    // 1.9 % of 900
inline constexpr double kLabel = 19;

// The least of `box` that a text or shape `inset` inside it may use.
inline Box<2> shrunk(const Box<2>& box, double inset) {
  return {box.lo + Vec<2>(inset), box.hi - Vec<2>(inset)};
}

inline bool holds(const Box<2>& outer, const Box<2>& inner) {
  return outer.lo.x <= inner.lo.x && outer.lo.y <= inner.lo.y && inner.hi.x <= outer.hi.x &&
         inner.hi.y <= outer.hi.y;
}

// Parts of an area beside each other along an axis, as wide as their shares, with gaps between
// them.
inline std::vector<Box<2>> split(const Box<2>& area, int axis, const std::vector<double>& shares,
                                 double gap) {
  const double all = std::accumulate(shares.begin(), shares.end(), 0.0);
  const double room = area.size()[axis] - gap * (static_cast<double>(shares.size()) - 1);
  std::vector<Box<2>> parts;
  double at = area.lo[axis];
  for (const double share : shares) {
    Box<2>& part = parts.emplace_back(area);
    part.lo[axis] = at;
    part.hi[axis] = at + room * share / all;
    at = part.hi[axis] + gap;
  }
  return parts;
}

// The part of its greatest length that a velocity's arrow has, in a world `extent` long. Speeds
// far above the world's measure are pressed together, so that the scale depends on no other body
// and an arrow changes from frame to frame only as its own body does.
inline double arrow_share(double speed, double extent) {
  const double half = 0.12 * extent;  // this far in a second: half the length
  return speed > 0 && half > 0 ? speed / (speed + half) : 0;
}

// Of a spring or joint that is stretched, pressed together, or neither: by colour, and the more the
// heavier. `strain` is the change of length, as a part of the length at rest.
inline Stroke strain_stroke(double strain) {
  constexpr double kRest = 0.005;
  const double size = std::min(std::abs(strain), 1.0);
  if (!(size > kRest)) return {Role::quiet_ink, 2.2};
  return {strain > 0 ? Role::warning : Role::ray, 2.4 + 3.2 * size, 0};
}

}  // namespace lantern
