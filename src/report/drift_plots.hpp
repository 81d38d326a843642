// How runs of a problem go astray with time.
#pragma once

#include <optional>
#include <string>

#include "draw/plot.hpp"
#include "report/problem_rows.hpp"

namespace lantern::report {

// Of runs with one step: that which most methods share, of several the finest. Series are in the
// order of by_method, without points for who has no such run.
struct DriftPlots {
  Plot error;   // the main norm so far, against seconds since the start
  Plot energy;  // its drift so far; without points where the problem does not keep it
};

// Nothing if no run has samples.
std::optional<DriftPlots> drift_plots(const ProblemRows& problem, const Looks& looks);

// A page of 1600 x 900: both plots, one legend. The problem must have samples.
// Looks and circumstances are those of the measurement, of which the problem is a part.
DrawList draw_drift(const ProblemRows& problem, const Measurement& measurement);

}  // namespace lantern::report
