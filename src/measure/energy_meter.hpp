// How the energy of a run changes, by the states of its bodies alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "measure/error_metric.hpp"
#include "measure/invariants.hpp"

namespace lantern::measure {

class EnergyMeter {
 public:
  // The scenario must outlive it.
  explicit EnergyMeter(const Scenario& scenario) : invariants_(scenario) {}

  // Gives what it found.
  Kept look(const Observation& at) {
    const Kept now = invariants_.of(at.states);
    if (!begun_) start_ = now.energy;
    begun_ = true;
    kinetic_ = std::max(kinetic_, now.kinetic_energy);
    gained_ = std::max(gained_, now.energy - start_);
    return now;
  }

  // The largest gain so far, over the largest kinetic energy.
  Norm gain_norm() const {
    return {"gain", kinetic_ > 0 ? gained_ / kinetic_ : 0, "1",
            "largest gain of energy over the run, over the largest kinetic energy"};
  }
  // The same over what there was at first, which must be above 0.
  double growth() const { return gained_ / start_; }

 private:
  Invariants invariants_;
  bool begun_ = false;
  double start_ = 0, kinetic_ = 0, gained_ = 0;
};

}  // namespace lantern::measure
