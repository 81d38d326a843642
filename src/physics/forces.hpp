// Smooth forces: all that pushes bodies without their touching.
#pragma once

#include <vector>

#include "physics/body.hpp"

namespace lantern {

// A damped spring between points of two bodies, given in the bodies' own axes from their centres:
// force = -stiffness * (length - rest) - damping * (rate of length).
template <int D>
struct Spring {
  BodyId a = 0;
  BodyId b = 0;
  Vec<D> at_a{0.0};
  Vec<D> at_b{0.0};
  double rest_length = 0;
  double stiffness = 0;  // N a unit
  double damping = 0;    // N s a unit
};

// A force that a script applies for a while.
template <int D>
struct Push {
  BodyId body = 0;
  Vec<D> at{0.0};  // in the world's axes from the centre
  Vec<D> force{0.0};
};

template <int D>
struct Forces {
  Vec<D> gravity{0.0};  // acceleration
  std::vector<Spring<D>> springs;
  std::vector<Push<D>> pushes;
};

}  // namespace lantern
