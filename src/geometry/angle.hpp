// Angles.
#pragma once

#include <numbers>

namespace lantern::geometry {

inline constexpr double kDegree = std::numbers::pi / 180;  // in radians

}  // namespace lantern::geometry
