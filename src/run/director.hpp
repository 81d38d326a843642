// Runs a scenario's script on the engine and gives one Frame a step, or one an event.
#pragma once

#include <functional>
#include <memory>

#include "base/error.hpp"
#include "base/work.hpp"
#include "frame/frame.hpp"
#include "language/scenario.hpp"
#include "physics/world_config.hpp"

namespace lantern::run {

struct DirectorReport {
  std::uint32_t frames = 0;
  std::uint64_t expectations = 0;  // verified
  Diagnostics unmet{50};           // one for each that did not hold
  WorldWork world;                 // what the world did; zeros if there is none
};

class RunWatch;

// Which frames are made for the sink. Each lists all that is there, so that one for every event of
// an insertion is work with the square of the bodies. Whoever looks at outcomes alone spares those
// of events, unless a note may stand on them: they are counted, and what is expected is verified as
// ever, but what an outcome lights as new is new since the last one. Of sides all are made.
enum class Wanted { all, outcomes };

// A script on the stage, step after step.
class Performance {
 public:
  virtual ~Performance() = default;
  // The step of that number, each once and in order. `as` is the scenario that is performed, or one
  // that differs from it only in steps, of as many, that have not been played. Throws
  // ScenarioError, at the step's place, when the engine refuses what the step asks for.
  virtual void play(const Scenario& as, std::size_t step) = 0;
  // The sink has seen enough.
  virtual bool stopped() const = 0;
  // Of all that was played; taken once.
  virtual DirectorReport report() = 0;
};

// Calls `sink` with each frame in order; it returns false to end the run early. The frames depend
// on the scenario and the pace only, whether or not somebody watches. What is given must outlive
// the performance.
std::unique_ptr<Performance> perform(const Scenario& scenario, Pace pace, Work& work,
                                     const std::function<bool(const Frame&)>& sink,
                                     RunWatch* watch = nullptr, Wanted wants = Wanted::all);

// All of its steps. Throws as they do.
DirectorReport direct(const Scenario& scenario, Pace pace, Work& work,
                      const std::function<bool(const Frame&)>& sink, RunWatch* watch = nullptr,
                      Wanted wants = Wanted::all);

}  // namespace lantern::run
