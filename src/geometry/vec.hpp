#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "rooms.hpp"

namespace lantern::geometry {

// A point or direction of D dimensions, in double. Index 0 is x, 1 is y (up), 2 is z.
template <int D>
using Vec = glm::vec<D, double>;

}  // namespace lantern::geometry
