// Whole pages of a report, as pictures.
#pragma once

#include "measure/broad_phase_cost.hpp"
#include "report/problem_rows.hpp"
#include "report/stress_tables.hpp"

namespace lantern::report {

// The title in bold, behind it what else is to be said, and a rule below, at y = 78 page units.
void draw_page_title(const std::string& title, const std::string& rest, double margin,
                     DrawList& list, Labels& labels);

// "Lantern 0.1.0 · gcc 13 · AMD ... · seed 1".
std::string circumstances_text(const Circumstances& circumstances);

// Pages of 1600 x 900 of a problem, two plots each with one legend, notes and circumstances below:
// error against seconds at the left, against counted work at the right; and how error and energy
// went with time, nothing where drift_plots() has nothing. Looks and circumstances are those of the
// measurement, of which the problem is a part.
DrawList draw_problem(const ProblemRows& problem, const Measurement& measurement);
std::optional<DrawList> draw_drift(const ProblemRows& problem, const Measurement& measurement);

// One plot to be projected: error against run time, names at the lines, who_is_quickest() below.
DrawList draw_slide(const ProblemRows& problem, const Measurement& measurement);

// All of a measurement on one page: a small plot of each problem, and the bars.
// In the proportions of A3, 1600 units wide (2263 high) or as much larger as many problems need;
// for fewer than five only as high as these need.
// Each small plot names its scenario's file, so that every number can be found in the rows.
DrawList draw_overview(const Measurement& measurement, const std::vector<Bar>& bars);

// How each engine beside Lantern was run, and who recommends it so: a table 1600 units wide, as
// high as it needs.
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
// for the same scene. `kind` is one that has settings. A page that says so if there is no row of
// it.
DrawList draw_broad_phase_page(std::span<const BroadPhaseCost> rows, const BoxScene& scene,
                               StructureKind kind);

}  // namespace lantern::report
