// A sphere against a sphere, a box, a capsule: the point of the other core that is closest to the
// centre.
#include "physics/collide_cores.hpp"

namespace lantern::narrow {

template <int D>
Contact<D> touch_points(const PlacedCore<D>& a, const PlacedCore<D>& b, double margin) {
  const Direction<D> normal = direction_of(b.center - a.center, fallback_normal<D>());
  if (normal.length - a.radius - b.radius > margin) return std::nullopt;
  return one_point(a.center, a.radius, b.radius, normal);
}

// A centre inside the box leaves it by the closest face; the first of equally close ones.
//
//     ________
//    |   <-x  |      x: the centre
//    |________|
template <int D>
Contact<D> touch_point_and_box(const PlacedCore<D>& a, const PlacedCore<D>& b, double margin) {
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
  if (normal.length - a.radius > margin) return std::nullopt;
  return one_point(a.center, a.radius, 0.0, normal);
}

// A centre on the capsule's segment leaves it sideways.
template <int D>
Contact<D> touch_point_and_segment(const PlacedCore<D>& a, const PlacedCore<D>& b, double margin) {
  const Vec<D> to_segment = closest_point(b.segment(), a.center) - a.center;
  const Direction<D> normal = direction_of(to_segment, b.axes[0]);
  if (normal.length - a.radius - b.radius > margin) return std::nullopt;
  return one_point(a.center, a.radius, b.radius, normal);
}

#define LANTERN_INSTANTIATE(D)                                                                 \
  template Contact<D> touch_points(const PlacedCore<D>&, const PlacedCore<D>&, double);        \
  template Contact<D> touch_point_and_box(const PlacedCore<D>&, const PlacedCore<D>&, double); \
  template Contact<D> touch_point_and_segment(const PlacedCore<D>&, const PlacedCore<D>&, double);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern::narrow
