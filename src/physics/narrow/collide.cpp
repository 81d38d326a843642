// The narrow phase: the closed forms of pairs of shapes, and which pair has which, or a search.
#include <algorithm>
#include <array>
#include <span>
#include <variant>

#include "physics/narrow/cores.hpp"

namespace lantern::physics {
namespace narrow {
namespace {

// Of cores whose closest points are apart along `normal`: `on_a` is that of the first.
template <int D>
inline Contact<D> touch_along(const Direction<D>& normal, const Vec<D>& on_a, double radius_a,
                              double radius_b, double margin, NarrowTrace<D>& trace) {
  const double separation = normal.length - radius_a - radius_b;
  trace.note(normal.unit, separation, AxisAcross::closest_points);
  if (separation > margin) return std::nullopt;
  return one_point(on_a, radius_a, radius_b, normal);
}

// --- a sphere against a sphere, a box, a capsule ---

// The point of the other core that is closest to the centre.
template <int D>
Contact<D> touch_points(const PlacedCore<D>& a, const PlacedCore<D>& b, double margin,
                        NarrowTrace<D>& trace) {
  const Direction<D> normal = direction_of(b.center - a.center, fallback_normal<D>());
  trace.lengths += 1;
  return touch_along(normal, a.center, a.radius, b.radius, margin, trace);
}

// A centre inside the box leaves it by the closest face; the first of equally close ones.
//
//     ________
//    |   <-x  |      x: the centre
//    |________|
template <int D>
Contact<D> touch_point_and_box(const PlacedCore<D>& a, const PlacedCore<D>& b, double margin,
                               NarrowTrace<D>& trace) {
  const Vec<D> center = b.local(a.center);
  const Vec<D> outside = center - glm::clamp(center, -b.half, b.half);
  Direction<D> normal = direction_of(-outside, Vec<D>(0.0));  // from the sphere into the box
  if (normal.length == 0) {
    int axis = 0;
    for (int i = 1; i < D; ++i)
      if (b.half[i] - std::abs(center[i]) < b.half[axis] - std::abs(center[axis])) axis = i;
    normal.unit[axis] = center[axis] < 0 ? 1 : -1;
    normal.length = std::abs(center[axis]) - b.half[axis];
  }
  normal.unit = b.axes * normal.unit;
  trace.lengths += 1 + D;
  return touch_along(normal, a.center, a.radius, 0.0, margin, trace);
}

// A centre on the capsule's segment leaves it sideways.
template <int D>
Contact<D> touch_point_and_segment(const PlacedCore<D>& a, const PlacedCore<D>& b, double margin,
                                   NarrowTrace<D>& trace) {
  const Vec<D> to_segment = closest_point(b.segment(), a.center) - a.center;
  const Direction<D> normal = direction_of(to_segment, b.axes[0]);
  trace.lengths += 3;  // two of them for the closest point
  return touch_along(normal, a.center, a.radius, b.radius, margin, trace);
}

// --- two capsules ---

// Segments at a larger angle than this (its sine, about 6 degrees) meet in one point.
constexpr double kMostParallel = 0.1;

// The two ends of where segment b lies along segment a.
//
//          b  o------------o            n: normal, from a to b
//        x            x    |
//   a  o-+------------+    | <- the points x are midway between the surfaces
//
// Nothing if they cross rather than lie along each other, or hardly overlap.
template <int D>
Contact<D> two_points(const PlacedCore<D>& a, const PlacedCore<D>& b, const Direction<D>& normal,
                      double margin) {
  const Vec<D> along = a.along(), n = normal.unit;
  if (std::abs(glm::dot(along, n)) > kMostParallel) return std::nullopt;
  const double turn = glm::dot(along, b.along());
  if (std::abs(turn) < std::sqrt(1 - kMostParallel * kMostParallel)) return std::nullopt;

  const double middle = glm::dot(b.center - a.center, along);
  const double reach = b.half.y * std::abs(turn);
  const double from = std::max(-a.half.y, middle - reach);
  const double to = std::min(a.half.y, middle + reach);
  const double shorter = std::min(a.half.y, b.half.y);
  if (to - from <= 1e-3 * shorter) return std::nullopt;

  const double radii = a.radius + b.radius;
  Manifold<D> manifold;
  manifold.normal = n;
  double least = 0;
  for (const double t : {from, to}) {
    const Vec<D> on_a = a.center + along * t;
    const Vec<D> on_b = b.center + b.along() * ((t - middle) / turn);
    const double distance = glm::dot(on_b - on_a, n);
    if (glm::length(on_b - on_a - n * distance) > kMostParallel * radii + kRounding * shorter)
      return std::nullopt;
    const double separation = distance - radii;
    manifold.add({on_a + n * (a.radius + separation / 2), separation, t == from ? 1u : 2u});
    least = t == from ? separation : std::min(least, separation);
  }
  // The deeper one stands for the closest points, whose distance is exact.
  for (int i = 0; i < 2; ++i) {
    ManifoldPoint<D>& point = manifold.room[static_cast<std::size_t>(i)];
    if (point.separation == least) point.separation = normal.length - radii;
  }
  if (manifold.room[1].separation > margin) manifold.count = 1;
  if (manifold.room[0].separation > margin) manifold.room[0] = manifold.room[--manifold.count];
  return manifold;
}

template <int D>
Contact<D> touch_segments(const PlacedCore<D>& a, const PlacedCore<D>& b, double margin,
                          NarrowTrace<D>& trace) {
  const PointPair<D> closest = closest_points(a.segment(), b.segment());
  const Direction<D> normal = direction_of(closest.b - closest.a, fallback_normal<D>());
  const double size = a.half.y + b.half.y + glm::length(b.center - a.center);
  trace.lengths += 15;  // five pairs of points, each with its distance
  // Segments that cross have no direction between them: they part by separating axes.
  if (normal.length <= kRounding * size) return touch_blocks(a, b, margin, trace);
  const Contact<D> single = touch_along(normal, closest.a, a.radius, b.radius, margin, trace);
  if (!single) return std::nullopt;
  const Contact<D> pair = two_points(a, b, normal, margin);
  return pair ? pair : single;
}

// --- a core against a half-space ---

// As many of those that touch as a manifold holds. They stay in the order of their features,
// whichever of them rounding makes the lowest.
template <int D>
Contact<D> touch_wall(const PlacedCore<D>& core, const Wall<D>& wall, double margin,
                      NarrowTrace<D>& trace) {
  std::array<ManifoldPoint<D>, 1u << D> room;
  std::size_t count = 0;
  each_corner(core, [&](const Vec<D>& corner, std::uint32_t) {
    ManifoldPoint<D>& point = room[count];
    point.feature = static_cast<std::uint32_t>(count++);
    point.separation = glm::dot(corner - wall.point, wall.normal) - core.radius;
    point.position = corner - wall.normal * (core.radius + point.separation / 2);
  });
  const std::span<const ManifoldPoint<D>> corners{room.data(), count};
  const auto is_lower = [](const ManifoldPoint<D>& x, const ManifoldPoint<D>& y) {
    return x.separation != y.separation ? x.separation < y.separation : x.feature < y.feature;
  };
  trace.lengths += count;
  if (trace.axes) {
    const double lowest = std::ranges::min(corners, {}, &ManifoldPoint<D>::separation).separation;
    trace.note(-wall.normal, lowest, AxisAcross::closest_points);
  }
  Manifold<D> manifold;
  manifold.normal = -wall.normal;
  for (const ManifoldPoint<D>& corner : corners) {
    const auto lower = std::count_if(corners.begin(), corners.end(),
                                     [&](const auto& other) { return is_lower(other, corner); });
    if (corner.separation <= margin && lower < Manifold<D>::kMostPoints) manifold.add(corner);
  }
  if (manifold.count == 0) return std::nullopt;
  return manifold;
}

// --- which form a pair has ---

template <int D>
std::array<double, D + 1> sizes_of(const PlacedCore<D>& core) {
  std::array<double, D + 1> sizes{core.radius};
  for (int i = 0; i < D; ++i) sizes[static_cast<std::size_t>(i) + 1] = core.half[i];
  return sizes;
}

// Whether a pair is to be handled as (a, b) rather than (b, a); `offset` leads from a to b. Closed
// forms know each pair of kinds in one order only, and a pair of equal kinds must give the same
// contact in both orders. So the larger sizes come first. Equal shapes are ordered along a
// direction that is skew to everything that scenes are made of: no pile or row of boxes is close to
// where the order changes.
template <int D>
bool is_in_order(const PlacedCore<D>& a, const PlacedCore<D>& b, const Vec<D>& offset) {
  if (a.kind != b.kind) return a.kind < b.kind;
  if (a.half != b.half || a.radius != b.radius) return sizes_of(a) > sizes_of(b);
  const double skew[] = {0.3542, 0.8117, 0.4641};
  double along = 0;
  for (int i = 0; i < D; ++i) along += skew[i] * offset[i];
  return along >= 0;
}

template <int D>
Contact<D> touch_cores(const PlacedCore<D>& a, const PlacedCore<D>& b, double margin,
                       NarrowTrace<D>& trace) {
  switch (a.kind) {
    case CoreKind::point:
      return b.kind == CoreKind::point ? touch_points(a, b, margin, trace)
             : b.kind == CoreKind::box ? touch_point_and_box(a, b, margin, trace)
                                       : touch_point_and_segment(a, b, margin, trace);
    case CoreKind::box:
      return touch_blocks(a, b, margin, trace);
    case CoreKind::segment:
      return touch_segments(a, b, margin, trace);
  }
  return std::nullopt;
}

// Of axes that were measured from b to a.
template <int D>
void turn_over(std::span<MeasuredAxis<D>> axes) {
  for (MeasuredAxis<D>& axis : axes) {
    axis.normal = -axis.normal;
    const AxisAcross was = axis.across;
    if (was == AxisAcross::face_of_a) axis.across = AxisAcross::face_of_b;
    if (was == AxisAcross::face_of_b) axis.across = AxisAcross::face_of_a;
  }
}

}  // namespace
}  // namespace narrow

// Positions are subtracted before anything else, so that far from the origin only their own
// rounding is lost.
template <int D>
std::optional<Manifold<D>> collide(const Placed<D>& a, const Placed<D>& b, double margin,
                                   NarrowTrace<D>& trace) {
  const Vec<D> offset = b.position - a.position;
  narrow::PlacedCore<D> core_a, core_b;
  const bool solid_a = narrow::place(a, Vec<D>(0.0), core_a);
  const bool solid_b = narrow::place(b, offset, core_b);
  const bool in_order = solid_a && solid_b ? narrow::is_in_order(core_a, core_b, offset) : solid_a;
  const Placed<D>&first = in_order ? a : b, &second = in_order ? b : a;
  const std::size_t told = trace.axes ? trace.axes->size() : 0;
  if (!in_order) {
    core_a.center = a.position - b.position;
    core_b.center = Vec<D>(0.0);
  }
  const narrow::PlacedCore<D>&one = in_order ? core_a : core_b, &other = in_order ? core_b : core_a;
  const auto* space = std::get_if<HalfSpace<D>>(&second.shape);
  std::optional<Manifold<D>> contact =
      !solid_a && !solid_b ? std::optional<Manifold<D>>()  // two half-spaces
      : space ? narrow::touch_wall<D>(one, {other.center, space->normal}, margin, trace)
              : narrow::touch_cores(one, other, margin, trace);
  if (!in_order && trace.axes) narrow::turn_over<D>(std::span(*trace.axes).subspan(told));
  if (!contact) return contact;
  if (!in_order) contact->normal = -contact->normal;
  for (int i = 0; i < contact->count; ++i)
    contact->room[static_cast<std::size_t>(i)].position += first.position;
  return contact;
}

template std::optional<Manifold<2>> collide(const Placed<2>&, const Placed<2>&, double,
                                            NarrowTrace<2>&);
template std::optional<Manifold<3>> collide(const Placed<3>&, const Placed<3>&, double,
                                            NarrowTrace<3>&);

}  // namespace lantern::physics
