// What `test_shapes`, `separate` and `gjk` have told: shown in their own step, counted from then
// on.
#pragma once

#include <optional>

#include "frame/parts/asked.hpp"

namespace lantern::run {

class Engine;

class NarrowShown {
 public:
  // What a step before has shown is no longer drawn.
  void begin_step() { drawn_ = Drawn::nothing; }

  void show(ShapeTests tests);
  void show(FrameSeparation separation);
  void show(FrameSearch search);

  // Also the difference of the two that were searched last, or else of the first two bodies there.
  void add_to(Frame& frame, const Engine& engine) const;

 private:
  enum class Drawn { nothing, tests, separation, search };

  Drawn drawn_ = Drawn::nothing;
  std::optional<ShapeTests> tests_;
  std::optional<FrameSeparation> separation_;
  std::optional<FrameSearch> search_;
};

}  // namespace lantern::run
