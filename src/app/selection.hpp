// Which frames of a run are wanted, and at which size.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "scenario/frame.hpp"

namespace lantern::app {

// "1280x720" as width and height. Throws UsageError unless both are 16 ... `most`.
std::pair<int, int> parse_size(const std::string& text, int most);

// The frames that two words of the command line choose, asked frame by frame while they are made.
class Selection {
 public:
  // `frames` is "7", "3-9", "3-", "-9" or empty; `at` is an event's name, a time in seconds, or
  // empty. `most_frames` is how many the scenario can have, if that is known. Throws UsageError for
  // a malformed word, or a range that cannot be.
  Selection(const std::string& frames, const std::string& at,
            std::optional<std::uint64_t> most_frames);

  bool takes_all() const { return frames_.empty() && at_.empty(); }

  // How many frames it can take, if a range says so.
  std::optional<std::uint64_t> most() const {
    return last_ ? std::optional(*last_ - first_ + 1) : std::nullopt;
  }

  // Asked once for each frame, in order.
  bool takes(const Frame& frame);

  // After the last frame: throws UsageError that tells what there is when the range goes beyond it,
  // or nothing was chosen.
  void require_some() const;

 private:
  [[noreturn]] void refuse_range(std::uint64_t count) const;

  std::string frames_, at_;
  std::uint64_t first_ = 0;
  std::optional<std::uint64_t> last_;  // none: to the end
  std::optional<double> time_;         // `at` is one
  std::uint64_t asked_ = 0, taken_ = 0;
  double end_ = 0;  // time of the last frame
  std::set<std::string> events_;
};

}  // namespace lantern::app
