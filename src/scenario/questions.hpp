// What a ray meets, a view sees and a region holds, asked of a scene's structures.
#pragma once

#include "physics/world.hpp"
#include "scenario/engine.hpp"
#include "scenario/structures.hpp"

namespace lantern {

// Walks every structure there is; without one, `residents` are asked one by one. Throws Refused for
// a ray, view or region that is not valid.
template <int D>
Finding asked(const CastRay& ray, const Structures<D>& structures, const World<D>& world,
              std::span<const Resident<D>> residents);
template <int D>
Finding asked(const Cull& view, const Structures<D>& structures, const World<D>& world,
              std::span<const Resident<D>> residents);
template <int D>
Finding asked(const Query& region, const Structures<D>& structures, const World<D>& world,
              std::span<const Resident<D>> residents);

}  // namespace lantern
