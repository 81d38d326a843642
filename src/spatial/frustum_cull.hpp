// Frustum culling through any structure (the lecture, "Further Work" 2): what a camera may see.
#pragma once

#include <algorithm>
#include <optional>

#include "geometry/frustum.hpp"
#include "spatial/overlap_query.hpp"
#include "spatial/query.hpp"

namespace lantern {

// Nodes are tested against the planes of the frustum, which is cheap and lets some in that lie
// outside, near its corners; bodies are tested exactly.
template <int D>
struct FrustumProbe {
  using Part = Everywhere;
  const Frustum<D>& frustum;

  Everywhere whole() const { return {}; }
  std::optional<Everywhere> in_box(const Box<D>& zone) const {
    return may_overlap(frustum, zone) ? std::optional(Everywhere{}) : std::nullopt;
  }
  // A corner on that side, or nearer to the plane than rounding can tell.
  std::optional<Everywhere> beside(Everywhere, const Plane<D>& plane, bool front) const {
    constexpr double kError = 1024 * std::numeric_limits<double>::epsilon();
    for (const Vec<D>& corner : frustum.corners) {
      double sum = std::abs(plane.offset);
      for (int i = 0; i < D; ++i) sum += std::abs(plane.normal[i] * corner[i]);
      const double h = height(corner, plane);
      if (!((front ? h : -h) < -kError * sum)) return Everywhere{};
    }
    return std::nullopt;
  }
};

// The bodies whose boxes overlap the frustum, and for which `exact(id) -> bool` holds, if given.
// `box_of(id)` is the box with which the body was inserted.
template <int D, class Structure, class BoxOf, class Exact = AlwaysTrue,
          class Observer = NoQueryObserver>
Found frustum_cull(const Structure& structure, const Frustum<D>& frustum, BoxOf&& box_of,
                   Exact&& exact = {}, Observer&& told = {}) {
  Found found;
  const auto test = [&](BodyId id) {
    if (!overlap(frustum, box_of(id)) || !exact(id)) return false;
    found.ids.push_back(id);
    return true;
  };
  const auto enter = [](Everywhere) { return true; };
  found.counts = walk<D>(structure, FrustumProbe<D>{frustum}, Vec<D>(0.0), enter, test, told);
  std::sort(found.ids.begin(), found.ids.end());
  return found;
}

}  // namespace lantern
