// Code that may crash, hang or take all memory is tried in a copy of this process: the copy ends
// for it, and this process is told how.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/function_ref.hpp"

namespace lantern {

struct AttemptLimits {
  double seconds = 2;             // processor time of one call; ten times as long by the clock
  std::uint64_t bytes = 1 << 28;  // beside what there is; none under the address sanitizer
  bool aloud = true;              // else what it writes is lost
  bool by_clock = false;          // alone: a timer of processor time makes that clock a coarse one
};

// What came of it.
struct Attempt {
  std::vector<std::string> told;  // by the copy, in order, as far as it came
  std::string end;                // "did not return in 2 s"; empty if it came to its end
  bool hung = false;              // that is why
  std::string call;               // "insert of {0}", "after visit": which it was, and
  std::uint32_t body = 0;         // of which body
};

// Runs `f` in a copy of this process, which calls `tell` with what it finds; no zero byte stands in
// that. What it writes to standard output goes to standard error. Throws Stopped when that is asked
// for, and IoError if no copy can be made.
using Tell = FunctionRef<void(std::string_view)>;
Attempt attempt(const AttemptLimits& limits, FunctionRef<void(Tell)> f);

namespace detail {
// Of such a copy; null elsewhere. A null name is the end of a call.
inline void (*attempt_watch)(const char* call, std::uint32_t body) = nullptr;
}  // namespace detail

// A call of code that is tried, while this lives. The name is a literal.
class AttemptedCall {
 public:
  AttemptedCall(const char* call, std::uint32_t body) {
    if (detail::attempt_watch != nullptr) detail::attempt_watch(call, body);
  }
  ~AttemptedCall() {
    if (detail::attempt_watch != nullptr) detail::attempt_watch(nullptr, 0);
  }
  AttemptedCall& operator=(AttemptedCall&&) = delete;  // nor any other copy or move
};

}  // namespace lantern
