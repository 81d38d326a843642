// A problem's error against what it costs, as pictures.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "draw/draw_list.hpp"
#include "draw/plot.hpp"
#include "report/problem_rows.hpp"

namespace lantern {

// One plot of a problem: its contestants as series, the observed order behind each name if
// `with_orders`, runs that failed at the upper edge, the estimated rounding floor, the Pareto
// front. `looks` must hold every contestant (looks_of).
Plot cost_plot(const ProblemRows& problem, const Cost& cost,
               const std::map<std::string, int>& looks, bool with_orders);

// A page of 1600 x 900: error against seconds at the left, against counted work at the right, one
// legend, the sentence below. Where no row is timed, the left plot says so.
DrawList measure_page(const ProblemRows& problem, const Circumstances& circumstances,
                      const std::map<std::string, int>& looks);

// One for each problem, named after it.
struct MeasurePage {
  std::string name;
  DrawList list;
};
std::vector<MeasurePage> measure_pages(const Measurement& measurement);

// "version 0.1.0 · g++ 13 · AMD ... · seed 1".
std::string circumstances_text(const Circumstances& circumstances);

// "oscillator, stiff" of oscillator_stiff; only the name where the variant is plain.
std::string problem_words(const ProblemRows& problem);

}  // namespace lantern
