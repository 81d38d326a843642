// What makes a body one that the world can take.
#pragma once

#include "physics/body.hpp"

namespace lantern {

// Throws Refused, naming body and field; see World::add.
template <int D>
void check_body(const Body<D>& body);

// Mass, inverse mass and inertia from shape, density and mass, checked. Throws Refused for a
// dynamic body that has none.
template <int D>
void derive_mass(Body<D>& body);

}  // namespace lantern
