// Impacts: bodies that bounce or are fast meet at the very moment, not at the end of a step.
#pragma once

#include "physics/contact_solver.hpp"

namespace lantern {

// Moves the island by a step of `h` seconds, from impact to impact and on to the end; in between by
// the solver. At most `budget` impacts are located; it shrinks by those that were.
template <int D>
void move_through_impacts(Island<D>& island, const ContactSolver<D>& solver,
                          const WorldConfig<D>& config, double h, int& budget, WorldWork& work);

}  // namespace lantern
