// Bounds on the time of a stage: the wish to stop is raised when it takes long, as by Ctrl-C. Who
// does not hear it hangs.
#pragma once

#include <chrono>
#include <condition_variable>
#include <ctime>
#include <functional>
#include <mutex>
#include <thread>

#include "base/stop.hpp"
#include "fuzz/sees_all.hpp"

namespace lantern::fuzz {

// What this process has worked, not what others kept it waiting; but who sleeps for ever gets old,
// too.
struct BusyClock {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<BusyClock>;
  static constexpr bool is_steady = true;

  static time_point now() {
    timespec busy{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &busy);
    const auto wall = std::chrono::steady_clock::now().time_since_epoch();
    return time_point(std::chrono::seconds(busy.tv_sec) + duration(busy.tv_nsec) +
                      std::chrono::duration_cast<duration>(wall) / 500);
  }
};

class Watch {
 public:
  using Clock = BusyClock;

  // `hangs` is called, from another thread, when the stage goes on for `grace` after the wish.
  Watch(Clock::duration patience, Clock::duration grace, std::function<void()> hangs)
      : patience_(patience), grace_(grace), hangs_(std::move(hangs)) {}

  // Runs `stage`. False if it was stopped, or had heard the wish when it ended.
  template <class F>
  bool bounded(F&& stage) {
    begin();
    bool whole = true;
    try {
      stage();
    } catch (const Stopped&) {
      whole = false;
    } catch (...) {
      end();
      throw;
    }
    return end() && whole;
  }

  // The longest time from a wish to the end of its stage.
  Clock::duration slowest() const { return slowest_; }

 private:
  void begin() {
    const std::lock_guard lock(mutex_);
    due_ = Clock::now() + patience_;
    running_ = true;
  }

  bool end() {
    const std::lock_guard lock(mutex_);
    running_ = false;
    const bool whole = !stop_asked();
    if (!whole) slowest_ = std::max(slowest_, Clock::now() - due_);
    forget_stop();
    return whole;
  }

  void look(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
      tick_.wait_for(lock, stop, std::chrono::milliseconds(5), [] { return false; });
      if (!running_) continue;
      const Clock::time_point now = Clock::now();
      if (now > due_) ask_to_stop();
      if (now > due_ + grace_) hangs_();
    }
  }

  Clock::duration patience_, grace_;
  std::function<void()> hangs_;
  std::mutex mutex_;
  std::condition_variable_any tick_;
  bool running_ = false;
  Clock::time_point due_{};
  Clock::duration slowest_{};
  std::jthread looker_{[this](const std::stop_token& stop) { look(stop); }};
};

}  // namespace lantern::fuzz
