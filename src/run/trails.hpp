// The way of bodies from step to step, and how it was found where two of them meet.
#pragma once

#include <map>
#include <vector>

#include "frame/parts/motion.hpp"
#include "physics/world.hpp"

namespace lantern::run {

// Where moving bodies were at the ends of the last kMostTrail world steps, and at the impacts
// between.
template <int D>
class Trails {
 public:
  // Before a step and after it.
  void begin(const World<D>& world);
  void end(const World<D>& world);
  // The body was put somewhere else.
  void forget(BodyId id) { ways_.erase(id); }
  // Of as many steps as the frame shows; and where bodies fly in the next one, of `h` seconds.
  void picture(const World<D>& world, double h, Frame& frame) const;

 private:
  std::map<BodyId, std::vector<FrameStop>> ways_;  // the oldest first
};

// The looks by which the step, of `h` seconds, found its first impact, in order; none if there was
// none. Of many that lie as good as at the moment itself only the one that found it.
template <int D>
std::vector<FrameLook> looks_of(const ImpactLog<D>& log, double h);

}  // namespace lantern::run
