// What a ray meets, a view sees and a region holds, asked of a scene's structures.
#pragma once

#include "physics/world.hpp"
#include "run/engine.hpp"

namespace lantern::run {

// Walks the world's structure, which has looked ahead. Throws Refused
// for a ray, view or region that is not valid.
template <int D>
Finding asked(const Question& question, const World<D>& world);

}  // namespace lantern::run
