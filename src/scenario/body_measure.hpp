// What is measured of a single body, as "energy.bob": the measure, a dot, and the body's name.
#pragma once

#include "scenario/frame.hpp"
#include "scenario/players.hpp"

namespace lantern {

// Those that the scenario asks for, of bodies that are there. Contacts must be in the frame.
template <int D>
void measure_bodies(const Players<D>& players, const Scenario& scenario, Frame& frame);

extern template void measure_bodies(const Players<2>&, const Scenario&, Frame&);
extern template void measure_bodies(const Players<3>&, const Scenario&, Frame&);

}  // namespace lantern
