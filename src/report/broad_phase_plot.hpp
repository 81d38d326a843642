// The picture that tells where to set a tree's capacity and depth limit for a scene.
#pragma once

#include <span>

#include "draw/draw_list.hpp"
#include "measure/broad_phase_cost.hpp"

namespace lantern {

// A page of 1600 x 900 units: a grid of counted work over capacity and depth limit, the cheapest
// cell marked and named; a smaller one of time, if times were taken; what other structures need for
// the same scene; and a sentence. `kind` is one that has settings. A page that says so if there is
// no row of it.
DrawList draw_broad_phase_page(std::span<const BroadPhaseCost> rows, const BoxScene& scene,
                               StructureKind kind);

}  // namespace lantern
