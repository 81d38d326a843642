// Where frames are looked at from, and what of the world they show, from step to step.
#pragma once

#include <optional>

#include "frame/frame.hpp"
#include "language/scenario.hpp"

namespace lantern::run {

class Looks {
 public:
  // The scenario must outlive this.
  explicit Looks(const Scenario& scenario);

  // What follows belongs to this step, which begins at that time of the world, in seconds.
  void begin(const Step& step, double time);

  // Fills the frame's display, view and camera; its time and bounds must be there.
  void show(Frame& frame) const;

 private:
  double angle_at(double time) const;
  void aim(Frame& frame) const;

  const Scenario& scenario_;
  const Step* step_ = nullptr;
  std::optional<Box<2>> view_;  // none: all
  std::optional<Camera> from_;  // before it goes round; none: as all is seen
  bool goes_round_ = false;     // somewhere in the script
  double angle_ = 0;            // radians that it went round before this step
  double began_ = 0;            // the step, seconds
  double seconds_ = 0;          // that the step may last
};

}  // namespace lantern::run
