// Joints: points of two bodies that stay together, or at a distance from each other.
#pragma once

#include "physics/body.hpp"

namespace lantern::physics {

using JointId = std::uint32_t;
using SpringId = std::uint32_t;

enum class JointKind {
  distance,  // the two points stay `length` apart: a rod
  pin,       // the two points coincide: a hinge in 2D, a ball joint in 3D
};

// Points are given in the bodies' own axes from their centres. An anchor that is fixed in the world
// is a point of a static body. Bodies that a joint holds together do not collide, unless asked to.
template <int D>
struct Joint {
  JointKind kind = JointKind::pin;
  BodyId a = 0;
  BodyId b = 0;
  Vec<D> at_a{0.0};
  Vec<D> at_b{0.0};
  double length = 0;  // of a rod, above 0
  bool collide = false;
};

}  // namespace lantern::physics
