// One measured run: a line of the table.
#pragma once

#include "base/timing.hpp"
#include "measure/error_metric.hpp"

namespace lantern::measure {

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
  std::string reference;  // what the error is held against: "closed form", "own run at 1e-4 s"
  double reference_error =
      0;                    // of that itself, in the main norm, estimated; a closed form has none
  std::string reason;       // of any other status
  std::vector<Norm> norms;  // the main one first; empty if there is none
  Drift drift;
  // About a dozen, further and further apart; none where the scenario keeps nothing.
  std::vector<DriftSample> samples;
  double penetration = 0;  // the deepest, units
  double skin = 0;         // the widest of a body, units (Simulation::skin)
  Timing timing;
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
  std::string effort;  // "quick", "normal", "full"
};

// Of this build on this machine.
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

}  // namespace lantern::measure
