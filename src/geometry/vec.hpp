#pragma once

#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "rooms.hpp"

namespace lantern::geometry {

// A point or direction of D dimensions, in double. Index 0 is x, 1 is y (up), 2 is z.
template <int D>
using Vec = glm::vec<D, double>;

inline constexpr double kDegree = std::numbers::pi / 180;  // in radians

}  // namespace lantern::geometry
