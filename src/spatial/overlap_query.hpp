// Which bodies reach into a box or a ball, through any structure.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "spatial/query.hpp"

namespace lantern {

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

template <int D>
struct BoxProbe {
  using Part = Everywhere;
  const Box<D>& box;

  Everywhere whole() const { return {}; }
  std::optional<Everywhere> in_box(const Box<D>& zone) const {
    return overlap(box, zone) ? std::optional(Everywhere{}) : std::nullopt;
  }
  std::optional<Everywhere> beside(Everywhere, const Plane<D>& plane, bool front) const {
    const Reach sides = reach(box, plane);
    return (front ? sides.front : sides.back) ? std::optional(Everywhere{}) : std::nullopt;
  }
};

template <int D>
struct BallProbe {
  using Part = Everywhere;
  const Ball<D>& ball;

  Everywhere whole() const { return {}; }
  std::optional<Everywhere> in_box(const Box<D>& zone) const {
    return overlap(ball, zone) ? std::optional(Everywhere{}) : std::nullopt;
  }
  // Generous by more than the error of the height.
  std::optional<Everywhere> beside(Everywhere, const Plane<D>& plane, bool front) const {
    constexpr double kError = 64 * std::numeric_limits<double>::epsilon();
    double sum = std::abs(plane.offset), square = 0;
    for (int i = 0; i < D; ++i) {
      sum += std::abs(plane.normal[i] * ball.center[i]);
      square += plane.normal[i] * plane.normal[i];
    }
    const double h = height(ball.center, plane);
    const double most = (front ? h : -h) + ball.radius * std::sqrt(square);
    if (most < -kError * (sum + ball.radius)) return std::nullopt;
    return Everywhere{};
  }
};

struct AlwaysTrue {
  bool operator()(BodyId) const { return true; }
};

// The bodies whose boxes overlap the box, and for which `exact(id) -> bool` holds, if given.
// `box_of(id)` is the box with which the body was inserted. Throws Refused for a box that is not
// valid.
template <int D, class Structure, class BoxOf, class Exact = AlwaysTrue,
          class Observer = NoQueryObserver>
Found overlap_query(const Structure& structure, const Box<D>& box, BoxOf&& box_of,
                    Exact&& exact = {}, Observer&& told = {}) {
  if (!is_valid(box)) throw Refused("overlap query: the box is not finite or inverted");
  Found found;
  const auto test = [&](BodyId id) {
    if (!overlap(box, box_of(id)) || !exact(id)) return false;
    found.ids.push_back(id);
    return true;
  };
  const auto enter = [](Everywhere) { return true; };
  found.counts = walk<D>(structure, BoxProbe<D>{box}, Vec<D>(0.0), enter, test, told);
  std::sort(found.ids.begin(), found.ids.end());
  return found;
}

// The same with a ball. Throws Refused for a centre that is not finite and a radius that is
// negative or not finite.
template <int D, class Structure, class BoxOf, class Exact = AlwaysTrue,
          class Observer = NoQueryObserver>
Found overlap_query(const Structure& structure, const Ball<D>& ball, BoxOf&& box_of,
                    Exact&& exact = {}, Observer&& told = {}) {
  if (!is_valid(Box<D>{ball.center, ball.center}) || !std::isfinite(ball.radius) || ball.radius < 0)
    throw Refused("overlap query: the ball's centre or radius is not finite, or it is negative");
  Found found;
  const auto test = [&](BodyId id) {
    if (!overlap(ball, box_of(id)) || !exact(id)) return false;
    found.ids.push_back(id);
    return true;
  };
  const auto enter = [](Everywhere) { return true; };
  found.counts = walk<D>(structure, BallProbe<D>{ball}, Vec<D>(0.0), enter, test, told);
  std::sort(found.ids.begin(), found.ids.end());
  return found;
}

}  // namespace lantern
