// What a system of bodies should keep: energy, momentum and angular momentum.
#pragma once

#include <span>

#include "physics/body.hpp"
#include "physics/forces.hpp"

namespace lantern::physics {

// In joules. Pushes have no potential, drag and damping eat energy.
struct Energy {
  double linear = 0;      // m v^2 / 2
  double rotational = 0;  // L w / 2
  double gravity = 0;     // -m g x, zero at the origin
  double springs = 0;     // k (length - rest)^2 / 2
  double attraction = 0;  // -gravitation m m / length; of centres that coincide 0
  double kinetic() const { return linear + rotational; }
  double potential() const { return gravity + springs + attraction; }
  double total() const { return kinetic() + potential(); }
};

// Of the dynamic bodies that have a mass; others are anchors that give and take any amount. The
// bodies may lie in any order. Throws Refused for a spring on a body that is not there.
template <int D>
Energy energy(std::span<const Body<D>> bodies, const Forces<D>& forces);

// Of one body: its motion, its height, and the springs that it is tied by; of a spring between two
// dynamic bodies each has half. So the shares of all dynamic bodies add up to the energy of all.
// Zero for a body that is not dynamic.
template <int D>
Energy energy_of(const Body<D>& body, std::span<const Body<D>> bodies, const Forces<D>& forces);

// Of the same bodies: the sum of m v, in N s.
template <int D>
Vec<D> momentum(std::span<const Body<D>> bodies);

// Of the same bodies about the world's origin: the sum of x cross m v, and of L.
template <int D>
Spin<D> angular_momentum(std::span<const Body<D>> bodies);

}  // namespace lantern::physics
