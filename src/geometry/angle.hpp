// Angles.
#pragma once

#include <numbers>

namespace lantern {

inline constexpr double kDegree = std::numbers::pi / 180;  // in radians

}  // namespace lantern
