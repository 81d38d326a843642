// What a run's error is. A problem with a known answer has a metric that knows it; any other
// scenario is held against its own run at a much finer step.
#pragma once

#include <deque>

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

// The largest error met, or the last one set. Once it is no number it stays so.
class Worst {
 public:
  void meet(double error) {
    if (std::isnan(value_)) return;
    if (!(std::abs(error) <= value_)) value_ = std::abs(error);
  }
  void set(double error) { value_ = error; }
  double value() const { return value_; }

 private:
  double value_ = 0;
};

class ErrorMetric {
 public:
  virtual ~ErrorMetric() = default;
  // What it holds runs against, and the error of that itself in the main norm.
  virtual std::string reference() const { return "closed form"; }
  virtual double reference_error() const { return 0; }
  // Called for the start and then once for each of the problem's samples, in order of time.
  virtual void look(const Observation& now) = 0;
  // After each look: a problem may have something done to its bodies at a moment.
  virtual void interfere(const Observation&, Simulation&) {}
  // The main norm first. Not finite if the run was.
  std::vector<Norm> norms() const;
  // Why the run is a failure although all its numbers are sound: what should stand has fallen.
  // Nothing if it stands, or nothing should.
  virtual std::optional<std::string> collapse() const { return std::nullopt; }

 protected:
  // Declares a norm, the main one first, and gives where its error is met or set.
  Worst& norm(std::string name, std::string unit, std::string meaning) {
    return norms_.emplace_back(Declared{{std::move(name), 0, std::move(unit), std::move(meaning)}})
        .error;
  }
  // The problem has no such norm after all.
  void drop(const Worst& error) {
    for (Declared& one : norms_) one.dropped |= &one.error == &error;
  }

 private:
  struct Declared {
    Norm norm;
    Worst error = {};
    bool dropped = false;
  };
  std::deque<Declared> norms_;
};

// Makes the metric of a run; all that it makes share what is costly to know.
using MetricMaker = std::function<std::unique_ptr<ErrorMetric>()>;

// Of a scenario with a [problem], which must outlive it. This or the first that is made throws
// Refused, naming what is wrong, if the scenario is not such a problem: two springs where the
// oscillator has one, say.
MetricMaker metrics_of(const Scenario& scenario);
// One of them.
std::unique_ptr<ErrorMetric> make_error_metric(const Scenario& scenario);

// Throws Refused as that does, as far as it can be told at once: to know some answers takes runs of
// their own, or the cube of their bodies.
void require_problem(const Scenario& scenario);

// Of the norm "traj", in phase space: |dx| / length or |dv| / speed, whichever is larger.
std::string trajectory_meaning(double length, double speed);

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

 private:
  double length_, speed_;
  ExactStates exact_at_;
  Worst& worst_ = norm("traj", "1", trajectory_meaning(length_, speed_));
  std::vector<Exact> exact_;
};

}  // namespace lantern::measure
