// What is run when a scenario is measured: its [problem]'s time, or its script, cut into pieces at
// which the run is looked at.
#pragma once

#include "language/scenario.hpp"

namespace lantern::measure {

// Some verbs, then a piece of time with `looks` equal parts.
struct Leg {
  std::vector<Verb> before;
  double seconds = 0;
  std::uint32_t looks = 0;  // 0: no time passes
};

struct Schedule {
  std::vector<Leg> legs;
  double seconds = 0;  // of all legs

  // Of a problem its seconds and samples, after the forces that its script begins with. Of any
  // other scenario its script; a step that waits lasts as long as it does in the file's own run.
  // Throws Refused if no time passes in it, or if a step waits for what does not happen.
  static Schedule of(const Scenario& scenario);

  // The step nearest to `wished` that divides every part of every leg. Throws Refused, saying why,
  // for a step that is not above 0 and finite, that is too small to move the clock, or that a
  // script's legs are no multiples of.
  double fitted_step(double wished) const;

  // Steps of `h`, a fitted one, in one part of the leg, and in all.
  std::uint64_t steps_in_part(const Leg& leg, double h) const;
  std::uint64_t steps(double h) const;
};

}  // namespace lantern::measure
