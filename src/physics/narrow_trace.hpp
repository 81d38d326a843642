// What the narrow phase measured of two shapes before it knew whether they touch.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/vec.hpp"

namespace lantern::physics {

// A direction along which two shapes were measured.
template <int D>
struct MeasuredAxis {
  enum class Across : std::uint8_t {
    closest_points,  // from one shape to the other: no direction parts them further
    face_of_a,
    face_of_b,
    edges,  // of both, in 3D
    side,   // of a capsule or box without thickness, where it has no face
  };
  Vec<D> normal{0.0};     // unit, from a to b
  double separation = 0;  // of the surfaces along it; below 0 they overlap
  Across across = Across::closest_points;
};

template <int D>
struct NarrowTrace {
  // Lengths taken along a direction, each a product of two vectors: of two discs 1, of a disc and a
  // box 1 + D, of two boxes 1 + D for each axis.
  std::uint64_t lengths = 0;
  // Where somebody watches: each axis when it was measured, in this order.
  std::vector<MeasuredAxis<D>>* axes = nullptr;

  void note(const Vec<D>& normal, double separation, typename MeasuredAxis<D>::Across across) {
    if (axes) axes->push_back({normal, separation, across});
  }
};

}  // namespace lantern::physics
