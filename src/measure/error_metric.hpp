// What a run's error is. A problem with a known answer has a metric that knows it; any other
// scenario is held against its own run at a much finer step.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "measure/simulation.hpp"

namespace lantern::measure {

// A moment of a run.
struct Observation {
  double time = 0;  // seconds since the start: steps taken times step
  std::vector<BodyState> states;
  std::uint64_t impacts = 0;  // so far
  // How far the engine keeps others off each body (Simulation::skin); empty if it does not.
  std::vector<double> skins = {};
  double skin(std::size_t body) const { return skins.empty() ? 0 : skins[body]; }
};

// A named error, with its unit and its definition: whoever reads the number needs both.
struct Norm {
  std::string name;  // "traj", "att", "times", "apex", "hits", "distance", ...
  double value = 0;
  std::string unit = "1";    // "1" of what is relative
  std::string meaning = {};  // "largest tilt over the run of a box that should stand"
  bool operator==(const Norm&) const = default;
};

class ErrorMetric {
 public:
  virtual ~ErrorMetric() = default;
  // What it holds runs against, and the error of that itself in the main norm.
  virtual std::string reference() const { return "closed form"; }
  virtual double reference_error() const { return 0; }
  // Another of its kind that has seen nothing yet, if to make it from the scenario would be costly:
  // it shares the reference. Else nothing.
  virtual std::unique_ptr<ErrorMetric> fresh() const { return nullptr; }
  // Called for the start and then once for each of the problem's samples, in order of time.
  virtual void look(const Observation& now) = 0;
  // After each look: a problem may have something done to its bodies at a moment.
  virtual void interfere(const Observation&, Simulation&) {}
  // The main norm first. Not finite if the run was.
  virtual std::vector<Norm> norms() const = 0;
  // Why the run is a failure although all its numbers are sound: what should stand has fallen.
  // Nothing if it stands, or nothing should.
  virtual std::optional<std::string> collapse() const { return std::nullopt; }
};

// Of a scenario with a [problem]. One a run. Throws Refused, naming what is wrong, if the scenario
// is not such a problem: two springs where the oscillator has one, say.
std::unique_ptr<ErrorMetric> make_error_metric(const Scenario& scenario);

// Throws Refused as that does, as far as it can be told at once: to know some answers takes runs of
// their own, or the cube of their bodies.
void require_problem(const Scenario& scenario);

// The norm "traj": the largest distance from the exact state over the run, in phase space:
// |dx| / length or |dv| / speed, whichever is larger.
Norm trajectory_norm(double value, double length, double speed);

// Of problems whose bodies are known at every time: "traj", over the bodies that `exact` gives.
class TrajectoryMetric : public ErrorMetric {
 public:
  struct Exact {
    std::size_t body = 0;
    Vec<3> position{0.0};
    Vec<3> velocity{0.0};
  };
  // Computed in long double; rounded once.
  using ExactStates = std::function<void(double time, std::vector<Exact>& states)>;

  TrajectoryMetric(long double length, long double speed, ExactStates exact);
  void look(const Observation& now) override;
  std::vector<Norm> norms() const override { return {trajectory_norm(worst_, length_, speed_)}; }

 private:
  double length_, speed_;
  ExactStates exact_at_;
  double worst_ = 0;
  std::vector<Exact> exact_;
};

}  // namespace lantern::measure
