// Wall time and processor time, for progress reports and benchmarks only; no frame may depend on
// them.
#pragma once

#include <chrono>
#include <ctime>

namespace lantern {

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Of all threads of the process, or of the calling one alone: what else the machine does is no part
// of it.
class CpuStopwatch {
 public:
  explicit CpuStopwatch(clockid_t clock = CLOCK_PROCESS_CPUTIME_ID) : clock_(clock) {}
  double seconds() const { return now() - start_; }

 private:
  double now() const {
    timespec time{};
    ::clock_gettime(clock_, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  clockid_t clock_;
  double start_ = now();
};

}  // namespace lantern
