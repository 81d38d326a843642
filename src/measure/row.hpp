// One measured run: a line of the table.
#pragma once

#include <deque>

#include "base/clock.hpp"
#include "base/suggest.hpp"
#include "measure/simulation.hpp"

namespace lantern::measure {

// What a run's error is. A problem with a known answer has a metric that knows it; any other
// scenario is held against its own run at a much finer step.

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
  // What it holds runs against, behind a semicolon its parameters, and the error of that itself in
  // the main norm.
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

  // `parameters` are told behind the reference: "period 6.28 s".
  TrajectoryMetric(long double length, long double speed, ExactStates exact,
                   std::string parameters = "");
  void look(const Observation& now) override;
  std::string reference() const override {
    return ErrorMetric::reference() + "; rounded once" +
           (parameters_.empty() ? "" : "; " + parameters_);
  }
  double reference_error() const override { return kRoundedOnce; }

 private:
  static constexpr double kRoundedOnce = 0x1p-53;  // relative

  double length_, speed_;
  ExactStates exact_at_;
  std::string parameters_;
  Worst& worst_ = norm("traj", "1", trajectory_meaning(length_, speed_));
  std::vector<Exact> exact_;
};

enum class Status {
  ok,
  diverged,   // its error or energy grew beyond all sense, or the world told of an overflow
  collapsed,  // what should stand has fallen
  nan,        // a state was not a number; never of Lantern
  refused,    // the method or the peer would not do it
  left_out,   // not run, as it would have taken too long
};
inline constexpr std::array<std::string_view, 6> kStatusNames = {"ok",  "diverged", "collapsed",
                                                                 "nan", "refused",  "left out"};
inline std::string_view to_string(Status status) {
  return kStatusNames[static_cast<std::size_t>(status)];
}

// Largest relative change over the run; nothing where the scenario does not keep it.
struct Drift {
  std::optional<double> energy;
  std::optional<double> momentum;
  std::optional<double> angular_momentum;
};

// How far a run had gone astray by a moment on its way.
struct DriftSample {
  double time = 0;               // seconds since the start
  double error = 0;              // the main norm so far
  std::optional<double> energy;  // its drift so far; nothing where the scenario does not keep it
};

// The reference of smooth problems, which chooses its own steps: it does no step of a world.
inline constexpr std::string_view kAdaptive = "dormand_prince:adaptive";

struct Row {
  std::string problem;  // the scenario's name: "oscillator_stiff"
  std::string family;   // "oscillator": these share a plot's colours
  std::string variant;  // "plain", "stiff", "extreme"
  std::string file;     // of the scenario, and a hash of its bytes
  std::uint64_t text_hash = 0;
  std::string method;   // the solver's name: "soft:16", "Bullet:10"
  std::string version;  // of a peer; empty for Lantern
  double step = 0;      // seconds; of an adaptive method, what its tolerance follows from
  Status status = Status::ok;
  std::string reference;       // what the error is held against: "closed form", "own run at 1e-4 s"
  double reference_error = 0;  // of that itself, in the main norm, estimated; 0 of what is counted
  std::string reason;          // of any other status
  std::vector<Norm> norms;     // the main one first; empty if there is none
  Drift drift;
  // About a dozen, further and further apart; none where the scenario keeps nothing.
  std::vector<DriftSample> samples;
  double penetration = 0;  // the deepest, units
  double skin = 0;         // the widest of a body, units (Simulation::skin)
  Timing timing;           // by the clock
  Timing processor;        // of the same repeats: whose median is the run's time
  Counted counted;
  std::uint64_t hash = 0;  // of the last state

  bool is_peer() const { return !version.empty(); }
  // Whether the method was given the chance: whatever came of it.
  bool was_run() const { return status != Status::refused && status != Status::left_out; }
  // The main norm, as far as it can be claimed: no less than the reference's own error. Nothing if
  // the run has none or is not ok.
  std::optional<double> error() const {
    if (status != Status::ok || norms.empty()) return std::nullopt;
    const double value = norms.front().value;
    return value < reference_error ? reference_error : value;
  }
};

// What a report says of how and where it was made.
struct Circumstances {
  std::string version;   // of Lantern
  std::string sources;   // a hash of them: two builds of one version may differ
  std::string compiler;  // and its version
  std::string flags;
  std::string processor;
  std::uint64_t seed = 1;
  std::string effort = {};  // "quick", "normal", "full"
  std::string date = {};    // "2026-03-01 12:00 UTC", when it began
  int cores = 0;            // that it may use; it uses one
  // Processes that ran or wanted to, the mean of a minute, when it began and when it ended.
  double load_at_start = 0, load_at_end = 0;
};

double load_of_machine();

// Of this build on this machine, now.
Circumstances here();

// An engine beside Lantern, and how it was run.
struct PeerRecord {
  std::string name, version;  // as in rows
  PeerSettings settings;
  bool operator==(const PeerRecord&) const = default;
};

struct Measurement {
  Circumstances circumstances;
  std::vector<PeerRecord> peers;  // that have rows
  std::vector<Row> rows;          // in order of problems, methods and steps
};

// Who takes part in a bench.
struct Contestant {
  std::string name, version;  // no version: ours
  std::string how;            // a sentence: what of it is run, and how; may be empty
  bool is_peer() const { return !version.empty(); }
};

// What a bench was asked for and has found. Config and circumstances are set beforehand; rows are
// added when all of a stage is done.
template <class ConfigOf, class RowOf>
struct BenchResult {
  ConfigOf config;
  Circumstances circumstances;
  std::string command;               // that asked for it
  std::vector<std::string> missing;  // peers that are not there: a line each
  std::vector<Contestant> contestants;
  std::vector<RowOf> rows;
};

// "Bullet" asks for all of its ways, "Bullet:10" for one. No names ask for all.
inline bool is_asked_for(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || std::ranges::any_of(names, [&](const std::string& asked) {
           return name == asked || name.starts_with(asked + ":");
         });
}

// Leaves only those that are asked for; `name_of` gives the name of one. Throws Refused for a name
// that is none: the line of `missing` that begins with it, or what there is.
template <class T, class NameOf>
void keep_asked_for(std::vector<T>& all, const std::vector<std::string>& names,
                    const std::vector<std::string>& missing, const NameOf& name_of) {
  for (const std::string& name : names) {
    if (std::ranges::any_of(all, [&](const T& one) { return is_asked_for({name}, name_of(one)); }))
      continue;
    for (const std::string& line : missing)
      if (line.starts_with(name + ":")) throw Refused(line);
    std::vector<std::string> there = mapped(all, [&](const T& one) { return name_of(one); });
    throw Refused(with_suggestion(fmt::format("there is no contestant '{}'", name), name,
                                  std::vector<std::string_view>(there.begin(), there.end()),
                                  there.size()));
  }
  std::erase_if(all, [&](const T& one) { return !is_asked_for(names, name_of(one)); });
}

}  // namespace lantern::measure
