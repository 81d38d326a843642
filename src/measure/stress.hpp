// Stress: what must hold on extreme input, stiff springs and at the limits of stability, case by
// case. Each case drives the real engine and gives one figure with a meaning, and the bound that it
// must keep. What a scenario can say is one, in scenarios/stress/; all else is here.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rooms.hpp"

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
    stiff_cases, stability_cases, energy_cases, bar_cases;

}  // namespace lantern::measure
