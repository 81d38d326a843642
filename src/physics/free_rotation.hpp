// How a body turns when nothing holds it.
//
// A free body keeps its angular momentum L, yet its angular velocity wanders, because inertia is
// fixed to the body: a box thrown about its middle axis tumbles. In the body's axes, where L has
// the components L1, L2, L3, the energy is L1^2/2I1 + L2^2/2I2 + L3^2/2I3.
#pragma once

#include "physics/body.hpp"

namespace lantern::physics {

// The orientation `h` seconds later (h may be negative: back in time), of a body whose angular
// momentum in the world is L. Both dimensions: exact if the inertia about two axes is equal, as in
// 2D and for spheres and square boxes. Any other body is turned by the splitting `method`, or
// exactly, to rounding, where that would change the energy by more than a thousandth: at any spin
// and step the energy is kept within that. A static or sleeping body does not turn, a kinematic one
// turns by its spin. `method` must be one of the splittings.
template <int D>
Rotation<D> freely_turned(const Body<D>& body, const Spin<D>& angular_momentum, double h,
                          RotationMethod method = RotationMethod::splitting_2);

// The same with the body's own angular momentum.
template <int D>
Rotation<D> freely_turned(const Body<D>& body, double h) {
  return freely_turned(body, body.angular_momentum, h);
}

// Turns the body by any of the methods, as if its angular momentum were more by `lag` meanwhile
// (see integrator.hpp). Only `explicit_gyroscopic` changes it, which is wrong, and what it is there
// to show.
template <int D>
void turn_freely(Body<D>& body, double h, RotationMethod method, const Spin<D>& lag = Spin<D>(0.0));

}  // namespace lantern::physics
