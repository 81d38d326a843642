// The collision volumes of bodies, and the boxes that envelop them in the broad phase.
#pragma once

#include <variant>

#include "geometry/box.hpp"

namespace lantern {

// A disc in 2D, a ball in 3D.
struct Sphere {
  double radius = 0;
};

// An axis-aligned box around the body's position.
template <int D>
struct AxisBox {
  Vec<D> half_size{0.0};
};

template <int D>
using Shape = std::variant<Sphere, AxisBox<D>>;

// The broad-phase box: a sphere's half sizes are its radius on each axis, a box is its own.
template <int D>
Box<D> bounding_box(const Shape<D>& shape, const Vec<D>& position) {
  if (const auto* sphere = std::get_if<Sphere>(&shape))
    return Box<D>::around(position, Vec<D>(sphere->radius));
  return Box<D>::around(position, std::get<AxisBox<D>>(shape).half_size);
}

}  // namespace lantern
