// Bodies, contacts, springs and joints of a world, as a frame shows them.
#pragma once

#include "scenario/players.hpp"

namespace lantern {

// Bodies that the world shows, contacts and links; no counts.
template <int D>
void picture_world(const Players<D>& players, Frame& frame);

// Energies, momenta and, of contacts, the deepest penetration.
template <int D>
void measure_world(const Players<D>& players, bool has_contacts, Frame& frame);

extern template void picture_world(const Players<2>&, Frame&);
extern template void picture_world(const Players<3>&, Frame&);
extern template void measure_world(const Players<2>&, bool, Frame&);
extern template void measure_world(const Players<3>&, bool, Frame&);

}  // namespace lantern
