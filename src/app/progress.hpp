// What a long run is told of: how much it has to do beforehand, once, and then how far it is; and
// how it is ended by Ctrl-C and kill, within 0.2 s, wherever it is.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "base/clock.hpp"
#include "base/work.hpp"
#include "language/scenario.hpp"

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
  // That are drawn in the end, if it is known: of a film.
  std::optional<std::uint64_t> pictures = std::nullopt;
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

// Tells of a piece of work while it lasts: on a terminal in one line that is rewritten every 0.1 s,
// elsewhere in a plain line every 5 s. It does so from a thread of its own, so that it goes on
// while one part of the work takes long; where standard error leads nowhere there is none.
class Progress {
 public:
  // Of the run of a scenario: says beforehand, once, what is to come, if that will take more than a
  // moment. World steps are read off `work`, which must outlive this; `waiting` tells, from any
  // thread, how many of the frames that are done are not drawn yet.
  Progress(
      std::string name, const RunExtent& extent, const Work& work,
      std::optional<std::size_t> memory_budget = std::nullopt,
      std::function<std::uint64_t()> waiting = [] { return std::uint64_t{0}; });
  // Of so many equal parts.
  Progress(std::string name, std::uint64_t total, std::string unit);
  ~Progress();
  Progress& operator=(Progress&&) = delete;  // nor any other copy or move

  // From any thread: how many frames or parts are done by now.
  void done(std::uint64_t count) { count_ = count; }
  // Seconds that are left, if it was told what is to come and they are many, else 0. From any
  // thread.
  double long_left() const { return long_left_; }
  // In other words, for work whose parts are not equally long; `words` stay until the next ones.
  void tell(std::string words);

 private:
  void start();
  void watch();
  void look(RunState& state);
  std::string words();

  std::string name_;
  std::optional<RunExtent> extent_;  // of a scenario's run
  const Work* work_ = nullptr;
  std::function<std::uint64_t()> waiting_;
  std::uint64_t steps_before_ = 0;  // that the work had when this began
  std::uint64_t files_before_ = 0;
  std::uint64_t bytes_before_ = 0;
  std::uint64_t between_before_ = 0;
  std::uint64_t drawn_before_ = 0;
  std::optional<std::size_t> budget_;
  std::uint64_t total_ = 0;
  std::string unit_;
  std::atomic<std::uint64_t> count_{0};
  std::atomic<double> long_left_{0};

  // Of the thread alone.
  double last_change_ = 0;  // when something was finished
  std::uint64_t last_frames_ = 0;
  double undrawn_until_ = 0;  // when no frame had been drawn yet

  Stopwatch watch_;
  std::mutex lock_;  // of the words and the end
  std::string told_;
  bool ended_ = false;
  std::condition_variable end_;
  std::thread thread_;
};

// From here on SIGINT and SIGTERM are a wish to stop (base/stop.hpp), which our own loops hear. For
// what cannot hear it (a driver, a compiler of shaders, another engine, a pipe that nobody reads) a
// timer ends the process soon after, with exit code 130; files are whole at every moment, so that
// nothing finished is lost. Writes to a closed pipe, or beyond a limit, fail as other writes do.
void catch_interrupts();

// What is finished is about to be saved and told: the timer gives it a few seconds. A second signal
// then ends the process at once.
void give_time_to_save();

}  // namespace lantern::app
