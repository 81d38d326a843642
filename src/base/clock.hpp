// Wall time and processor time, for progress reports and benchmarks only; no frame may depend on
// them.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <vector>

#include "base/check.hpp"
#include "base/stop.hpp"

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

// Seconds of what was timed, over repeats. Zero repeats: not timed.
struct Timing {
  static constexpr int kFewest = 6;  // repeats below which no interval covers a median by 95 %

  int repeats = 0;
  double median = 0;
  double least = 0;
  double lower_quartile = 0;
  double upper_quartile = 0;
  // Between which two repeats the median of all that could be taken lies with 95 %, whatever their
  // distribution (from the binomial one); from the least to the greatest of fewer than kFewest.
  double low = 0, high = 0;
  double spread() const { return upper_quartile - lower_quartile; }  // interquartile range
  bool is_narrow() const { return repeats >= kFewest && high - low <= 0.05 * median; }
  // Whether another measurement would find it quicker, too: the intervals are apart, and the
  // medians by more than what the places of code and data in memory make of one and the same run
  // (Mytkowicz et al., "Producing Wrong Data Without Doing Anything Obviously Wrong!", 2009).
  bool is_quicker_than(const Timing& other) const {
    return std::min(repeats, other.repeats) >= kFewest && high < other.low &&
           1.1 * median < other.median;
  }
  bool operator==(const Timing&) const = default;
};

// How a run is timed, after a warm-up. A repeat runs as often as it takes to fill `least_seconds`.
struct TimingRule {
  int repeats = 15;
  double least_seconds = 0.05;
  int most = 0;  // go on until the median's interval is narrow, or to so many repeats
};

// The value below which lies `share` (0 ... 1) of the values, between neighbours by their distance;
// of an empty list a broken invariant.
inline double quantile(std::vector<double> values, double share) {
  LANTERN_CHECK(values.empty(), ==, false);
  std::ranges::sort(values);
  const double at = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

// Of the seconds that each repeat took. No repeats: not timed.
inline Timing timing_of(const std::vector<double>& seconds) {
  if (seconds.empty()) return {};
  std::vector<double> sorted = seconds;
  std::ranges::sort(sorted);
  const std::size_t n = sorted.size();
  std::size_t outside = 0;  // repeats at either end: the median is there with 2.5 % at most
  double chance = std::ldexp(1.0, -static_cast<int>(n)), below = chance;
  while (below <= 0.025) {
    ++outside;
    chance *= static_cast<double>(n - outside + 1) / static_cast<double>(outside);
    below += chance;
  }
  outside = std::max<std::size_t>(outside, 1);
  return {static_cast<int>(n),    quantile(sorted, 0.5), sorted[0],          quantile(sorted, 0.25),
          quantile(sorted, 0.75), sorted[outside - 1],   sorted[n - outside]};
}

// Seconds of one call of `work`, which is called once before for warmth. Without repeats it is not
// called at all.
template <class F>
Timing timed(const TimingRule& rule, F&& work) {
  if (rule.repeats < 1) return {};
  work();
  const Stopwatch first;
  work();
  const double once = first.seconds();
  constexpr double kMostCalls = 1e6;
  const double wanted = once > 0 ? rule.least_seconds / once : kMostCalls;
  const auto calls = static_cast<std::uint64_t>(std::clamp(wanted + 1, 1.0, kMostCalls));
  std::vector<double> seconds;
  for (int i = 0; i < rule.repeats; ++i) {
    const Stopwatch watch;
    for (std::uint64_t call = 0; call < calls; ++call) {
      stop_if_asked();
      work();
    }
    seconds.push_back(watch.seconds() / static_cast<double>(calls));
  }
  return timing_of(seconds);
}

}  // namespace lantern
