// A problem's error against what it costs, and against time.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "draw/plot.hpp"
#include "report/problem_rows.hpp"

namespace lantern::report {

// One plot of a problem: its methods as series, the observed order behind each name if
// `with_orders`, runs that failed at the upper edge, the estimated rounding floor, the Pareto
// front. `looks` must hold every method (looks_of).
Plot cost_plot(const ProblemRows& problem, const Cost& cost, const Looks& looks, bool with_orders);

// The two plots of a problem: error against seconds and against counted work. Runs that are only
// right or wrong are shown by their outcome, and what they cost against the step: in seconds, or
// where none is timed in work. Their series are in the order of by_method.
std::pair<Plot, Plot> plots_of(const ProblemRows& problem, const Looks& looks);

// "oscillator, stiff" of oscillator_stiff; only the name where the variant is plain.
std::string problem_words(const ProblemRows& problem);

// The scenario's file, without its folder.
std::string file_name(const ProblemRows& problem);

// "error: state (“traj”), against: closed form", with the unit of what is not relative.
std::string error_words(const ProblemRows& problem);

// Far-off values go to the upper edge too, if there are others.
void send_far_ones_off(Plot& plot);

// A method as a line of a plot, without points. `looks` must hold it (looks_of).
PlotSeries series_of(const MethodRows& method, const Looks& looks);

// Of a plot whose errors are whole numbers: bands "exact", "off by 1", "off by 2 to 9", ..., as
// many as its points need, each wrong point with its number beside it.
void put_into_bands(Plot& plot);

// A value of each run against its step: its seconds, say. Nothing is left out, what is not finite
// goes to the upper edge. Where errors are whole numbers, wrong runs are open marks. `looks` must
// hold every method (looks_of).
Plot step_plot(const ProblemRows& problem, const Cost& value, const Looks& looks);

// Whether a count of work is the same for all runs that have it, so that nothing is to be seen.
bool is_one_count(const ProblemRows& problem, const WorkCount& work);

// How runs of a problem go astray with time, of runs with one step: that which most methods share,
// of several the finest. Series are in the order of by_method, without points for who has no such
// run.
struct DriftPlots {
  Plot error;   // the main norm so far, against seconds since the start
  Plot energy;  // its drift so far; without points where the problem does not keep it
};
// Nothing if no run has samples.
std::optional<DriftPlots> drift_plots(const ProblemRows& problem, const Looks& looks);

}  // namespace lantern::report
