// Whole pages of a report.
#pragma once

#include <span>

#include "draw/draw_list.hpp"
#include "measure/broad_phase_cost.hpp"
#include "measure/row.hpp"
#include "measure/stability_map.hpp"
#include "report/bars.hpp"

namespace lantern::report {

// All of a measurement on one page: a small plot of each problem, and the bars.
// In the proportions of A3, 1600 units wide (2263 high) or as much larger as many problems need;
// for fewer than five only as high as these need.
// Each small plot names its scenario's file, so that every number can be found in the rows.
DrawList draw_overview(const Measurement& measurement, const std::vector<Bar>& bars);

// How each engine beside Lantern was run, and who recommends it so: a table 1600 units wide, as
// high as it needs. What is the same as in the line above is left empty.
DrawList draw_peers(const Measurement& measurement);

// The stability map as a picture.
// A page of 1600 x 900 units: a panel a method, the step from left to right, the damping from below
// (none at all has a row of its own), the measured growth as colour, the limit by theory as a line.
// What grows is hatched, too, so that it can be told without colour. A map that ended early has its
// last panels left empty.
DrawList draw_stability_map(const StabilityMap& map);

// The picture that tells where to set a tree's capacity and depth limit for a scene.
// A page of 1600 x 900 units: a grid of counted work over capacity and depth limit, the cheapest
// cell marked and named; a smaller one of time, if times were taken; and what other structures need
// for the same scene. `kind` is one that has settings. A page that says so if there is
// no row of it.
DrawList draw_broad_phase_page(std::span<const BroadPhaseCost> rows, const BoxScene& scene,
                               StructureKind kind);

}  // namespace lantern::report
