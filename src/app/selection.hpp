// Which frames of a run are wanted, and at which size.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace lantern {

// One frame as the run without pixels found it.
struct PlannedFrame {
  std::uint32_t index = 0;
  std::uint32_t step = 0;
  std::string event;
  double time = 0;
  std::string caption;
  std::uint64_t hash = 0;
};

// "1280x720" as width and height. Throws UsageError unless both are 16 ... `most`.
std::pair<int, int> parse_size(const std::string& text, int most);

// Indices, ascending, of the frames that both words choose. `frames` is "7", "3-9", "3-", "-9" or
// empty; `at` is an event's name, a time in seconds, or empty. Throws UsageError that tells what
// there is when a word is malformed or chooses nothing.
std::vector<std::uint32_t> select_frames(const std::vector<PlannedFrame>& plan,
                                         const std::string& frames, const std::string& at);

}  // namespace lantern
