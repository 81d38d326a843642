// The words in which a long run is told of: what is known of it in, text out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "scenario/scenario.hpp"

namespace lantern::app {

// How much a run has to do, as far as it is known beforehand.
struct RunExtent {
  // At most; none in event pace: only the run can tell.
  std::optional<std::uint64_t> frames = std::nullopt;
  std::uint64_t world_steps = 0;  // at most
  // Of the frames, how many are chosen to be written; none: all.
  std::optional<std::uint64_t> chosen = std::nullopt;
  // Before each frame that is written but the first, at most.
  std::uint64_t in_betweens = 0;
};
RunExtent extent_of(const Scenario& scenario, Pace pace);

// How far it is.
struct RunState {
  double seconds = 0;         // since it began
  std::uint64_t frames = 0;   // that it has given
  std::uint64_t waiting = 0;  // those of them that are not drawn yet
  std::uint64_t in_betweens = 0;
  std::uint64_t drawn = 0;  // pictures
  std::uint64_t world_steps = 0;
  double step_seconds = 0;  // since the first world step began, or, before the first is done,
                            // since anything was finished
  double draw_seconds = 0;  // since the first frame was drawn
  std::uint64_t files = 0;  // frames on the disk, with all that belongs to them
  std::uint64_t bytes = 0;  // of those
  std::optional<std::size_t> memory;  // bytes that the process has now
  std::optional<std::size_t> budget;  // and may have
};

// Seconds that are left, measured from what is done. `at_least`: not even one world step is done,
// or frames wait of which none is drawn, so that it is only known that it takes more than this.
// Nothing if nothing can be told yet.
struct TimeLeft {
  double seconds = 0;
  bool at_least = false;
};
std::optional<TimeLeft> time_left(const RunExtent& extent, const RunState& state);

// "up to 1001 frames of 600 000 world steps, about 3 h left; about 1.2 GB on the disk; 0.4 GB of
// memory (budget 12 GB)"
std::string forecast_text(const RunExtent& extent, const RunState& state);

// "7 of 70 frames, 49 in-betweens, 212 of 4000 world steps, about 12 s left"; when the run is over
// and its pictures are being drawn, "70 of 70 frames, 212 pictures drawn"
std::string progress_text(const RunExtent& extent, const RunState& state);

std::string duration_text(double seconds);  // "3 h"

}  // namespace lantern::app
