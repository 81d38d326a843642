// How a body lies and moves, whatever engine it is in. In a flat world z is 0, and it turns about
// z.
#pragma once

#include "geometry/rotation.hpp"

namespace lantern::frame {

struct BodyState {
  bool there = false;  // it may not have entered yet, or have left
  Vec<3> position{0.0};
  Vec<3> velocity{0.0};  // units a second
  Rotation<3> orientation = {};
  double angle = 0;              // radians, of a flat world: whole turns are kept
  Vec<3> angular_velocity{0.0};  // radians a second, world's axes
  Vec<3> angular_momentum{0.0};  // about the body's centre, world's axes
};

}  // namespace lantern::frame
