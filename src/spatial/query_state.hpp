// What a question is while it is on its way through a structure: what it counts, tells and finds.
#pragma once

#include <cmath>
#include <variant>

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

struct RayHit {
  BodyId id = 0;
  double distance = 0;  // t along the ray
  bool operator==(const RayHit&) const = default;
  // The order in which a ray meets them.
  static bool before(const RayHit& a, const RayHit& b) {
    return a.distance < b.distance || (a.distance == b.distance && a.id < b.id);
  }
};

struct Neighbour {
  BodyId id = 0;
  double square = 0;  // of the distance
  bool operator==(const Neighbour&) const = default;
  static bool before(const Neighbour& a, const Neighbour& b) {
    return a.square < b.square || (a.square == b.square && a.id < b.id);
  }
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

  Box<D> box(BodyId id) const { return box_of ? box_of(view.name(id)) : view.boxes[id]; }
  // Its box will soon be asked for: bodies that lie side by side in a tree lie anywhere in memory,
  // and to wait for one after another would take longer than all else.
  void fetch(BodyId id) const {
    if (box_of) return;
    __builtin_prefetch(&view.boxes[id].lo);
    __builtin_prefetch(&view.boxes[id].hi[D - 1]);
  }
  void tell(QueryEvent::Kind kind, NodeHandle node, BodyId id = 0) const {
    if (told) told(QueryEvent{kind, node, id});
  }
};

template <int D>
struct RayQuery : QueryOf<D> {
  const Ray<D>& ray;
  HitAt hit;                                     // none: where it enters the body's box
  std::vector<RayHit>* all;                      // null: only the nearest
  std::vector<BodyId>* scratch;                  // if there is `all`
  std::optional<RayHit> nearest;                 // of those tested so far, if only that is wanted
  std::optional<std::vector<BodyId>> only = {};  // ascending: all others are not met

  double limit() const { return nearest ? nearest->distance : ray.length; }
  // Whether it is hit; not beyond the ray's end.
  bool test(BodyId id) {
    if (only && !std::ranges::binary_search(*only, id)) return false;
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

}  // namespace lantern::spatial
