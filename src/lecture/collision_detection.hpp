// What the lecture's phases hand on: a pair that may collide, and where it does.
//
// This room is the lecture's own code ("Physics - Broad phase and Narrow phase", the section
// "Tutorial Code"), kept recognisable line by line: its names, its order, its std::list in every
// node. It stands in a namespace of the house rather than in NCL::CSC8503, because the framework of
// that name is not here. Where the code differs, a comment says so:
//
//   Mended:  what the text has, and why it fails
//   Added:   what the text has not, and who needs it
//   Ours:    the text names it and does not show it; written from its description
//
// Numbers are doubles, as everywhere in this program; in the text they are floats.
#pragma once

#include <cmath>

#include "geometry/vec.hpp"

namespace lantern::lecture {

using Vector2 = Vec<2>;
using Vector3 = Vec<3>;

class GameObject;

struct CollisionDetection {
  // Ours: the text only mentions `info.point`.
  struct ContactPoint {
    Vector3 localA{0.0};     // from the centre of a, in the world's axes
    Vector3 localB{0.0};     // from the centre of b
    Vector3 normal{0.0};     // of unit length, from a to b
    double penetration = 0;  // how deep the volumes overlap along it; not negative
  };

  struct CollisionInfo {
    GameObject* a = nullptr;
    GameObject* b = nullptr;
    // A std::set hands out constants; what does not decide their order may change.
    mutable int framesLeft = 0;
    mutable ContactPoint point;
    mutable double impulse = 0;  // Added: that the last frame took, along the normal, in N s
    mutable bool begun = false;  // Added: OnCollisionBegin was called

    // Mended: the text compares a + (b << 8), sums of addresses. Two different pairs can have the
    // same sum; the std::set then takes the second for the first and it never collides. The order
    // also changes from run to run, and with it the result. Ids do neither.
    bool operator<(const CollisionInfo& other) const;
  };

  // Do two boxes overlap, each given by its middle and half sizes?
  // Mended: the text's boxes do not overlap when they just touch, so a ball that rests on a wall is
  // lost and found at every rounding. Touching counts.
  static bool AABBTest(const Vector3& posA, const Vector3& posB, const Vector3& halfSizeA,
                       const Vector3& halfSizeB) {
    const Vector3 delta = posB - posA;
    const Vector3 totalSize = halfSizeA + halfSizeB;
    return std::abs(delta.x) <= totalSize.x && std::abs(delta.y) <= totalSize.y &&
           std::abs(delta.z) <= totalSize.z;
  }
};

}  // namespace lantern::lecture
