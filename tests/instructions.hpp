// How many instructions of the machine a function takes: the same, but for a few, however busy the
// machine is. Its own counter tells where a process may read it; elsewhere callgrind does, for a
// process that it runs with --callgrind-out-file=$LANTERN_CALLGRIND (tests/CMakeLists.txt).
#pragma once

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>

#include <unistd.h>

#if __has_include(<linux/perf_event.h>)
#include <linux/perf_event.h>
#include <sys/syscall.h>
#endif
#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#endif

namespace lantern {

class Instructions {
 public:
  Instructions() {
#ifdef PERF_COUNT_HW_INSTRUCTIONS
    perf_event_attr what = {};
    what.type = PERF_TYPE_HARDWARE;
    what.size = sizeof(what);
    what.config = PERF_COUNT_HW_INSTRUCTIONS;
    what.exclude_kernel = what.exclude_hv = 1;
    if (prefix_ == nullptr)
      counter_ = static_cast<int>(syscall(SYS_perf_event_open, &what, 0, -1, -1, 0));
#endif
  }
  ~Instructions() {
    if (counter_ >= 0) close(counter_);
  }
  Instructions(const Instructions&) = delete;
  Instructions& operator=(const Instructions&) = delete;

  bool are_counted() const { return counter_ >= 0 || prefix_ != nullptr; }

  template <class F>
  std::uint64_t of(F&& f) {
    if (prefix_ == nullptr) {
      const std::uint64_t before = now();
      f();
      return now() - before;
    }
#ifdef CALLGRIND_ZERO_STATS
    CALLGRIND_ZERO_STATS;
    f();
    CALLGRIND_DUMP_STATS;
#endif
    std::ifstream dump(prefix_ + ("." + std::to_string(++dumps())));
    for (std::string word; dump >> word;)
      if (word == "totals:" && dump >> word) return std::stoull(word);
    return 0;
  }

 private:
  std::uint64_t now() const {
    std::uint64_t count = 0;
    return read(counter_, &count, sizeof(count)) == sizeof(count) ? count : 0;
  }
  static int& dumps() {  // of this process
    static int number = 0;
    return number;
  }

  const char* prefix_ = std::getenv("LANTERN_CALLGRIND");
  int counter_ = -1;
};

}  // namespace lantern
