// What a long run is told of: beforehand once, and then how far it is.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "app/forecast.hpp"
#include "base/clock.hpp"
#include "base/work.hpp"

namespace lantern::app {

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
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // From any thread: how many frames or parts are done by now.
  void done(std::uint64_t count) { count_ = count; }
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

}  // namespace lantern::app
