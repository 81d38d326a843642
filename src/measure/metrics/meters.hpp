// What is read from the states of a run alone: how far joints part, how the energy changes.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "measure/error_metric.hpp"
#include "measure/invariants.hpp"
#include "measure/metrics/reading.hpp"

namespace lantern::measure {

// --- how far the joints of a scenario part, by the states of its bodies alone ---

class JointGaps {
 public:
  // Of its pins and rods. Refuses a scenario without any.
  explicit JointGaps(const Scenario& scenario);

  void look(const std::vector<BodyState>& states);
  double worst() const { return worst_.value(); }  // units, so far

 private:
  struct Joint {
    LinkSpec link;
    double length = 0;  // 0 of a pin
  };
  static double distance(const LinkSpec& link, const std::vector<BodyState>& states);

  std::vector<Joint> joints_;
  Worst worst_;
};

// As the bodies are at first.
std::vector<BodyState> first_states(const Scenario& scenario);

// Where a point of a body is that is given in its own axes.
Vec<3> point_of(const BodyState& state, const Vec<3>& at);

// --- how the energy of a run changes, by the states of its bodies alone ---

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
  double gain() const { return kinetic_ > 0 ? gained_ / kinetic_ : 0; }
  static constexpr const char* kGainMeaning =
      "largest gain of energy over the run, over the largest kinetic energy";
  // The same over what there was at first, which must be above 0.
  double growth() const { return gained_ / start_; }

 private:
  Invariants invariants_;
  bool begun_ = false;
  double start_ = 0, kinetic_ = 0, gained_ = 0;
};

}  // namespace lantern::measure
