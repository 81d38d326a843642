// What a world is asked, and what it answers: what a ray meets, a view sees and a region holds;
// what the narrow phase tells of two bodies; what several structures do for the same bodies.
#pragma once

#include "base/check.hpp"
#include "base/stop.hpp"
#include "physics/gjk.hpp"
#include "physics/manifold.hpp"
#include "run/engine.hpp"
#include "run/players.hpp"
#include "spatial/pairs.hpp"
#include "spatial/query.hpp"

namespace lantern::run {

template <int D>
class Queries {
 public:
  explicit Queries(const World<D>& world) : world_(world) {}

  Finding answer(const CastRay& cast) {
    Ray<D> ray;
    ray.origin = in_dimension<D>(cast.from);
    const Vec<D> way = in_dimension<D>(cast.to) - ray.origin;
    ray.length = glm::length(way);
    ray.direction = way / ray.length;
    const auto meets = [&](BodyId id) {
      const Body<D>& b = *world_.find(id);
      const std::optional<double> at = entry(ray, b.shape, b.position, b.orientation);
      const auto in_box = span_in(ray, b.box());  // before it, nothing is hit
      if (at && in_box) note_met(id, std::max(*at, in_box->from), ray);
      return at;
    };
    std::vector<RayHit> hits;
    look([&](const StructureView<D>& tree, BoxOf<D> box_of, QueryWatch told) {
      if (cast.all) {
        const AllHits all = raycast_all(tree, ray, box_of, meets, told);
        hits.insert(hits.end(), all.hits.begin(), all.hits.end());
        return all.counts;
      }
      const NearestHit nearest = raycast_nearest(tree, ray, box_of, meets, told);
      if (nearest.hit) hits.push_back(*nearest.hit);
      return nearest.counts;
    });
    std::ranges::sort(hits, RayHit::before);
    if (!cast.all && hits.size() > 1) hits.resize(1);
    found_.ray = FrameRay{cast.from, cast.to, {}};
    found_.nearest = !cast.all;
    found_.asked = cast.to;
    for (const RayHit& hit : hits) {
      found_.hits.push_back(hit.id);
      found_.ray->hits.push_back({hit.id, solid(ray.at(hit.distance))});
    }
    if (!cast.all && !hits.empty()) found_.ray->to = found_.ray->hits[0].position;
    return std::move(found_);
  }

  Finding answer(const Cull& view) {
    const Frustum<D> frustum = frustum_of(view);
    look([&](const StructureView<D>& tree, BoxOf<D> box_of, QueryWatch told) {
      return add(overlap_query(tree, frustum, box_of, told));
    });
    found_.view = FrameView{view.eye, corners_of(frustum)};
    return sorted();
  }

  Finding answer(const Query& region) {
    const Box<D> box = in_dimension<D>(region.box);
    const Ball<D> ball{box.center(), region.radius};
    look([&](const StructureView<D>& tree, BoxOf<D> box_of, QueryWatch told) {
      return add(region.radius > 0 ? overlap_query(tree, ball, box_of, told)
                                   : overlap_query(tree, box, box_of, told));
    });
    found_.region = FrameQuery{region.box, region.radius};
    return sorted();
  }

 private:
  void note_met(BodyId id, double distance, const Ray<D>& ray) {
    found_.met[id] = {distance, solid(ray.at(distance))};
  }

  void look(FunctionRef<QueryCounts(const StructureView<D>&, BoxOf<D>, QueryWatch)> f) {
    const auto told = [&](const QueryEvent& event) { found_.walk.push_back(event); };
    const auto box_of = [&](BodyId id) { return world_.find(id)->box(); };
    const std::vector<StructureView<D>> structures = world_.broad_phase()->each();
    for (std::size_t i = 0; i < structures.size(); ++i) {
      if (i == 1) found_.first_static = found_.walk.size();
      found_.counts += f(structures[i], box_of, told);
    }
  }

  QueryCounts add(const Found& found) {
    found_.hits.insert(found_.hits.end(), found.ids.begin(), found.ids.end());
    return found.counts;
  }

  Finding sorted() {
    std::ranges::sort(found_.hits);
    return std::move(found_);
  }

  static Frustum<D> frustum_of(const Cull& view) {
    constexpr double kAspect = 16.0 / 9.0;
    if constexpr (D == 2)
      return view_wedge(flat(view.eye), flat(view.target - view.eye), view.angle, view.near,
                        view.far);
    else
      return view_frustum(view.eye, view.target, up_of(view.target - view.eye), view.angle, kAspect,
                          view.near, view.far);
  }

  // Upwards, but for a view straight up or down: there the picture's top is the world's back.
  static Vec<3> up_of(const Vec<3>& forward) {
    const bool upright = std::abs(forward.y) > 0.999 * glm::length(forward);
    return upright ? Vec<3>(0, 0, -1) : Vec<3>(0, 1, 0);
  }

  // Round the wedge, or round the near plane and then the far one.
  static std::vector<Vec<3>> corners_of(const Frustum<D>& frustum) {
    constexpr std::size_t kFlat[] = {0, 2, 3, 1}, kSolid[] = {0, 2, 6, 4, 1, 3, 7, 5};
    std::vector<Vec<3>> corners;
    for (std::size_t i = 0; i < frustum.corners.size(); ++i)
      corners.push_back(solid(frustum.corners[D == 2 ? kFlat[i] : kSolid[i]]));
    return corners;
  }

  const World<D>& world_;
  Finding found_;
};

// What a ray meets, a view sees and a region holds: walks the world's structure, which has looked
// ahead. Throws Refused for a ray, view or region that is not valid.
template <int D>
Finding asked(const Question& question, const World<D>& world) {
  return std::visit([&](const auto& verb) { return Queries<D>(world).answer(verb); }, question);
}

inline FrameAxis axis_of(const MeasuredAxis<2>& measured, const Body<2>& a, const Body<2>& b) {
  using Across = MeasuredAxis<2>::Across;
  const Vec<2> n = measured.normal;
  FrameAxis axis{.direction = n, .separation = measured.separation};
  if (measured.across == Across::face_of_a) axis.across = a.id;
  if (measured.across == Across::face_of_b) axis.across = b.id;
  const auto farthest = [&](const Body<2>& body, const Vec<2>& along) {
    const auto points = farthest_points(placed(body), along);
    LANTERN_CHECK(points.has_value(), ==, true);
    return *points;
  };
  axis.ends = {farthest(a, -n).first, farthest(a, n).first, farthest(b, -n).first,
               farthest(b, n).first};
  if (axis.across) {  // the face that looks at the other body
    const FarthestPoints face = *axis.across == a.id ? farthest(a, n) : farthest(b, -n);
    axis.face = {face.first, face.second};
  }
  return axis;
}

// The test that contacts of a flat world are made by, its axes written down; neither body may be a
// half-space. At margin 0 the first gap ends the test. Where there is none, its answer is the
// contact's normal.
template <int D>
FrameSeparation axes_between(const Body<D>& a, const Body<D>& b) {
  LANTERN_CHECK(D, ==, 2);
  FrameSeparation separation{a.id, b.id, {}, {}};
  if constexpr (D == 2) {
    std::vector<MeasuredAxis<2>> axes;
    NarrowTrace<2> trace;
    trace.axes = &axes;
    const auto contact = collide<2>(placed(a), placed(b), 0, trace);
    LANTERN_CHECK(axes.empty(), ==, false);
    for (const MeasuredAxis<2>& axis : axes) separation.axes.push_back(axis_of(axis, a, b));
    separation.answer = axes.size() - 1;
    if (contact) {
      const auto best = std::ranges::max_element(axes, {}, [&](const MeasuredAxis<2>& axis) {
        return glm::dot(axis.normal, contact->normal);
      });
      separation.answer = static_cast<std::size_t>(best - axes.begin());
    }
  }
  return separation;
}

// Of all pairs of the world's structure, which stands.
template <int D>
ShapeTests tests_of_shapes(const World<D>& world) {
  ShapeTests tests;
  NarrowTrace<D> trace;
  tests.tested = world.pair_chain(kMostPairs).pairs;
  for (const Pair& pair : tests.tested) {
    stop_if_asked();
    const Body<D>&a = *world.find(pair.a), &b = *world.find(pair.b);
    const auto manifold = collide<D>(placed(a), placed(b), 0, trace);
    if (!manifold) continue;
    FrameContact& contact =
        tests.touching.emplace_back(FrameContact{.pair = pair, .normal = solid(manifold->normal)});
    for (const ManifoldPoint<D>& p : manifold->points())
      contact.points.push_back({solid(p.position), p.separation, 0});
  }
  tests.work = trace.lengths;
  return tests;
}

// Their distance by GJK, step by step. The same holds.
template <int D>
FrameSearch distance_search(const Body<D>& a, const Body<D>& b) {
  LANTERN_CHECK(D, ==, 2);
  FrameSearch search{.a = a.id, .b = b.id};
  if constexpr (D == 2) {
    search.answer = gjk(placed(a), placed(b), &search.steps);
    LANTERN_CHECK(search.answer.has_value(), ==, true);
  }
  return search;
}

// Nothing for half-spaces and solid worlds.
template <int D>
std::optional<FrameDifference> difference_of(const Body<D>& a, const Body<D>& b) {
  if constexpr (D == 2) {
    const auto found = minkowski_difference(placed(a), placed(b));
    if (found) return FrameDifference{a.id, b.id, found->corners, found->radius};
  }
  return std::nullopt;
}

template <int D>
std::vector<Proxy<D>> proxies_of(const World<D>& world) {
  std::vector<Proxy<D>> proxies;
  for (const Body<D>& body : world.bodies())
    if (body.collides) proxies.push_back({body.id, body.box(), !body.moves(), body.stirs()});
  return proxies;
}

// What each of these kinds does for those bodies of the scenario, placed as they enter, in one
// world step. `settings` are those of all kinds: capacity, depth limit and cells. Throws
// Refused as world and structures do, and beyond kMostPairs pairs.
template <int D>
FrameComparison::Row compare_kinds(const Scenario& scenario, const StructureSpec& settings,
                                   const std::vector<std::size_t>& bodies,
                                   const std::vector<StructureKind>& kinds) {
  Players<D> players(scenario);
  for (const std::size_t body : bodies) players.enter(body);
  const std::vector<Proxy<D>> before = proxies_of(players.world());
  FrameComparison::Row row;
  row.bodies = before.size();
  std::uint64_t never_move = 0;
  for (const Proxy<D>& proxy : before) {
    const auto index = players.index_of(proxy.id);
    row.marks.push_back(
        {solid(proxy.box), index ? scenario.bodies[*index].color : 1, proxy.is_static});
    never_move += proxy.is_static;
  }
  row.testable = testable_pairs(row.bodies, never_move);
  players.world().step(scenario.world.time_step);
  const std::vector<Proxy<D>> after = proxies_of(players.world());
  for (const StructureKind kind : kinds) {
    StructureSpec spec = settings;
    spec.kind = kind;
    spec.planes.clear();  // it chooses its own
    const BroadPhaseConfig<D> config =
        broad_phase_of<D>(spec, in_dimension<D>(scenario.world.bounds));
    row.cells.push_back({kind, structure_work<D>(config, before, after, kMostPairs)});
  }
  return row;
}

}  // namespace lantern::run
