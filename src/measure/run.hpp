// Runs a scenario by a solver at a step, holds it against a reference, times it, and makes a row of
// it.
#pragma once

#include "measure/invariants.hpp"
#include "measure/schedule.hpp"

namespace lantern::measure {

// What the runs of one scenario are held against.
struct Reference {
  std::string text;  // "closed form; period 6.28 s; looked at 65 times in 12.6 s"
  MetricMaker make;
  double error = 0;  // its own, estimated, in the main norm
};

// A problem's own metric, whatever the step; otherwise the scenario's run at `step`, which should
// be much finer than those to be measured: by RK4 where nothing collides, else as the file is
// written. The error of that run is taken to be its distance from the same run at twice the step,
// which is no less as long as halving the step helps. Throws Refused if the scenario is not the
// problem it claims to be, or if that run fails.
Reference reference_for(const Scenario& scenario, const Schedule& schedule, double step);

// The runs of one scenario. It and what it refers to must outlive them.
struct Trials {
  const Scenario& scenario;
  const Schedule& schedule;
  const Invariants& invariants;
  const Reference& reference;
};

// A row of which nothing is known yet but what is to be run. `h` must be fitted to the schedule.
Row blank_row(const Scenario& scenario, const Solver& solver, double h);

// One run, which is not timed. Whatever goes wrong in it is the row's status; nothing is thrown but
// Stopped. `processor_seconds`, if given, is what the run took; it is left alone if the run broke
// off.
Row evaluated(const Trials& trials, const Solver& solver, double h,
              double* processor_seconds = nullptr);

// A row that is ok, to be timed.
struct TimedRun {
  const Solver* solver = nullptr;
  Row* row = nullptr;
  TimingRule rule;
};

// Times them in turn: one repeat of each, then the next of each, so that what else the machine does
// meanwhile falls on all alike; whose median is known well enough has no further ones. `told` is
// called after each repeat with the place of its run. Two runs of Lantern that differ are a broken
// invariant.
void time_in_turn(const Trials& trials, std::span<const TimedRun> runs,
                  const std::function<void(std::size_t)>& told);

// Processor seconds that one run would take, from its first few milliseconds: whether it is left
// out as too long must not depend on what else the machine does. 0 if it fails at once.
double estimated_seconds(const Scenario& scenario, const Schedule& schedule, const Solver& solver,
                         double h);

}  // namespace lantern::measure
