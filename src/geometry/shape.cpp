#include "geometry/shape.hpp"

namespace lantern {
namespace {

template <int D>
Vec<D> enveloping_half_size(const Rotation<D>& orientation, const Vec<D>& half_size) {
  const Mat<D> r = matrix(orientation);
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
Box<D> bounding_box(const Shape<D>& shape, const Vec<D>& position, const Rotation<D>& orientation) {
  if (const auto* sphere = std::get_if<Sphere>(&shape))
    return Box<D>::around(position, Vec<D>(sphere->radius));
  if (const auto* box = std::get_if<AxisBox<D>>(&shape))
    return Box<D>::around(position, box->half_size);
  if (const auto* box = std::get_if<OrientedBox<D>>(&shape))
    return Box<D>::around(position, enveloping_half_size(orientation, box->half_size));
  if (const auto* capsule = std::get_if<Capsule>(&shape)) {
    Vec<D> segment{0.0};
    segment.y = capsule->half_length;
    return Box<D>::around(position,
                          enveloping_half_size(orientation, segment) + Vec<D>(capsule->radius));
  }
  return box_of_half_space(std::get<HalfSpace<D>>(shape).normal, position);
}

template Box<2> bounding_box(const Shape<2>&, const Vec<2>&, const Rotation<2>&);
template Box<3> bounding_box(const Shape<3>&, const Vec<3>&, const Rotation<3>&);

}  // namespace lantern
