// A long run of soft contacts is told of the setting that would be quicker, and what it costs: both
// are tried out from where the run is, in worlds of their own, of which nothing comes back to it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "base/clock.hpp"
#include "base/work.hpp"
#include "run/players.hpp"

namespace lantern::app {

struct Tried {
  double seconds = 0;  // of processor time
  double deepest = 0;  // that two bodies lie in each other in the end
  WorldWork work = {};
};
// A few steps as the world is, and with the `wanted_error` of 0.01.
struct SettingTrial {
  int steps = 0;
  Tried as_is, quick;
  std::string text() const;  // empty unless that took less than two thirds
};

// Steps of `h` seconds; no more once both took `most_seconds`. Throws what World::step throws.
template <int D>
SettingTrial try_out(const World<D>& world, double h, double most_seconds);

// Does that as soon as so many seconds of a run are `left` (Progress::long_left) that it is a small
// part of them, if contacts are soft and no error is wanted. Says once what is quicker; while there
// is nothing to say, as in a heap that still falls, it tries again, once in 40 times as many steps.
class Trials : public WorldWatch {
 public:
  Trials(std::function<double()> left, Work& work) : left_(std::move(left)), work_(work) {}
  void see_world(const Players<2>& players) override { see(players); }
  void see_world(const Players<3>& players) override { see(players); }

 private:
  template <int D>
  void see(const Players<D>& players);

  std::function<double()> left_;
  Work& work_;
  Stopwatch since_last_;          // step of the run
  std::uint64_t next_trial_ = 0;  // after so many steps of the world
  bool done_ = false;
};

}  // namespace lantern::app
