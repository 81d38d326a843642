// Piles of many bodies in contact: the scene in which engines spend their time, and what is looked
// at when it has come to rest.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frame/body_state.hpp"
#include "measure/invariants.hpp"

namespace lantern::measure {

// Unit boxes or balls (half size or radius 0.5, density 1, friction 0.5, no bounce) that fall from
// rest into a container: 100 wide in 2D, 12 x 12 in 3D, so that in both N bodies lie in a few
// layers at 500 and in some tens at 5,000. They start in rows 1.22 apart, every other row shifted
// by half of that, boxes tilted by at most 0.15 radians: seeded, the same everywhere.
struct Pile {
  int dimension = 2;
  bool balls = false;
  std::size_t bodies = 500;

  std::string name() const;  // "boxes2d:500"
};

// Of such a name, with 1 ... 100,000 bodies; nothing for any other.
std::optional<Pile> pile_named(std::string_view name);

// Nothing sleeps. Its first bodies are the container's, the `pile.bodies` last those that fall.
// Gravity is 10 along -y, the floor lies at y = 0.
Scenario pile_scene(const Pile& pile, double step, StructureKind structure);

// A pile at some moment, worked out from poses and velocities alone.
struct PileState {
  double deepest = 0;        // overlap of any two bodies, skins and all, units
  double mean = 0;           // of the pairs that touch, each by its deepest point
  std::size_t touching = 0;  // pairs that touch, or nearly do
  double energy = 0;         // J, zero for bodies at rest on the floor's level
  std::size_t outside = 0;   // bodies whose centre has left the container
};

// Lantern's own narrow phase looks at whatever engine has moved the bodies.
class PileGauge {
 public:
  // `scenario` is a pile_scene of `pile` and must outlive this.
  PileGauge(const Pile& pile, const Scenario& scenario);

  // `skins`: how far the engine keeps others off each body's surface (Simulation::skin), units. All
  // states finite.
  PileState of(const std::vector<BodyState>& states, const std::vector<double>& skins) const;

 private:
  bool falls(std::size_t body) const;

  double half_;
  const Scenario& scenario_;
  Invariants invariants_;
  double at_rest_ = 0;  // J, if all lay on the floor
};

}  // namespace lantern::measure
