// What a computation may bring about, and no engine may keep.
#pragma once

#include <cmath>
#include <limits>

#include "geometry/vec.hpp"

namespace lantern {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline bool is_finite(double value) { return std::isfinite(value); }

template <int D>
bool is_finite(const Vec<D>& value) {
  for (int i = 0; i < D; ++i)
    if (!std::isfinite(value[i])) return false;
  return true;
}

}  // namespace lantern
