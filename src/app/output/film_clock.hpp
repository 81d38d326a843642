// When the pictures of a film are seen: the speed of what moves, how long stands what is read.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "frame/frame.hpp"

namespace lantern::app {

// Moments are counted in pictures of the film's rate, from 0. World time that goes on in small
// steps is shown at its own speed, whatever lies between two frames; any other change takes
// InBetweens::kChange seconds. A still is a frame that nothing goes on from at once: the last of
// each step, and each that the next one differs from by more than a small step of time.
class FilmClock {
 public:
  // A still stands until its words have been on the screen as long as it takes to read them at this
  // speed, which is that of subtitles, and at least kLook.
  static constexpr double kLettersPerSecond = 15;
  static constexpr double kLook = 1;  // seconds

  struct Settings {
    double rate = 30;                           // pictures a second
    std::optional<double> hold = std::nullopt;  // seconds of each still, whatever its words
    // Different ones between two frames; none: all that the rate has room for; 0: cuts.
    std::optional<std::uint64_t> in_betweens = std::nullopt;
  };
  explicit FilmClock(const Settings& settings) : settings_(settings) {}

  // The first moment that is still free.
  std::uint64_t now() const { return now_; }

  // Is `a` a still, if `b` is chosen next? `goes_on`: it is the next one of the run, too.
  static bool is_still(const Frame& a, const Frame& b, bool goes_on);

  // The frame is shown from now on, as a still. When that ends is the new now().
  void hold(const Frame& still);

  // What is shown on the way from `a` to `b`, `b` itself left out; 0 is `a`. Then it is b's turn.
  struct Shot {
    double t = 0;  // of the way
    std::uint64_t moment = 0;
  };
  std::vector<Shot> way(const Frame& a, const Frame& b, bool goes_on);

 private:
  double seconds_of(const Frame& still);
  void move(const Frame& a, const Frame& b, std::vector<Shot>& shots);
  double quantized(double t) const;
  void see(const Frame& frame);

  Settings settings_;
  std::uint64_t now_ = 0;
  bool moving_ = false;            // a movement is under way:
  double from_time_ = 0;           // at this world time
  std::uint64_t from_moment_ = 0;  // it was this moment
  std::string words_;              // on the screen,
  std::uint64_t words_since_ = 0;  // from this moment on
};

}  // namespace lantern::app
