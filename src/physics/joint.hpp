// Joints: points of two bodies that stay together, or at a distance from each other.
#pragma once

#include <algorithm>
#include <cmath>

#include "physics/body.hpp"

namespace lantern::physics {

using JointId = std::uint32_t;

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

// How often joints are left to rows before they are tried as equations again, after that has
// failed: twice as long each time.
struct Backoff {
  int wait = 0;  // steps, or flights between impacts
  int next = 1;

  bool waits() { return wait > 0 && wait-- > 0; }
  void fail() {
    constexpr int kLongest = 64;
    wait = next;
    next = std::min(2 * next, kLongest);
  }
};

// What a step remembers of a joint.
template <int D>
struct JointMemory {
  Vec<D> impulse{0.0};  // of the last sub-step, upon b, N s
  double seconds = 0;   // of that sub-step; 0: there was none
  Backoff backoff = {};
};

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

template <int D>
class World;

// Whether a joint lets the two through each other.
template <int D>
bool pass_through(const World<D>& world, BodyId a, BodyId b) {
  return std::ranges::any_of(world.joints(), [&](const auto& entry) {
    const Joint<D>& joint = entry.second;
    return !joint.collide && ((joint.a == a && joint.b == b) || (joint.a == b && joint.b == a));
  });
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
