// Two boxes, or a box and a capsule, or capsules whose segments cross.
//
// 1. Separating axes (block_searches.hpp): along which direction do the cores overlap least? 2. A
// face contact: the face that looks at the other block is the reference; the other block's
//    face is clipped against its sides.
// 3. Cores that are apart where no face looks at the other block: their closest points
//    (block_searches.hpp).
#include <algorithm>
#include <array>
#include <limits>

#include "base/scratch.hpp"
#include "physics/narrow/block_searches.hpp"

namespace lantern::physics::narrow {
namespace {

// The face contact: the other block's face, clipped against the sides of the reference face
// (Sutherland and Hodgman, Reentrant Polygon Clipping, 1974).
//
//           other
//        ___________
//       |   |       |              the corner p of the other block's face lies outside the
//       p---x-------x----          reference face; it is cut back to its side
//           |  reference |

// Corners that lie outside the reference face by this part of the smallest half size still count as
// inside: boxes stacked edge to edge keep their corners, and their names, whichever way they
// jitter.
constexpr double kSlack = 1e-4;

// A corner of the clipped face, and the line that leaves it: 0 ... 3 are edges of the other block's
// face, 4 ... 7 sides of the reference face.
template <int D>
struct Corner {
  Vec<D> point;
  std::uint32_t line;
  std::uint32_t name;  // made of the two lines that met here first
};

constexpr std::uint32_t name_of(std::uint32_t line_in, std::uint32_t line_out) {
  return line_in << 3 | line_out;
}

// A face has 4 corners and each of the 4 sides that cut it adds one. Rounding may fray a corner, so
// there is room for more; beyond it corners are left out. An edge has 2, however it is cut.
template <int D>
constexpr std::size_t kMostCorners = D == 2 ? 2 : 12;

template <int D>
struct Outline {
  std::array<Corner<D>, kMostCorners<D>>
      room;  // not set beyond the count: thousands are made a step
  int count = 0;

  Corner<D>& operator[](int i) { return room[static_cast<std::size_t>(i)]; }
  const Corner<D>& operator[](int i) const { return room[static_cast<std::size_t>(i)]; }
  void add(const Corner<D>& corner) {
    if (count < static_cast<int>(kMostCorners<D>)) (*this)[count++] = corner;
  }
};

// The face of a block that looks most against the normal.
struct Facing {
  int axis = 0;
  bool positive = false;
  std::uint32_t name() const { return static_cast<std::uint32_t>(axis * 2 + (positive ? 1 : 0)); }
};

template <int D>
Facing facing(const PlacedCore<D>& block, const Vec<D>& normal) {
  int axis = 0;
  const auto share = [&](int i) { return std::abs(glm::dot(block.axes[i], normal)); };
  for (int i = 1; i < D; ++i)
    if (share(i) > share(axis) + 1e-9) axis = i;
  return {axis, glm::dot(block.axes[axis], normal) < 0};
}

// The corners of a face in their order around it: 4 of a rectangle, 2 of an edge, 1 of a point.
template <int D>
Outline<D> outline_of(const PlacedCore<D>& block, const Facing& face) {
  Vec<D> corner{0.0};
  corner[face.axis] = face.positive ? block.half[face.axis] : -block.half[face.axis];
  std::array<int, D - 1> spread{};
  std::uint32_t count = 0;
  for (int i = 0; i < D; ++i)
    if (i != face.axis && block.half[i] > 0) spread[count++] = i;

  Outline<D> outline;
  const std::uint32_t corners = 1u << count;
  for (std::uint32_t k = 0; k < corners; ++k) {
    if (count > 0) corner[spread[0]] = block.half[spread[0]] * (k == 0 || k == 3 ? -1 : 1);
    if (count > 1) corner[spread[D - 2]] = block.half[spread[D - 2]] * (k < 2 ? -1 : 1);
    outline.add({block.world(corner), k, name_of((k + corners - 1) & (corners - 1), k)});
  }
  return outline;
}

// Leaves what is behind a plane; `height` is above it. An edge is no loop: one end of it is cut.
template <int D, class Height>
void cut(Outline<D>& outline, const Height& height, double slack, std::uint32_t side) {
  std::array<double, kMostCorners<D>> heights;
  bool is_behind = true;
  for (int i = 0; i < outline.count; ++i) {
    heights[static_cast<std::size_t>(i)] = height(outline[i].point);
    is_behind &= heights[static_cast<std::size_t>(i)] <= slack;
  }
  if (is_behind) return;
  if (D == 2 || outline.count <= 2) {
    const std::size_t end = heights[0] <= slack, start = 1 - end;
    const bool stays = outline.count == 2 && heights[start] <= slack;
    if (!stays || std::min(heights[0], heights[1]) > 0) {  // the kept corner is the edge's end
      outline.room[0] = outline.room[start];
      outline.count = stays;
      return;
    }
    Corner<D>& moved = outline.room[end];
    const double share = heights[end] / (heights[end] - heights[start]);
    moved = {moved.point + (outline.room[start].point - moved.point) * share, moved.line,
             name_of(side, side)};
    return;
  }
  Outline<D> kept;
  for (int i = 0; i < outline.count; ++i) {
    const int after = i + 1 < outline.count ? i + 1 : 0;
    const Corner<D>&here = outline[i], &next = outline[after];
    const double h = heights[static_cast<std::size_t>(i)];
    const double h_next = heights[static_cast<std::size_t>(after)];
    const bool inside = h <= slack, next_inside = h_next <= slack;
    if (inside) kept.add(here);
    if (inside == next_inside) continue;
    const Vec<D> at = here.point + (next.point - here.point) * (h / (h - h_next));
    const bool is_cut = std::min(h, h_next) <= 0;  // if not, the kept corner is the edge's end
    if (inside) {
      if (is_cut)
        kept.add({at, side, name_of(here.line, side)});
      else
        kept[kept.count - 1].line = side;
    } else if (is_cut) {
      kept.add({at, here.line, name_of(side, here.line)});
    }
  }
  outline = kept;
}

template <int D>
double distance_to(const PlacedCore<D>& block, const Vec<D>& point) {
  const Vec<D> local = block.local(point);
  return glm::length(local - glm::clamp(local, -block.half, block.half));
}

// The deepest point, the one farthest from it, and on each side of the line through both the one
// that spans the largest triangle; no more if the points lie on a line. So that rounding does not
// swap equal ones, a later point must be deeper by `slack`, or wider by a part of 1e-6.
Scratch<int> widest_four(const Outline<3>& outline,
                         const std::array<double, kMostCorners<3>>& heights, const Vec<3>& normal,
                         double slack) {
  const auto height = [&](int i) { return heights[static_cast<std::size_t>(i)]; };
  int deepest = 0;
  for (int i = 1; i < outline.count; ++i)
    if (height(i) < height(deepest) - slack) deepest = i;
  Scratch<int> chosen{deepest};
  const auto add_best = [&](const auto& measure) {
    int best = -1;
    double most = 0;
    for (int i = 0; i < outline.count; ++i) {
      const double m = measure(outline[i].point);
      if (m <= most * (1 + 1e-6) || std::ranges::count(chosen, i) != 0) continue;
      most = m, best = i;
    }
    if (best >= 0) chosen.push_back(best);
  };
  const Vec<3> first = outline[deepest].point;
  add_best([&](const Vec<3>& p) { return glm::dot(p - first, p - first); });
  const Vec<3> across = glm::cross(normal, outline[chosen.back()].point - first);
  add_best([&](const Vec<3>& p) { return glm::dot(p - first, across); });
  add_best([&](const Vec<3>& p) { return -glm::dot(p - first, across); });
  std::ranges::sort(chosen);
  return chosen;
}

// The other block's face, cut back to what is above the reference face across an axis.
template <int D>
Outline<D> clipped_face(const PlacedCore<D>& reference, int axis, const PlacedCore<D>& other,
                        const Facing& face, double slack) {
  Outline<D> outline = outline_of(other, face);
  std::uint32_t side = 4;
  for (int i = 0; i < D; ++i) {
    if (i == axis) continue;
    for (const double way : {-1.0, 1.0}) {
      const auto height = [&](const Vec<D>& p) {
        return way * glm::dot(p - reference.center, reference.axes[i]) - reference.half[i];
      };
      if (reference.half[i] > 0) cut(outline, height, slack, side);
      ++side;
    }
  }
  return outline;
}

// Kinds of contact, in the upper bits of feature names.
constexpr std::uint32_t kFaceOfA = 0u << 16, kFaceOfB = 1u << 16, kEdges = 2u << 16,
                        kClosest = 3u << 16;

// A normal within this of a face's (the cosine, 2 degrees) has that face's contact.
constexpr double kNearFace = 0.9995;

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
double contact_of_edges(const PlacedCore<3>& a, const PlacedCore<3>& b,
                        const SeparatingAxis<3>& axis, Manifold<3>& manifold) {
  const NamedEdge edge_a = farthest_edge(a, axis.axis_a, axis.normal);
  const NamedEdge edge_b = farthest_edge(b, axis.axis_b, -axis.normal);
  const PointPair<3> points = closest_points(edge_a.segment, edge_b.segment);
  manifold.normal = axis.normal;
  const Vec<3> middle = (points.a + points.b) * 0.5 + axis.normal * ((a.radius - b.radius) / 2);
  manifold.add(
      {middle, axis.separation - a.radius - b.radius, kEdges | edge_a.name << 5 | edge_b.name});
  return std::sqrt(points.square());
}

// The contact of edges, or in which a face of one block meets the other. `along` is unit, from a to
// b, and within a right angle of the face's; separations are along it. No more than `margin` apart;
// the manifold stays empty if nothing of the other block's face is above the reference. Returns, of
// cores that are `apart`, how far its closest point really is from the other core.
template <int D>
double contact_on(const SeparatingAxis<D>& found, const PlacedCore<D>& a, const PlacedCore<D>& b,
                  const Vec<D>& along, double margin, bool apart, Manifold<D>& manifold) {
  if constexpr (D == 3)
    if (found.across == AxisAcross::edges) return contact_of_edges(a, b, found, manifold);
  const bool of_a = found.across == AxisAcross::face_of_a;
  const PlacedCore<D>&reference = of_a ? a : b, &other = of_a ? b : a;
  const int axis = found.axis_a;  // of a face its only one
  const Vec<D> normal = of_a ? along : -along;
  manifold.normal = along;
  const double slack = kSlack * smallest_half(reference, other);
  const double sign = glm::dot(reference.axes[axis], normal) < 0 ? -1 : 1;
  const Vec<D> outward = reference.axes[axis] * sign;
  const double cosine = glm::dot(outward, normal);  // heights along a leaning normal are longer
  const double radii = reference.radius + other.radius;
  const Facing face = facing(other, normal);

  double least_distance = std::numeric_limits<double>::infinity();
  std::array<double, kMostCorners<D>> heights;
  Outline<D> outline = clipped_face(reference, axis, other, face, slack);
  int close = 0;
  for (int i = 0; i < outline.count; ++i) {
    const Vec<D> p = outline[i].point;
    if (apart) least_distance = std::min(least_distance, distance_to(reference, p));
    const double height = (glm::dot(p - reference.center, outward) - reference.half[axis]) / cosine;
    if (height - radii > margin) continue;
    heights[static_cast<std::size_t>(close)] = height;
    outline[close++] = outline[i];
  }
  outline.count = close;

  const std::uint32_t faces =
      static_cast<std::uint32_t>(axis * 2 + (sign > 0 ? 1 : 0)) << 3 | face.name();
  const auto add = [&](int i) {
    const double separation = heights[static_cast<std::size_t>(i)] - radii;
    manifold.add({outline[i].point - normal * (other.radius + separation / 2), separation,
                  (of_a ? kFaceOfA : kFaceOfB) | faces << 6 | outline[i].name});
  };
  if constexpr (D == 3)
    if (close > 4) {
      for (const int i : widest_four(outline, heights, normal, slack)) add(i);
      return least_distance;
    }
  for (int i = 0; i < close; ++i) add(i);
  return least_distance;
}

// The deepest point stands for the true separation, which is known to be nearly that.
template <int D>
void set_least_separation(Manifold<D>& manifold, double least, double exact) {
  for (auto& point : manifold.room)
    point.separation = point.separation == least ? exact : std::max(point.separation, exact);
}

// Of cores that are apart, where the separating axis is not the direction of their distance. Near a
// face's normal they still have that face's points, so that a box over the rim of another one, or a
// capsule, settles on it rather than rocking.
template <int D>
Contact<D> contact_of_closest(const PlacedCore<D>& a, const PlacedCore<D>& b,
                              const ClosestFeatures<D>& closest, const Direction<D>& normal,
                              const SeparatingAxis<D>& face, double margin) {
  const Contact<D> single =
      one_point(closest.points.a, a.radius, b.radius, normal, kClosest | closest.feature);
  if (glm::dot(face.normal, normal.unit) < kNearFace) return single;
  const double radii = a.radius + b.radius, exact = normal.length - radii;
  const double size = radii + smallest_half(a, b);
  const double near = std::min(margin, exact + 0.1 * size);
  Manifold<D> many;
  contact_on(face, a, b, normal.unit, near, false, many);
  // Heights along the leaning normal are nearly distances, or the face is not what is closest.
  const double least = many.least_separation();
  if (many.count < 2 || std::abs(least - exact) > 1e-3 * size) return single;
  set_least_separation(many, least, exact);
  return many;
}

// Whether the contact on a separating axis reaches the bound that the axes give: `manifold` then.
template <int D>
bool is_exact(const SeparatingAxis<D>& axis, const PlacedCore<D>& a, const PlacedCore<D>& b,
              double bound, double rounding, double margin, Manifold<D>& manifold) {
  if (axis.across == AxisAcross::side) return false;
  const bool apart = bound > rounding;
  if (apart && (axis.across == AxisAcross::edges || axis.separation < bound - rounding))
    return false;  // they may still have a face's points, along another normal
  manifold.count = 0;
  const double least_distance = contact_on(axis, a, b, axis.normal, margin, apart, manifold);
  if (manifold.count == 0) return false;
  const double allowed = apart ? rounding : kAxisBias * smallest_half(a, b) + rounding;
  const double exact = axis.separation - a.radius - b.radius;
  const double least = manifold.least_separation();
  if (std::abs(least - exact) > allowed) return false;
  if (apart && least_distance > bound + rounding) return false;
  set_least_separation(manifold, least, exact);
  return true;
}

}  // namespace

template <int D>
Contact<D> touch_blocks(const PlacedCore<D>& a, const PlacedCore<D>& b, double margin,
                        NarrowTrace<D>& trace) {
  const double radii = a.radius + b.radius;
  AxisSearch<D> axes(a, b, margin, trace);
  Contact<D> contact;
  if (!axes.run()) return contact;
  const double bound = axes.greatest().separation;

  double size = glm::length(b.center - a.center);
  for (int i = 0; i < D; ++i) size += a.half[i] + b.half[i];
  const double rounding = kRounding * size;
  const bool apart = bound > rounding;
  Manifold<D>& manifold = contact.emplace();
  if (is_exact(axes.chosen(), a, b, bound, rounding, margin, manifold)) return contact;
  if (!apart && is_exact(axes.greatest(), a, b, bound, rounding, margin, manifold)) return contact;
  contact.reset();

  const ClosestFeatures<D> closest = ClosestSearch<D>(a, b, axes.greatest(), trace).run();
  Direction<D> normal = direction_of(closest.points.b - closest.points.a, axes.greatest().normal);
  // Where the axis is as good, it is the better direction: it does not come of small differences.
  // Cores that meet have none but it.
  if (normal.length <= bound + rounding || !apart)
    normal = {axes.greatest().normal, bound};
  else
    trace.note(normal.unit, normal.length - radii, AxisAcross::closest_points);
  if (!(normal.length - radii > margin))
    contact = contact_of_closest(a, b, closest, normal, axes.face(), margin);
  return contact;
}

template Contact<2> touch_blocks(const PlacedCore<2>&, const PlacedCore<2>&, double,
                                 NarrowTrace<2>&);
template Contact<3> touch_blocks(const PlacedCore<3>&, const PlacedCore<3>&, double,
                                 NarrowTrace<3>&);

}  // namespace lantern::physics::narrow
