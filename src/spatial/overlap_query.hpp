// Which bodies reach into a box, a ball or what a camera sees (the lecture, "Further Work" 2),
// through any structure.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "geometry/frustum.hpp"
#include "spatial/query.hpp"

namespace lantern::spatial {

// All points within `radius` of the centre.
template <int D>
struct Ball {
  Vec<D> center{0.0};
  double radius = 0;
};

// Sums of squares of quotients that are at most 1: they cannot overflow, and are rounded
// monotonically, so that a larger box is never missed where a smaller one is reached. The box may
// be infinite. Touching overlaps.
template <int D>
bool overlap(const Ball<D>& ball, const Box<D>& box) {
  double squares = 0;
  for (int i = 0; i < D; ++i) {
    const double gap = std::max({box.lo[i] - ball.center[i], ball.center[i] - box.hi[i], 0.0});
    if (gap > ball.radius) return false;
    if (gap > 0) squares += (gap / ball.radius) * (gap / ball.radius);
  }
  return squares <= 1;
}

// Whether it may lie within the zone of a node, which may be infinite. Of a frustum only its planes
// are looked at, which is cheap and lets some in that lie outside, near its corners.
template <int D>
bool may_overlap(const Box<D>& box, const Box<D>& zone) {
  return overlap(box, zone);
}
template <int D>
bool may_overlap(const Ball<D>& ball, const Box<D>& zone) {
  return overlap(ball, zone);
}

// Whether it may reach that side of a plane; generous by more than the error of heights.
template <int D>
bool may_reach(const Box<D>& box, const Plane<D>& plane, bool front) {
  const Reach sides = reach(box, plane);
  return front ? sides.front : sides.back;
}
template <int D>
bool may_reach(const Ball<D>& ball, const Plane<D>& plane, bool front) {
  constexpr double kError = 64 * std::numeric_limits<double>::epsilon();
  double sum = std::abs(plane.offset), square = 0;
  for (int i = 0; i < D; ++i) {
    sum += std::abs(plane.normal[i] * ball.center[i]);
    square += plane.normal[i] * plane.normal[i];
  }
  const double h = height(ball.center, plane);
  const double most = (front ? h : -h) + ball.radius * std::sqrt(square);
  return !(most < -kError * (sum + ball.radius));
}
template <int D>
bool may_reach(const Frustum<D>& frustum, const Plane<D>& plane, bool front) {
  constexpr double kError = 1024 * std::numeric_limits<double>::epsilon();
  for (const Vec<D>& corner : frustum.corners) {
    double sum = std::abs(plane.offset);
    for (int i = 0; i < D; ++i) sum += std::abs(plane.normal[i] * corner[i]);
    const double h = height(corner, plane);
    if (!((front ? h : -h) < -kError * sum)) return true;
  }
  return false;
}

template <int D>
void require_valid(const Box<D>& box) {
  if (!is_valid(box)) throw Refused("overlap query: the box is not finite or inverted");
}
template <int D>
void require_valid(const Ball<D>& ball) {
  if (!is_valid(Box<D>{ball.center, ball.center}) || !std::isfinite(ball.radius) || ball.radius < 0)
    throw Refused("overlap query: the ball's centre or radius is not finite, or it is negative");
}
template <int D>
void require_valid(const Frustum<D>&) {}  // was looked at when it was made

// A volume is in a zone or not: it has no parts.
template <int D, class Volume>
struct VolumeProbe {
  struct Part {};
  const Volume& volume;

  Part whole() const { return {}; }
  std::optional<Part> in_box(const Box<D>& zone) const {
    return may_overlap(volume, zone) ? std::optional(Part{}) : std::nullopt;
  }
  std::optional<Part> beside(Part, const Plane<D>& plane, bool front) const {
    return may_reach(volume, plane, front) ? std::optional(Part{}) : std::nullopt;
  }
};

// A box in which the volume lies.
template <int D>
Box<D> box_around(const Box<D>& box) {
  return box;
}
template <int D>
Box<D> box_around(const Ball<D>& ball) {
  Box<D> box;
  for (int i = 0; i < D; ++i) {
    const double center = ball.center[i];
    const double reach = ball.radius + 1e-15 * (std::abs(center) + ball.radius);
    box.lo[i] = center - reach;
    box.hi[i] = center + reach;
  }
  return box;
}

// The bodies whose boxes overlap the volume: a Box, a Ball or a Frustum, into `found`, whose memory
// is used again. `box_of(id)` is the box with which the body was inserted. Throws Refused for a box
// that is not valid, a centre that is not finite and a radius that is negative or not finite.
template <int D, template <int> class Volume, class Structure, class BoxOf,
          class Observer = NoQueryObserver>
void overlap_query_into(Found& found, const Structure& structure, const Volume<D>& volume,
                        BoxOf&& box_of, Observer&& told = {}) {
  require_valid(volume);
  found.ids.clear();
  const auto test = [&](BodyId id) {
    if (!overlap(volume, box_of(id))) return false;
    found.ids.push_back(id);
    return true;
  };
  const auto enter = [](const auto&) { return true; };
  const VolumeProbe<D, Volume<D>> probe{volume};
  if constexpr (HasFastWays<Structure, D> && !kIsWatched<Observer> &&
                requires { box_around(volume); }) {
    std::uint64_t tested = 0;
    const auto walked = structure.each_near(box_around(volume), [&](BodyId id, bool is_sure) {
      ++tested;
      if (std::is_same_v<Volume<D>, Box<D>> && is_sure)
        found.ids.push_back(id);
      else
        test(id);
    });
    found.counts = {walked.visited, walked.skipped, tested};
  } else {
    found.counts = walk<D>(structure, probe, Vec<D>(0.0), enter, test, told);
  }
  std::sort(found.ids.begin(), found.ids.end());
}

// The same.
template <int D, template <int> class Volume, class Structure, class BoxOf,
          class Observer = NoQueryObserver>
Found overlap_query(const Structure& structure, const Volume<D>& volume, BoxOf&& box_of,
                    Observer&& told = {}) {
  Found found;
  overlap_query_into(found, structure, volume, box_of, told);
  return found;
}

}  // namespace lantern::spatial
