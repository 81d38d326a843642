#include "geometry/shape.hpp"

namespace lantern::geometry {
namespace {

template <int D>
Vec<D> enveloping_half_size(const Mat<D>& r, const Vec<D>& half_size) {
  Vec<D> half{0.0};
  for (int column = 0; column < D; ++column)
    for (int row = 0; row < D; ++row) half[row] += std::abs(r[column][row]) * half_size[column];
  return half;
}

// Only a half-space along an axis ends somewhere.
template <int D>
Box<D> box_of_half_space(const Vec<D>& normal, const Vec<D>& position) {
  Box<D> box = Box<D>::around(Vec<D>(0.0), Vec<D>(kEndless));
  for (int i = 0; i < D; ++i) {
    Vec<D> axis{0.0};
    axis[i] = 1;
    if (normal == axis) box.hi[i] = position[i];
    if (normal == -axis) box.lo[i] = position[i];
  }
  return box;
}

}  // namespace

template <int D>
Box<D> bounding_box(const Shape<D>& shape, const Vec<D>& position, const Mat<D>& axes) {
  return visit_shape<D>(
      shape,
      [&](const Core<D>& core) {
        const bool turned = core.turns && core.half != Vec<D>(0.0);
        const Vec<D> half = turned ? enveloping_half_size<D>(axes, core.half) : core.half;
        return Box<D>::around(position, half + Vec<D>(core.radius));
      },
      [&](const HalfSpace<D>& space) { return box_of_half_space(space.normal, position); });
}

template <int D>
Box<D> bounding_box(const Shape<D>& shape, const Vec<D>& position, const Rotation<D>& orientation) {
  const bool turned = turns<D>(shape) && !std::holds_alternative<Sphere>(shape);
  return bounding_box(shape, position, turned ? matrix(orientation) : Mat<D>(1.0));
}

template <int D>
double turning_reach(const Shape<D>& shape) {
  return visit_shape<D>(
      shape,
      [](const Core<D>& core) {
        if (!core.turns) return 0.0;
        double most = core.half[0];
        for (int i = 1; i < D; ++i) most = std::max(most, core.half[i]);
        // Of a segment exactly so, however small its square.
        return glm::dot(core.half, core.half) == most * most ? most : glm::length(core.half);
      },
      [](const HalfSpace<D>&) { return 0.0; });
}

template <int D>
double thickness(const Shape<D>& shape) {
  return visit_shape<D>(
      shape, [](const Core<D>& core) { return core.thickness(); },
      [](const HalfSpace<D>&) { return kEndless; });
}

#define LANTERN_INSTANTIATE(D)                                                      \
  template Box<D> bounding_box(const Shape<D>&, const Vec<D>&, const Rotation<D>&); \
  template Box<D> bounding_box(const Shape<D>&, const Vec<D>&, const Mat<D>&);      \
  template double turning_reach<D>(const Shape<D>&);                                \
  template double thickness<D>(const Shape<D>&);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern::geometry
