// Two boxes, or a box and a capsule, or capsules whose segments cross.
#include "physics/collide_blocks.hpp"

namespace lantern::physics::narrow {
namespace {

// Kinds of contact, in the upper bits of feature names.
constexpr std::uint32_t kFaceOfA = 0u << 16, kFaceOfB = 1u << 16, kEdges = 2u << 16,
                        kClosest = 3u << 16;

// A normal within this of a face's (the cosine, 2 degrees) has that face's contact.
constexpr double kNearFace = 0.9995;

template <int D>
void mark(Manifold<D>& manifold, std::uint32_t kind) {
  for (auto& point : manifold.room) point.feature |= kind;
}

// `normal` is the face's or leans a little.
template <int D>
FaceContact<D> contact_on_face(const SeparatingAxis<D>& face, const PlacedCore<D>& a,
                               const PlacedCore<D>& b, const Vec<D>& normal, double margin) {
  const bool of_a = face.kind == SeparatingAxis<D>::Kind::face_of_a;
  FaceContact<D> contact = of_a ? face_contact(a, b, face.axis_a, normal, margin)
                                : face_contact(b, a, face.axis_b, -normal, margin);
  contact.manifold.normal = normal;
  mark(contact.manifold, of_a ? kFaceOfA : kFaceOfB);
  return contact;
}

// The edge of a block along an axis that lies farthest out along the normal, and its name.
struct NamedEdge {
  Segment<3> segment;
  std::uint32_t name = 0;
};

NamedEdge farthest_edge(const PlacedCore<3>& block, int axis, const Vec<3>& normal) {
  Vec<3> middle = block.half;
  auto name = static_cast<std::uint32_t>(axis) << 3;
  for (int i = 0; i < 3; ++i) {
    if (i == axis) continue;
    const bool positive = glm::dot(block.axes[i], normal) >= 0;
    if (!positive) middle[i] = -middle[i];
    if (positive) name |= 1u << i;
  }
  Vec<3> start = middle;
  start[axis] = -start[axis];
  return {{block.world(start), block.world(middle)}, name};
}

// Two edges that cross meet in one point, midway.
FaceContact<3> contact_of_edges(const PlacedCore<3>& a, const PlacedCore<3>& b,
                                const SeparatingAxis<3>& axis) {
  const NamedEdge edge_a = farthest_edge(a, axis.axis_a, axis.normal);
  const NamedEdge edge_b = farthest_edge(b, axis.axis_b, -axis.normal);
  const PointPair<3> points = closest_points(edge_a.segment, edge_b.segment);
  FaceContact<3> contact;
  contact.least_distance = std::sqrt(points.square());
  contact.manifold.normal = axis.normal;
  const Vec<3> middle = (points.a + points.b) * 0.5 + axis.normal * ((a.radius - b.radius) / 2);
  contact.manifold.add(
      {middle, axis.separation - a.radius - b.radius, kEdges | edge_a.name << 5 | edge_b.name});
  return contact;
}

template <int D>
FaceContact<D> contact_on(const SeparatingAxis<D>& axis, const PlacedCore<D>& a,
                          const PlacedCore<D>& b, double margin) {
  if constexpr (D == 3)
    if (axis.kind == SeparatingAxis<D>::Kind::edges) return contact_of_edges(a, b, axis);
  return contact_on_face(axis, a, b, axis.normal, margin);
}

template <int D>
double least_separation(const Manifold<D>& manifold) {
  double least = manifold.room[0].separation;
  for (const auto& point : manifold.points()) least = std::min(least, point.separation);
  return least;
}

// The deepest point stands for the true separation, which is known to be nearly that.
template <int D>
void set_least_separation(Manifold<D>& manifold, double exact) {
  const double least = least_separation(manifold);
  for (auto& point : manifold.room)
    point.separation = point.separation == least ? exact : std::max(point.separation, exact);
}

// Of cores that are apart, where the separating axis is not the direction of their distance. Near a
// face's normal they still have that face's points, so that a box over the rim of another one, or
// a capsule, settles on it rather than rocking.
template <int D>
Manifold<D> contact_of_closest(const PlacedCore<D>& a, const PlacedCore<D>& b,
                               const ClosestFeatures<D>& closest, const Direction<D>& normal,
                               const SeparatingAxis<D>& face, double margin) {
  const Manifold<D> single =
      one_point(closest.points.a, a.radius, b.radius, normal, kClosest | closest.feature);
  if (glm::dot(face.normal, normal.unit) < kNearFace) return single;
  const double radii = a.radius + b.radius, exact = normal.length - radii;
  const double size = radii + smallest_half(a, b);
  const double near = std::min(margin, exact + 0.1 * size);
  Manifold<D> many = contact_on_face(face, a, b, normal.unit, near).manifold;
  // Heights along the leaning normal are nearly distances, or the face is not what is closest.
  if (many.count < 2 || std::abs(least_separation(many) - exact) > 1e-3 * size) return single;
  set_least_separation(many, exact);
  return many;
}

// The contact on a separating axis. Nothing if it does not reach the bound that the axes give.
template <int D>
Contact<D> contact_if_exact(const SeparatingAxis<D>& axis, const PlacedCore<D>& a,
                            const PlacedCore<D>& b, double bound, double rounding, double margin) {
  using Kind = typename SeparatingAxis<D>::Kind;
  if (axis.kind == Kind::side) return std::nullopt;
  const bool apart = bound > rounding;
  if (apart && (axis.kind == Kind::edges || axis.separation < bound - rounding))
    return std::nullopt;  // they may still have a face's points, along another normal
  FaceContact<D> contact = contact_on(axis, a, b, margin);
  if (contact.manifold.count == 0) return std::nullopt;
  const double allowed = apart ? rounding : kAxisBias * smallest_half(a, b) + rounding;
  const double exact = axis.separation - a.radius - b.radius;
  if (std::abs(least_separation(contact.manifold) - exact) > allowed) return std::nullopt;
  if (apart && contact.least_distance > bound + rounding) return std::nullopt;
  set_least_separation(contact.manifold, exact);
  return contact.manifold;
}

}  // namespace

template <int D>
Contact<D> touch_blocks(const PlacedCore<D>& a, const PlacedCore<D>& b, double margin,
                        NarrowTrace<D>& trace) {
  const double radii = a.radius + b.radius;
  const SeparatingAxes<D> axes = separating_axes(a, b, margin, trace);
  if (axes.parted) return std::nullopt;
  const double bound = axes.greatest.separation;

  double size = glm::length(b.center - a.center);
  for (int i = 0; i < D; ++i) size += a.half[i] + b.half[i];
  const double rounding = kRounding * size;
  const bool apart = bound > rounding;
  if (auto contact = contact_if_exact(axes.chosen, a, b, bound, rounding, margin)) return contact;
  if (!apart)
    if (auto contact = contact_if_exact(axes.greatest, a, b, bound, rounding, margin))
      return contact;

  const ClosestFeatures<D> closest = closest_features(a, b, axes.greatest, trace);
  Direction<D> normal = direction_of(closest.points.b - closest.points.a, axes.greatest.normal);
  // Where the axis is as good, it is the better direction: it does not come of small differences.
  // Cores that meet have none but it.
  if (normal.length <= bound + rounding || !apart)
    normal = {axes.greatest.normal, bound};
  else
    trace.note(normal.unit, normal.length - radii, MeasuredAxis<D>::Across::closest_points);
  if (normal.length - radii > margin) return std::nullopt;
  return contact_of_closest(a, b, closest, normal, axes.face, margin);
}

template Contact<2> touch_blocks(const PlacedCore<2>&, const PlacedCore<2>&, double,
                                 NarrowTrace<2>&);
template Contact<3> touch_blocks(const PlacedCore<3>&, const PlacedCore<3>&, double,
                                 NarrowTrace<3>&);

}  // namespace lantern::physics::narrow
