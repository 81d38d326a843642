// One measured run: a line of the table.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measure/simulation.hpp"
#include "measure/error_metric.hpp"

namespace lantern {

enum class Status {
  ok,
  diverged,  // its error or energy grew beyond all sense, or the world told of an overflow
  nan,       // a state was not a number; never of Lantern
  refused,   // the method or the peer would not do it
};
std::string_view to_string(Status status);

// Seconds of a whole run, over repeats. Zero repeats: not timed.
struct Timing {
  int repeats = 0;
  double median = 0;
  double least = 0;
  double spread = 0;  // interquartile range
};

// Largest relative change over the run; nothing where the scenario does not keep it.
struct Drift {
  std::optional<double> energy;
  std::optional<double> momentum;
  std::optional<double> angular_momentum;
};

struct Row {
  std::string problem;  // the scenario's name: "oscillator_stiff"
  std::string family;   // "oscillator": these share a plot's colours
  std::string variant;  // "plain", "stiff", "extreme"
  std::string file;     // of the scenario, and a hash of its bytes
  std::uint64_t text_hash = 0;
  std::string method;   // the solver's name
  std::string version;  // of a peer; empty for Lantern
  double step = 0;      // seconds; of an adaptive method, what its tolerance follows from
  Status status = Status::ok;
  std::string reference;    // what the error is held against: "closed form", "own run at 1e-4 s"
  std::string reason;       // of any other status
  std::vector<Norm> norms;  // the main one first; empty if there is none
  Drift drift;
  double penetration = 0;  // the deepest, units
  Timing timing;
  Counted counted;
  std::uint64_t hash = 0;  // of the last state

  bool is_peer() const { return !version.empty(); }
  // The main norm; nothing if the run has none or is not ok.
  std::optional<double> error() const {
    if (status != Status::ok || norms.empty()) return std::nullopt;
    return norms.front().value;
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

// Of this build on this machine; `version` and `sources` are Lantern's.
Circumstances here(std::string_view version, std::string_view sources);

struct Measurement {
  Circumstances circumstances;
  std::vector<Row> rows;  // in order of problems, solvers and steps
};

}  // namespace lantern
