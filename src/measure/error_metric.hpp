// What a run is measured by. A problem with a known answer has a metric that knows it; any other
// scenario is held against its own run at a much finer step.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "measure/simulation.hpp"

namespace lantern {

// A moment of a run.
struct Observation {
  double time = 0;  // seconds since the start: steps taken times step
  std::vector<BodyState> states;
  std::uint64_t impacts = 0;  // so far
};

// A named error. What it is relative to is said where the metric is made.
struct Norm {
  std::string name;  // "traj", "att", "times", "apex", "hits", "distance", ...
  double value = 0;
};

class ErrorMetric {
 public:
  virtual ~ErrorMetric() = default;
  // Called for the start and then once for each of the problem's samples, in order of time.
  virtual void look(const Observation& now) = 0;
  // After each look: a problem may have something done to its bodies at a moment.
  virtual void interfere(const Observation&, Simulation&) {}
  // The main norm first. Not finite if the run was.
  virtual std::vector<Norm> norms() const = 0;
};

// Of a scenario with a [problem]. One a run. Throws Refused, naming what is wrong, if the scenario
// is not such a problem: two springs where the oscillator has one, say.
std::unique_ptr<ErrorMetric> make_error_metric(const Scenario& scenario);

// A metric for problems whose bodies are known at every time. The norm "traj" is the largest
// distance from the exact state over the run, in phase space: |dx| / length and |dv| / speed,
// whichever is larger, over the bodies that `exact` gives.
class TrajectoryMetric : public ErrorMetric {
 public:
  TrajectoryMetric(double length, double speed) : length_(length), speed_(speed) {}
  void look(const Observation& now) override;
  std::vector<Norm> norms() const override { return {{"traj", worst_}}; }

 protected:
  struct Exact {
    std::size_t body = 0;
    Vec<3> position{0.0};
    Vec<3> velocity{0.0};
  };
  // Computed in long double; rounded once.
  virtual void exact(double time, std::vector<Exact>& states) const = 0;

 private:
  double length_, speed_;
  double worst_ = 0;
  std::vector<Exact> exact_;
};

}  // namespace lantern
