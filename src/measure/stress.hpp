// Stress: what must hold on extreme input, stiff springs and at the limits of stability, case by
// case. Each case drives the real engine and gives one figure with a meaning, and the bound that it
// must keep. What a scenario can say is one, in scenarios/stress/; all else is here.
#pragma once

#include "physics/integrate/integrator.hpp"

namespace lantern::measure {

struct StressResult {
  double figure = std::numeric_limits<double>::quiet_NaN();  // not a number: the case broke off
  std::string unit;                                          // "m", "pairs", "relative", ...
  double bound = 0;
  bool at_least = false;  // the figure must be no less than the bound; else no more
  bool good = false;
  std::string detail;  // how much was tried, or what was worst
};

// The verdicts. A figure that is not a number keeps no bound.
StressResult at_most(double bound, double figure, std::string unit, std::string detail = {});
StressResult at_least(double bound, double figure, std::string unit, std::string detail = {});

// The same input gives the same figure, bit for bit. `run` may throw: see run_case.
struct StressCase {
  std::string_view name;   // "coincident_bodies"
  std::string_view group;  // "extreme input", "stiff", "stability", "energy", "bars"
  std::string_view what;   // one plain sentence: what must happen
  std::function<StressResult()> run{};
  bool slow = false;  // takes more than a few seconds: only run when asked for
};

struct StressOutcome {
  StressCase of;
  StressResult result;
};

// All cases; those of a group need not stand together. Names differ.
std::span<const StressCase> stress_cases();

// A case that throws has failed, and the message is its detail. Nothing is thrown but Stopped.
StressOutcome run_case(const StressCase& stress_case);

// The tables of the topics, a file each (stress_<topic>.cpp), in the order of the whole table.
using StressTopic = std::vector<StressCase>();
StressTopic tree_cases, input_cases, shape_cases, origin_cases, step_cases, contact_cases,
    stiff_cases, stability_cases, energy_cases, law_cases;

// The stability map: how much one step of each method multiplies a damped spring's motion, measured
// with the real engine, over the step (omega h) and the damping ratio (zeta).

// The growth a step: the spectral radius of the step's matrix, which takes (x, v) to the next
// (x, v). The spring is linear, so a step is, too: two steps of the engine from independent starts
// give the matrix. A long run grows or shrinks by this factor a step.
double measured_growth(Integrator method, double omega_h, double zeta);

// The same by theory: the method is stable for omega h below this. 0 if never, infinite if always.
// For explicit methods see Hairer, Norsett and Wanner, "Solving Ordinary Differential Equations I".
double stability_limit(Integrator method, double zeta);

// A growth beyond rounding.
inline bool grows(double growth) { return !(growth <= 1 + 1e-9); }

struct StabilityMap {
  struct Panel {
    Integrator method{};
    std::vector<double> growth;  // of omega_h[i] and zeta[j] at [j * omega_h.size() + i]
  };
  std::vector<double> omega_h;  // ascending, the logarithmic middles of the cells
  std::vector<double> zeta;     // 0 first, then ascending as those
  double omega_low = 1e-2, omega_high = 1e2, zeta_low = 1e-3,
         zeta_high = 1e3;     // edges of the cells
  std::vector<Panel> panels;  // one a method

  double growth_at(const Panel& panel, std::size_t column, std::size_t row) const {
    return panel.growth[row * omega_h.size() + column];
  }
};

// From 0.01 to 100 in omega h, 0.001 to 1000 in zeta.
StabilityMap make_stability_map();

}  // namespace lantern::measure
