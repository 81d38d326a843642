// How many pictures stand between two frames, as --tween and --fps ask for them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "draw/tween.hpp"
#include "scenario/frame.hpp"

namespace lantern::app {

class InBetweens {
 public:
  // More pictures than this, frames and in-betweens, are not made of one scenario.
  static constexpr std::uint64_t kMostPictures = 100'000;
  // A change lasts so long, seconds, when it is shown at the wanted number of pictures a second.
  static constexpr double kChange = 0.5;

  InBetweens() = default;
  // Both are asked for only of a film, which has a clock of its own (app/film_clock.hpp).
  InBetweens(std::optional<std::uint64_t> tween, std::optional<double> fps);

  bool wanted() const { return number_ > 0; }
  // What they were asked for with: "7", "30 fps"; empty if they were not.
  std::string setting() const;
  // Before a frame there are never more.
  std::uint64_t most() const { return number_; }

  // Between two frames that follow each other. World time that goes on in small steps is shown at
  // its own speed: the more pictures a second, the more fit between two moments.
  std::uint64_t between(const Frame& a, const Frame& b) const;
  // Does the world's time go on from the one to the other in a small step?
  static bool is_one_movement(const Frame& a, const Frame& b);
  // A change is eased; moments of one movement are passed steadily.
  static Motion motion(const Frame& a, const Frame& b);

  // Throws UsageError if so many frames, or two of a number that is not known, would be too many.
  void require_few(std::optional<std::uint64_t> frames) const;

 private:
  std::uint64_t number_ = 0;
  double fps_ = 0;  // pictures a second; 0: always the same number
};

}  // namespace lantern::app
