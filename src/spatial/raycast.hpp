// Raycasts through any structure (the lecture, "Further Work" 1): what a ray meets first, or all
// that it meets.
//
// Nodes are entered front to back, as far as the tree's cells have such an order, and none that
// begins behind the nearest hit so far: what is left of the tree then is never looked at.
//
//     origin .--->--+--------+--------+     the hit in the first cell is nearer than where the ray
//                   |  hit   |skipped |     enters the second
//                   +--------+--------+
//
// A body is hit where `hit(id)` says, but never before the ray enters its box: a shape lies within
// its box, and only rounding could say otherwise. So the same bodies are hit, at the same places to
// the last bit, as if each body of the scene had been asked.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "geometry/ray.hpp"
#include "spatial/query.hpp"

namespace lantern::spatial {

struct RayHit {
  BodyId id = 0;
  double distance = 0;  // t along the ray
  bool operator==(const RayHit&) const = default;
  // The order in which a ray meets them.
  static bool before(const RayHit& a, const RayHit& b) {
    return a.distance < b.distance || (a.distance == b.distance && a.id < b.id);
  }
};

struct NearestHit {
  std::optional<RayHit> hit;  // of two at the same distance, the lower id
  QueryCounts counts;
};

struct AllHits {
  std::vector<RayHit> hits;  // by distance, then by id
  QueryCounts counts;
};

template <int D>
struct RayProbe {
  using Part = RaySpan;
  const Ray<D>& ray;

  RaySpan whole() const { return {0, ray.length}; }
  std::optional<RaySpan> in_box(const Box<D>& zone) const { return span_in(ray, zone); }

  // The height over the plane at t is h + t * rate, up to an error of at most e + t * r. So the
  // part in front is not longer than where (h + e) + t * (rate + r) >= 0; behind, all signs are
  // turned. Where numbers overflow, nothing is cut off.
  std::optional<RaySpan> beside(RaySpan part, const Plane<D>& plane, bool front) const {
    constexpr double kError = 64 * std::numeric_limits<double>::epsilon();
    double h = -plane.offset, rate = 0, e = std::abs(plane.offset), r = 0;
    for (int i = 0; i < D; ++i) {
      const double a = plane.normal[i] * ray.origin[i], b = plane.normal[i] * ray.direction[i];
      h += a;
      rate += b;
      e += std::abs(a);
      r += std::abs(b);
    }
    const double begin = (front ? h : -h) + e * kError;
    const double slope = (front ? rate : -rate) + r * kError;
    if (slope == 0) return begin < 0 ? std::nullopt : std::optional(part);
    if (begin + part.from * slope < 0 && begin + part.to * slope < 0) return std::nullopt;
    const double crossing = -begin / slope;
    if (slope > 0) part.from = std::max(part.from, crossing * (1 - kError));
    if (slope < 0) part.to = std::min(part.to, crossing * (1 + kError));
    return part;
  }
};

// Where the ray meets the body whose shape is exactly its box.
struct BoxIsShape {};

namespace detail {

// Where the ray meets a body, if it does; not beyond its end.
template <int D, class BoxOf, class Hit>
std::optional<RayHit> hit_of(const Ray<D>& ray, BodyId id, BoxOf& box_of, Hit& hit) {
  const auto span = span_in(ray, box_of(id));
  if (!span) return std::nullopt;
  double at = span->from;
  if constexpr (!std::is_same_v<std::remove_cvref_t<Hit>, BoxIsShape>) {
    const std::optional<double> t = hit(id);
    if (!t) return std::nullopt;
    at = std::max(*t, at);
  }
  return at > ray.length ? std::nullopt : std::optional(RayHit{id, at});
}

// Hits come about in order from what goes front to back: then they are put in order by moving each
// a little; else, after too many moves, by sorting them.
inline void sort_nearly_sorted(std::vector<RayHit>& hits) {
  std::size_t moves = 16 * hits.size();
  for (std::size_t i = 1; i < hits.size(); ++i) {
    const RayHit hit = hits[i];
    std::size_t hole = i;
    for (; hole > 0 && moves > 0 && RayHit::before(hit, hits[hole - 1]); --hole, --moves)
      hits[hole] = hits[hole - 1];
    hits[hole] = hit;
    if (moves == 0) return std::sort(hits.begin(), hits.end(), RayHit::before);
  }
}

// The bodies that the ray may meet are asked, `test(id)`; what it enters beyond `limit()` may be
// left out. Nobody watches.
template <int D, class Structure, class Limit, class Test>
QueryCounts ask_along(const Structure& structure, const Ray<D>& ray, Limit&& limit, Test&& test) {
  QueryCounts counts;
  const auto walked = structure.each_along(ray, limit, [&](BodyId id) {
    ++counts.objects_tested;
    test(id);
  });
  counts.nodes_visited = walked.visited;
  counts.nodes_skipped = walked.skipped;
  return counts;
}

}  // namespace detail

// The nearest hit. `box_of(id)` is the box with which the body was inserted; `hit(id)`, if given,
// an optional<double>: the least t at which the ray meets the body's true shape, asked only where
// it meets the box. Throws Refused for a ray that is not valid.
template <int D, class Structure, class BoxOf, class Hit = BoxIsShape,
          class Observer = NoQueryObserver>
NearestHit raycast_nearest(const Structure& structure, const Ray<D>& ray, BoxOf&& box_of,
                           Hit&& hit = {}, Observer&& told = {}) {
  require_valid(ray);
  NearestHit nearest;
  const auto enter = [&](const RaySpan& part) {
    return !nearest.hit || part.from <= nearest.hit->distance;
  };
  const auto test = [&](BodyId id) {
    const auto found = detail::hit_of(ray, id, box_of, hit);
    if (found && (!nearest.hit || RayHit::before(*found, *nearest.hit))) nearest.hit = found;
    return found.has_value();
  };
  if constexpr (HasFastWays<Structure, D> && !kIsWatched<Observer>) {
    const auto limit = [&] { return nearest.hit ? nearest.hit->distance : ray.length; };
    nearest.counts = detail::ask_along(structure, ray, limit, test);
  } else {
    nearest.counts = walk<D>(structure, RayProbe<D>{ray}, ray.direction, enter, test, told);
  }
  return nearest;
}

// All hits, into `all`, whose memory is used again; else as above.
template <int D, class Structure, class BoxOf, class Hit = BoxIsShape,
          class Observer = NoQueryObserver>
void raycast_all_into(AllHits& all, const Structure& structure, const Ray<D>& ray, BoxOf&& box_of,
                      Hit&& hit = {}, Observer&& told = {}) {
  require_valid(ray);
  all.hits.clear();
  const auto enter = [](const RaySpan&) { return true; };
  const auto test = [&](BodyId id) {
    const auto found = detail::hit_of(ray, id, box_of, hit);
    if (found) all.hits.push_back(*found);
    return found.has_value();
  };
  if constexpr (HasFastWays<Structure, D> && !kIsWatched<Observer>)
    all.counts = detail::ask_along(
        structure, ray, [&] { return ray.length; }, test);
  else
    all.counts = walk<D>(structure, RayProbe<D>{ray}, ray.direction, enter, test, told);
  detail::sort_nearly_sorted(all.hits);
}

// The same.
template <int D, class Structure, class BoxOf, class Hit = BoxIsShape,
          class Observer = NoQueryObserver>
AllHits raycast_all(const Structure& structure, const Ray<D>& ray, BoxOf&& box_of, Hit&& hit = {},
                    Observer&& told = {}) {
  AllHits all;
  raycast_all_into(all, structure, ray, box_of, hit, told);
  return all;
}

}  // namespace lantern::spatial
