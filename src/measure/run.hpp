// Runs a scenario by a solver at a step, looks at it with a metric, times it, and makes a
// row of it.
#pragma once

#include <functional>
#include <memory>

#include "measure/schedule.hpp"
#include "measure/invariants.hpp"
#include "measure/row.hpp"

namespace lantern {

// How a run is timed, after a warm-up. A repeat runs as often as it takes to fill `least_seconds`.
struct TimingRule {
  int repeats = 15;
  double least_seconds = 0.05;
};

// What the runs of one scenario are held against.
struct Reference {
  std::string text;  // "closed form"
  std::function<std::unique_ptr<ErrorMetric>()> make;
};

// A problem's own metric; otherwise the scenario's run at `step`, which should be much finer
// than those to be measured: by RK4 where nothing collides, else as the file is written. Throws
// Refused if the scenario is not the problem it claims to be, or if that run fails.
Reference reference_for(const Scenario& scenario, const Schedule& schedule, double step);

// `h` must be fitted to the schedule. Whatever goes wrong in the run is the row's status; nothing is
// thrown but Stopped. Two runs of Lantern that differ are a broken invariant.
Row measure(const Scenario& scenario, const Schedule& schedule, const Solver& solver, double h,
            const Reference& reference, const Invariants& invariants, const TimingRule& rule);

// Seconds that one run would take, from its first few milliseconds. 0 if it fails at once.
double estimated_seconds(const Scenario& scenario, const Schedule& schedule,
                         const Solver& solver, double h);

}  // namespace lantern
