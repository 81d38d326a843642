// The free top in closed form: how a body that nothing holds turns over any time, however fast.
#pragma once

#include <glm/gtc/quaternion.hpp>

#include "geometry/vec.hpp"

namespace lantern::physics {

// The turn in the body's own axes, q(h) = q(0) * turn, of a body whose angular momentum has the
// components `momentum` along them, not all 0. `excess` are the inverse moments of inertia less the
// middle one: one is 0, one below, one above. What is taken off all three would turn the body about
// its angular momentum besides. `h` may be negative: back in time.
glm::dquat tumbled_freely(const Vec<3>& momentum, const Vec<3>& excess, double h);

}  // namespace lantern::physics
