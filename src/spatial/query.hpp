// Questions to any structure (the lecture, "Further Work" 1 and 2): what a ray meets first, or all
// that it meets; which bodies reach into a box, a ball or what a camera sees; which is nearest.
//
// A body is hit where `hit(id)` says, but never before the ray enters its box: a shape lies within
// its box, and only rounding could say otherwise. So the same bodies are hit, at the same places to
// the last bit, as if each body of the scene had been asked.
//
// A structure that is asked twice and watched by nobody makes what it then answers from: it must
// not be asked by two threads at once.
#pragma once

#include "base/error.hpp"
#include "base/merge_sort.hpp"
#include "spatial/query_state.hpp"

namespace lantern::spatial {

// The bodies that a query found, ascending.
struct Found {
  std::vector<BodyId> ids;
  QueryCounts counts;
  std::vector<BodyId> scratch;
};

struct NearestHit {
  std::optional<RayHit> hit;  // of two at the same distance, the lower id
  QueryCounts counts;
};

struct AllHits {
  std::vector<RayHit> hits;  // by distance, then by id
  QueryCounts counts;
  std::vector<BodyId> scratch;
};

struct NearestBody {
  std::optional<Neighbour> body;  // of two at the same distance, the lower id
  QueryCounts counts;
};

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

// --- how it is asked ---

// The nearest hit. Throws Refused for a ray that is not valid.
template <int D>
NearestHit raycast_nearest(const std::type_identity_t<StructureView<D>>& of, const Ray<D>& ray,
                           std::type_identity_t<BoxOf<D>> box_of = {}, HitAt hit = {},
                           QueryWatch told = {}) {
  require_valid(ray);
  RayQuery<D> query{{of, box_of, told}, ray, hit, nullptr, nullptr, {}};
  of.structure->ask(query);
  return {query.nearest, query.counts};
}

// All hits; else as above. The memory of `all` is used again.
template <int D>
AllHits raycast_all(const std::type_identity_t<StructureView<D>>& of, const Ray<D>& ray,
                    std::type_identity_t<BoxOf<D>> box_of = {}, HitAt hit = {},
                    QueryWatch told = {}, AllHits all = {}) {
  require_valid(ray);
  all.hits.clear();
  RayQuery<D> query{{of, box_of, told}, ray, hit, &all.hits, &all.scratch, {}};
  of.structure->ask(query);
  all.counts = query.counts;
  // They come about in order from what goes front to back.
  sort_nearly_sorted(all.hits, 16 * all.hits.size(), RayHit::before);
  all.hits.erase(std::unique(all.hits.begin(), all.hits.end()), all.hits.end());
  return all;
}

// The bodies whose boxes overlap the volume: a Box, a Ball, a Frustum or a Ray, of which neither
// order nor distances are wanted. Throws Refused for a box or ray that is not valid, a centre that
// is not finite and a radius that is negative or not finite. The memory of `found` is used again.
template <int D, template <int> class Volume>
Found overlap_query(const std::type_identity_t<StructureView<D>>& of, const Volume<D>& volume,
                    std::type_identity_t<BoxOf<D>> box_of = {}, QueryWatch told = {},
                    Found found = {}) {
  require_valid(volume);
  found.ids.clear();
  VolumeQuery<D> query{{of, box_of, told}, &volume, &found.ids, &found.scratch};
  of.structure->ask(query);
  found.counts = query.counts;
  std::ranges::sort(found.ids);
  found.ids.erase(std::ranges::unique(found.ids).begin(), found.ids.end());
  return found;
}

// The body whose box is nearest to the point, by the sum of the squares of how far it lies from it
// on each axis, in double: distances below 1e-154 count as 0, those beyond 1e154 are alike. Throws
// Refused for a point that is not finite.
template <int D>
NearestBody nearest_body(const std::type_identity_t<StructureView<D>>& of, const Vec<D>& point,
                         std::type_identity_t<BoxOf<D>> box_of = {}, QueryWatch told = {}) {
  if (!is_finite(point)) throw Refused("nearest body: the point is not finite");
  NearestQuery<D> query{{of, box_of, told}, point, {}};
  of.structure->ask(query);
  return {query.nearest, query.counts};
}

}  // namespace lantern::spatial
