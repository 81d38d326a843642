// Bodies, contacts, springs and joints of a world, as a frame shows them.
#pragma once

#include "frame/frame.hpp"
#include "run/players.hpp"

namespace lantern::run {

// How a body lies and moves now.
template <int D>
BodyState state_of(const Body<D>& body);

// Bodies that the world shows, and links; no counts.
template <int D>
void picture_world(const Players<D>& players, Frame& frame);

// What pushes and pulls the bodies now: a script's forces, and springs.
template <int D>
void picture_forces(const Players<D>& players, Frame& frame);

// Energies, momenta, of joints the widest gap.
template <int D>
void measure_world(const Players<D>& players, const Scenario& scenario, Frame& frame);

// Measures of single bodies that the scenario asks for, as "energy.bob", of bodies that are there.
// Contacts must be in the frame.
template <int D>
void measure_bodies(const Players<D>& players, const Scenario& scenario, Frame& frame);

extern template BodyState state_of(const Body<2>&);
extern template BodyState state_of(const Body<3>&);
extern template void picture_world(const Players<2>&, Frame&);
extern template void picture_world(const Players<3>&, Frame&);
extern template void picture_forces(const Players<2>&, Frame&);
extern template void picture_forces(const Players<3>&, Frame&);
extern template void measure_world(const Players<2>&, const Scenario&, Frame&);
extern template void measure_world(const Players<3>&, const Scenario&, Frame&);
extern template void measure_bodies(const Players<2>&, const Scenario&, Frame&);
extern template void measure_bodies(const Players<3>&, const Scenario&, Frame&);

}  // namespace lantern::run
