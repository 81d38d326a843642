// How far joints are from holding.
#pragma once

#include <algorithm>
#include <cmath>

#include "physics/world.hpp"

namespace lantern::physics {

// Of a joint whose points are at `from` and `to`, in units of length: how far those of a pin are
// apart, how far those of a rod are from its length.
template <int D>
double joint_gap(JointKind kind, double length, const Vec<D>& from, const Vec<D>& to) {
  const double apart = glm::length(to - from);
  return kind == JointKind::pin ? apart : std::abs(apart - length);
}

template <int D>
double joint_gap(const Joint<D>& joint, const Body<D>& a, const Body<D>& b) {
  return joint_gap<D>(joint.kind, joint.length, matrix(a.orientation) * joint.at_a,
                      (b.position - a.position) + matrix(b.orientation) * joint.at_b);
}

// Of all joints of a world, as its bodies are now; 0 without joints.
template <int D>
double widest_gap(const World<D>& world) {
  double widest = 0;
  for (const auto& [id, joint] : world.joints())
    widest = std::max(widest, joint_gap(joint, *world.find(joint.a), *world.find(joint.b)));
  return widest;
}

}  // namespace lantern::physics
