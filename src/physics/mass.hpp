// Mass and inertia of shapes of even density.
#pragma once

#include "geometry/shape.hpp"

namespace lantern::physics {

template <int D>
struct MassProperties {
  double mass = 0;
  Spin<D> inertia{0.0};  // about the centre; in 3D about each of the body's own axes

  bool operator==(const MassProperties&) const = default;
};

// `density` is mass a unit of area (2D) or volume (3D), finite and not negative. A half-space has
// no end and so no finite mass; it gives mass 0 and inertia 0, which here means: nothing moves it.
template <int D>
MassProperties<D> mass_of(const Shape<D>& shape, double density);

// The same shape at a given mass, finite and not negative. `properties` are of the shape at any
// density above 0. A shape without area (2D) or volume (3D) has inertia 0 at every mass: contacts
// never turn it.
template <int D>
MassProperties<D> scaled_to(MassProperties<D> properties, double mass);

}  // namespace lantern::physics
