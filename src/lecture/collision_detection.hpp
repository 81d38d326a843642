// What the lecture's phases hand on: a pair that may collide, and where it does.
//
// This room holds the lecture's own code ("Physics - Broad phase and Narrow phase", section
// "Tutorial Code"), kept recognisable line by line: its names, its order, its std::list in every
// node. It lives in a namespace of this program, not in NCL::CSC8503, because the framework of that
// name is not part of it. Wherever the code departs from the text, a comment says so:
//
//   Mended:  what the text does, and why that fails
//   Added:   what the text lacks, and who needs it
//   Ours:    what the text mentions but does not show; written from its description
//
// Numbers are doubles, as everywhere in this program; the text uses floats.
#pragma once

#include <cmath>
#include <cstdint>

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
    // A std::set hands out constants; what plays no part in their order may still change.
    mutable int framesLeft = 0;
    mutable ContactPoint point;
    mutable double impulse = 0;  // Added: applied along the normal in the last frame, in N s
    mutable bool begun = false;  // Added: OnCollisionBegin was called

    // Mended: the text compares a + (b << 8), a sum of addresses. Two different pairs can have the
    // same sum; the std::set then mistakes the second for the first, and it never collides. The
    // order, and with it the outcome, also changes from run to run. With ids neither happens.
    bool operator<(const CollisionInfo& other) const;
  };

  // The text's own order, for pictures of what it loses. The addresses are those that a scenario
  // gives, so that every run loses the same.
  struct CollisionInfoAsPrinted {
    std::uint64_t a = 0;
    std::uint64_t b = 0;

    bool operator<(const CollisionInfoAsPrinted& other) const {
      const std::uint64_t otherHash = other.a + (other.b << 8);
      const std::uint64_t thisHash = a + (b << 8);
      return thisHash < otherHash;
    }
    // Added: for pictures to tell.
    std::uint64_t GetHash() const { return a + (b << 8); }
  };

  // Do two boxes overlap, each given by its centre and half sizes?
  // Mended: in the text, boxes that just touch do not overlap, so whether a ball resting on a wall
  // is found depends on rounding. Here touching counts.
  static bool AABBTest(const Vector3& posA, const Vector3& posB, const Vector3& halfSizeA,
                       const Vector3& halfSizeB) {
    const Vector3 delta = posB - posA;
    const Vector3 totalSize = halfSizeA + halfSizeB;
    return std::abs(delta.x) <= totalSize.x && std::abs(delta.y) <= totalSize.y &&
           std::abs(delta.z) <= totalSize.z;
  }
};

}  // namespace lantern::lecture
