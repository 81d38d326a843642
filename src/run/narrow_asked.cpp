#include "run/narrow_asked.hpp"

#include <algorithm>

#include "base/check.hpp"
#include "base/stop.hpp"
#include "physics/gjk.hpp"
#include "physics/manifold.hpp"
#include "run/structure_picture.hpp"

namespace lantern::run {
namespace {

FrameAxis axis_of(const MeasuredAxis<2>& measured, const Body<2>& a, const Body<2>& b) {
  using Across = MeasuredAxis<2>::Across;
  const Vec<2> n = measured.normal;
  FrameAxis axis;
  axis.direction = n;
  axis.separation = measured.separation;
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

}  // namespace

// At margin 0 the first gap ends the test. Where there is none, its answer is the contact's normal.
template <int D>
FrameSeparation axes_between(const Body<D>& a, const Body<D>& b) {
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
  } else {
    LANTERN_CHECK(D, ==, 2);
  }
  return separation;
}

template <int D>
ShapeTests tests_of_shapes(const World<D>& world) {
  ShapeTests tests;
  NarrowTrace<D> trace;
  const auto awake = [&](BodyId id) { return world.find(id)->stirs(); };
  tests.tested = world.broad_phase()->pair_chain(awake, kMostPairs).pairs;
  for (const Pair& pair : tests.tested) {
    stop_if_asked();
    const Body<D>&a = *world.find(pair.a), &b = *world.find(pair.b);
    const auto manifold = collide<D>(placed(a), placed(b), 0, trace);
    if (!manifold) continue;
    FrameContact& contact = tests.touching.emplace_back();
    contact.pair = pair;
    contact.normal = solid(manifold->normal);
    for (const ManifoldPoint<D>& p : manifold->points())
      contact.points.push_back({solid(p.position), p.separation, 0});
  }
  tests.work = trace.lengths;
  return tests;
}

template <int D>
FrameSearch distance_search(const Body<D>& a, const Body<D>& b) {
  FrameSearch search;
  search.a = a.id;
  search.b = b.id;
  if constexpr (D == 2) {
    search.answer = gjk(placed(a), placed(b), &search.steps);
    LANTERN_CHECK(search.answer.has_value(), ==, true);
  } else {
    LANTERN_CHECK(D, ==, 2);
  }
  return search;
}

template <int D>
std::optional<FrameDifference> difference_of(const Body<D>& a, const Body<D>& b) {
  if constexpr (D == 2) {
    const auto found = minkowski_difference(placed(a), placed(b));
    if (found) return FrameDifference{a.id, b.id, found->corners, found->radius};
  }
  return std::nullopt;
}

template FrameSeparation axes_between(const Body<2>&, const Body<2>&);
template FrameSeparation axes_between(const Body<3>&, const Body<3>&);
template ShapeTests tests_of_shapes(const World<2>&);
template ShapeTests tests_of_shapes(const World<3>&);
template FrameSearch distance_search(const Body<2>&, const Body<2>&);
template FrameSearch distance_search(const Body<3>&, const Body<3>&);
template std::optional<FrameDifference> difference_of(const Body<2>&, const Body<2>&);
template std::optional<FrameDifference> difference_of(const Body<3>&, const Body<3>&);

}  // namespace lantern::run
