// What a computation may bring about, and no engine may keep.
#pragma once

#include <limits>

namespace lantern {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace lantern
