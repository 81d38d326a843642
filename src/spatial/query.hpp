// Questions to any structure (the lecture, "Further Work" 1 and 2): what a ray meets first, or all
// that it meets; which bodies reach into a box, a ball or what a camera sees.
//
// A body is hit where `hit(id)` says, but never before the ray enters its box: a shape lies within
// its box, and only rounding could say otherwise. So the same bodies are hit, at the same places to
// the last bit, as if each body of the scene had been asked.
//
// A structure that is asked twice and watched by nobody makes what it then answers from: it must
// not be asked by two threads at once.
#pragma once

#include <cmath>
#include <variant>

#include "base/error.hpp"
#include "geometry/not_finite.hpp"
#include "geometry/ray.hpp"
#include "spatial/structure.hpp"

namespace lantern::spatial {

struct QueryCounts {
  std::uint64_t nodes_visited = 0;
  std::uint64_t nodes_skipped = 0;   // their whole branches were; what lies below is not counted
  std::uint64_t objects_tested = 0;  // each at most once, as far as it is watched
  // Rounded boxes of bodies, several compared by one instruction to find those to be tested; 0
  // where it is watched.
  std::uint64_t boxes_compared = 0;

  QueryCounts& operator+=(const QueryCounts& other) {
    nodes_visited += other.nodes_visited;
    nodes_skipped += other.nodes_skipped;
    objects_tested += other.objects_tested;
    boxes_compared += other.boxes_compared;
    return *this;
  }
};

// What a query does, told while it does it.
struct QueryEvent {
  enum class Kind {
    visit,  // the node is entered
    skip,   // the node and all below it are left out
    test,   // the body, met in this leaf for the first time, is tested
    hit,    // and was found
  };
  Kind kind{};
  NodeHandle node = 0;
  BodyId body = 0;
};
using QueryWatch = FunctionRef<void(const QueryEvent&)>;

// The bodies that a query found, ascending.
struct Found {
  std::vector<BodyId> ids;
  QueryCounts counts;
  std::vector<BodyId> scratch;
};

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
  std::vector<BodyId> scratch;
};

struct Neighbour {
  BodyId id = 0;
  double square = 0;  // of the distance
  bool operator==(const Neighbour&) const = default;
  static bool before(const Neighbour& a, const Neighbour& b) {
    return a.square < b.square || (a.square == b.square && a.id < b.id);
  }
};

struct NearestBody {
  std::optional<Neighbour> body;  // of two at the same distance, the lower id
  QueryCounts counts;
};

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

// Whether the ray meets it: all that is asked where no order is.
template <int D>
bool overlap(const Ray<D>& ray, const Box<D>& box) {
  return span_in(ray, box).has_value();
}

// How far the box lies from the point on each axis: 0 where it reaches beyond it.
template <int D, class AnyBox>
Vec<D> gaps(const Vec<D>& point, const AnyBox& box) {
  Vec<D> all;
  for (int i = 0; i < D; ++i) all[i] = std::max({box.lo[i] - point[i], point[i] - box.hi[i], 0.0});
  return all;
}
// Rounded monotonically: gaps that are no smaller have no smaller square.
template <int D>
double square_of(const Vec<D>& gaps) {
  double sum = 0;
  for (int i = 0; i < D; ++i) sum += gaps[i] * gaps[i];
  return sum;
}

// The box with which a body was inserted.
template <int D>
using BoxOf = FunctionRef<Box<D>(BodyId)>;
// The least t at which a ray meets the body's true shape; asked only where it meets its box.
using HitAt = FunctionRef<std::optional<double>(BodyId)>;

// --- a query on its way through a structure, which calls bodies by its own ids ---

template <int D>
struct QueryOf {
  StructureView<D> view;
  BoxOf<D> box_of;  // none: as the view says
  QueryWatch told;  // none: nobody is told
  QueryCounts counts = {};

  Box<D> box(BodyId id) const { return box_of ? box_of(view.name(id)) : view.bodies[id].box; }
  // Its box will soon be asked for: bodies that lie side by side in a tree lie anywhere in memory,
  // and to wait for one after another would take longer than all else.
  void fetch(BodyId id) const {
    if (box_of) return;
    __builtin_prefetch(&view.bodies[id].box.lo);
    __builtin_prefetch(&view.bodies[id].box.hi[D - 1]);
  }
  void tell(QueryEvent::Kind kind, NodeHandle node, BodyId id = 0) const {
    if (told) told(QueryEvent{kind, node, id});
  }
};

template <int D>
struct RayQuery : QueryOf<D> {
  const Ray<D>& ray;
  HitAt hit;                      // none: where it enters the body's box
  std::vector<RayHit>* all;       // null: only the nearest
  std::vector<BodyId>* scratch;   // if there is `all`
  std::optional<RayHit> nearest;  // of those tested so far, if only that is wanted

  double limit() const { return nearest ? nearest->distance : ray.length; }
  // Whether it is hit; not beyond the ray's end.
  bool test(BodyId id) {
    const auto span = span_in(ray, this->box(id));
    if (!span) return false;
    RayHit found{this->view.name(id), span->from};
    if (hit) {
      const std::optional<double> t = hit(found.id);
      if (!t) return false;
      found.distance = std::max(*t, found.distance);
    }
    if (found.distance > ray.length) return false;
    if (all != nullptr)
      all->push_back(found);
    else if (!nearest || RayHit::before(found, *nearest))
      nearest = found;
    return true;
  }
};

template <int D>
struct VolumeQuery : QueryOf<D> {
  std::variant<const Box<D>*, const Ball<D>*, const Frustum<D>*, const Ray<D>*> volume;
  std::vector<BodyId>* found;
  std::vector<BodyId>* scratch;
};

template <int D>
struct NearestQuery : QueryOf<D> {
  const Vec<D>& point;
  std::optional<Neighbour> nearest;  // of those tested so far

  double limit() const { return nearest ? nearest->square : kInfinity; }
  bool test(BodyId id) {
    const Neighbour found{this->view.name(id), square_of(gaps(point, this->box(id)))};
    const bool is_nearer = !nearest || Neighbour::before(found, *nearest);
    if (is_nearer) nearest = found;
    return is_nearer;
  }
};

// Merges runs of twice the length each time: n log2 n comparisons at most, and always the same
// ones, since they are counted. Those of std::sort are up to the library.
template <class T, class Before>
void merge_sort(std::vector<T>& list, const Before& before) {
  const std::size_t count = list.size();
  std::vector<T> merged;
  merged.reserve(count);
  for (std::size_t run = 1; run < count; run *= 2) {
    merged.clear();
    for (std::size_t low = 0; low < count; low += 2 * run) {
      const std::size_t middle = std::min(low + run, count), end = std::min(low + 2 * run, count);
      for (std::size_t a = low, b = middle; a < middle || b < end;)
        merged.push_back(a == middle || (b < end && before(list[b], list[a])) ? list[b++]
                                                                              : list[a++]);
    }
    list.swap(merged);
  }
}

// What is nearly in order is put in order by moving each a little; else, after `most` moves, by
// sorting it. How many moves it took.
template <class T, class Before>
std::size_t sort_nearly_sorted(std::vector<T>& list, std::size_t most, const Before& before) {
  std::size_t moves = 0;
  for (std::size_t i = 1; i < list.size(); ++i) {
    const T one = list[i];
    std::size_t hole = i;
    for (; hole > 0 && moves < most && before(one, list[hole - 1]); --hole, ++moves)
      list[hole] = list[hole - 1];
    list[hole] = one;
    if (moves < most) continue;
    merge_sort(list, before);
    break;
  }
  return moves;
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
// order nor distances are wanted. Throws Refused for a box
// that is not valid, a centre that is not finite and a radius that is negative or not finite. The
// memory of `found` is used again.
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
