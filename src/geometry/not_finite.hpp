// What a computation may bring about, and no engine may keep.
#pragma once

#include <cmath>
#include <limits>
#include <string>

#include "base/error.hpp"
#include "geometry/vec.hpp"

namespace lantern::geometry {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline bool is_finite(double value) { return std::isfinite(value); }

template <int D>
bool is_finite(const Vec<D>& value) {
  for (int i = 0; i < D; ++i)
    if (!std::isfinite(value[i])) return false;
  return true;
}

// These throw Refused, naming `who` and the field.
inline void require_finite(double value, const std::string& who, const char* field) {
  if (!std::isfinite(value)) throw Refused("{}: {} is not finite", who, field);
}
template <int D>
void require_finite(const Vec<D>& value, const std::string& who, const char* field) {
  for (int i = 0; i < D; ++i) require_finite(value[i], who, field);
}
inline void require_not_negative(double value, const std::string& who, const char* field) {
  if (!std::isfinite(value) || value < 0)
    throw Refused("{}: {} is {}, must be finite and not negative", who, field, value);
}

}  // namespace lantern::geometry
