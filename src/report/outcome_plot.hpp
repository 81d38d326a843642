// Plots for problems where error against work says little: those that are right or wrong, and those
// whose work does not depend on the step.
#pragma once

#include <map>
#include <string>

#include "draw/plot.hpp"
#include "report/problem_rows.hpp"

namespace lantern {

// A method as a line of a plot, without points. `looks` must hold it (looks_of).
PlotSeries series_of(const MethodRows& method, const std::map<std::string, int>& looks);

// Of a plot whose errors are whole numbers: bands "exact", "off by 1", "off by 2 to 9", ..., as
// many as its points need, each wrong point with its number beside it.
void put_into_bands(Plot& plot);

// A value of each run against its step: its seconds, say. Nothing is left out, what is not finite
// goes to the upper edge. Where errors are whole numbers, wrong runs are open marks. `looks` must
// hold every method (looks_of).
Plot step_plot(const ProblemRows& problem, const Cost& value,
               const std::map<std::string, int>& looks);

// Whether a count of work is the same for all runs that have it, so that nothing is to be seen.
bool is_one_count(const ProblemRows& problem, const WorkCount& work);

}  // namespace lantern
