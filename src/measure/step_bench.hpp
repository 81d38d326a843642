// What a step of many bodies in contact costs, and how exact it is: ours by several efforts, and
// other engines, at the same piles in the same run.
#pragma once

#include "measure/invariants.hpp"

namespace lantern::measure {

// Unit boxes or balls (half size or radius 0.5, density 1, friction 0.5, no bounce) that fall from
// rest into a container: 100 wide in 2D, 12 x 12 in 3D, so that in both N bodies lie in a few
// layers at 500 and in some tens at 5,000. They start in rows 1.22 apart, every other row shifted
// by half of that, boxes tilted by at most 0.15 radians: seeded, the same everywhere.
struct Pile {
  int dimension = 2;
  bool balls = false;
  std::size_t bodies = 500;

  std::string name() const;  // "boxes2d:500"
};

// Of such a name, with 1 ... 100,000 bodies; nothing for any other.
std::optional<Pile> pile_named(std::string_view name);

// Nothing sleeps. Its first bodies are the container's, the `pile.bodies` last those that fall.
// Gravity is 10 along -y, the floor lies at y = 0.
Scenario pile_scene(const Pile& pile, double step, StructureKind structure);

// A pile at some moment, worked out from poses and velocities alone.
struct PileState {
  double deepest = 0;        // overlap of any two bodies, skins and all, units
  double mean = 0;           // of the pairs that touch, each by its deepest point
  std::size_t touching = 0;  // pairs that touch, or nearly do
  double energy = 0;         // J, zero for bodies at rest on the floor's level
  std::size_t outside = 0;   // bodies whose centre has left the container
};

// Lantern's own narrow phase looks at whatever engine has moved the bodies.
class PileGauge {
 public:
  // `scenario` is a pile_scene of `pile` and must outlive this.
  PileGauge(const Pile& pile, const Scenario& scenario);

  // `skins`: how far the engine keeps others off each body's surface (Simulation::skin), units. All
  // states finite.
  PileState of(const std::vector<BodyState>& states, const std::vector<double>& skins) const;

 private:
  bool falls(std::size_t body) const;

  double half_;
  const Scenario& scenario_;
  Invariants invariants_;
  double at_rest_ = 0;  // J, if all lay on the floor
};

struct StepBenchConfig {
  std::vector<Pile> piles;
  double seconds = 4;   // of each fall, in quarters
  double longest = 20;  // processor seconds for one solver and pile: it ends where it is then
  std::vector<std::string> only;  // solvers; empty for our usual efforts and all peers
  bool peers = true;
  StructureKind structure = StructureKind::sort_and_sweep;  // of our broad phase
};

// One solver at one pile. Times are of single steps, in ms of the processor, all threads together:
// on an idle machine, with the one thread that all take, those of the clock.
struct StepRow {
  std::string pile;
  std::string solver;
  std::string version;  // of a peer; empty for ours
  Status status = Status::ok;
  std::string reason;    // of any other status
  double simulated = 0;  // seconds that it came to
  double mean = 0, median = 0, lower_quartile = 0, upper_quartile = 0;
  double last_second = 0;  // the mean
  double wall = 0;         // by the clock, the mean: much more than that if the machine is busy
  PileState end;
  double creep = 0;       // how far bodies moved in the last second, units: the mean
  double most_creep = 0;  // the farthest
  double lost = 0;        // energy, over that of the start
  double gained = 0;      // the largest rise of the energy above what it had been, over the same
  WorldWork work;         // of ours

  bool is_peer() const { return !version.empty(); }
  bool is_whole(double seconds) const { return status == Status::ok && simulated >= seconds; }
};

using StepBenchResult = BenchResult<StepBenchConfig, StepRow>;

// The piles of a run of some minutes, and of one of hours.
std::vector<Pile> usual_piles();
std::vector<Pile> all_piles();

// Our efforts that are measured if nobody asks for others; any name of language/method.hpp that is
// one of contacts can be asked for.
std::span<const std::string_view> usual_efforts();

// Told while a bench runs: how much of a pile is done (0 ... 1).
using StepBenchWatch = std::function<void(const Pile& pile, double share)>;

// Solvers take turns of a quarter of a simulated second each, after a few steps for warmth. Only
// steps are timed. Throws Refused for a name that is none, and Stopped.
void bench_steps(StepBenchResult& result, const StepBenchWatch& watch);

// How long ours would need to be as exact as a peer at a pile.
struct StepComparison {
  std::string pile, peer;
  double of = 1;       // the share of the peer's penetration that is asked for
  double deepest = 0;  // which is this, units
  double peer_ms = 0;  // its mean step
  double our_ms = 0;   // of an effort or between two; 0: none of ours is so exact
  std::string by;      // that effort, or both
  double ratio() const { return our_ms / peer_ms; }
};

// For each peer at each pile, at its penetration and at a hundredth of it. Only runs that came to
// their end count. Between two of our efforts, logarithms of penetration and time are interpolated.
std::vector<StepComparison> compared(const StepBenchResult& result);

}  // namespace lantern::measure
