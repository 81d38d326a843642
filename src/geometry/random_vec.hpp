// Points, directions and turns of a seeded random generator.
#pragma once

#include <cmath>

#include "base/random.hpp"
#include "geometry/rotation.hpp"

namespace lantern::geometry {

// Each coordinate between `lo` and `hi`, in order of the axes.
template <int D>
Vec<D> random_point(Random& random, double lo, double hi) {
  Vec<D> p;
  for (int i = 0; i < D; ++i) p[i] = random.between(lo, hi);
  return p;
}

// Of unit length, from points of the unit disc or ball, but not of its middle, where they would be
// coarse. No sine, so it is the same on every machine.
template <int D>
Vec<D> random_direction(Random& random) {
  for (;;) {
    Vec<D> v{0.0};
    double square = 0;
    for (int i = 0; i < D; ++i) {
      v[i] = random.between(-1, 1);
      square += v[i] * v[i];
    }
    if (square >= 0.01 && square <= 1) return v / std::sqrt(square);
  }
}

// About any axis, by up to 3 rad.
template <int D>
Rotation<D> random_rotation(Random& random) {
  if constexpr (D == 2)
    return {random.between(-3, 3)};
  else
    return turned(Rotation<3>{}, random_direction<3>(random) * random.between(0, 3));
}

}  // namespace lantern::geometry
