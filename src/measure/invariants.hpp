// What a scene should keep, and how deep its bodies lie in each other, worked out from the states
// alone: by the same formulas for Lantern and for every peer.
#pragma once

#include "measure/row.hpp"

namespace lantern::measure {

// The scenario's bodies as they were at some moment.
struct Kept {
  double energy = 0;             // J
  double kinetic_energy = 0;     // J
  double spring_energy = 0;      // J
  Vec<3> momentum{0.0};          // N s
  Vec<3> angular_momentum{0.0};  // about the origin, N m s
  double flow = 0;               // sum of |m v|, N s: what a change of momentum is held against
  double swirl = 0;              // sum of |x cross m v| and |L|, the same for angular momentum
  double penetration = 0;        // the deepest of any two bodies, 0 if none overlap
  double penetrations = 0;       // of all pairs together, each by its deepest point
  std::size_t overlapping = 0;   // pairs
  std::size_t touching = 0;      // or no farther apart than Skins::nearly
};

// What counts as a body's surface.
struct Skins {
  std::span<const double> of = {};  // how far an engine keeps others off each body; empty: nothing
  double nearly = 0;                // bodies at most so far apart touch
};

class Invariants {
 public:
  // Throws Refused as the world does if the scenario's bodies cannot enter it.
  explicit Invariants(const Scenario& scenario);

  // All states must be finite. Bodies that are not there count nothing.
  Kept of(const std::vector<BodyState>& states, const Skins& skins = {}) const {
    return of_(states, skins);
  }

  // Whether the scene keeps it, by its own rules: no drag, no damping and elastic contacts without
  // friction for the energy; nothing that is tied to or meets the world for momentum.
  bool keeps_energy() const { return keeps_energy_; }
  bool keeps_momentum() const { return keeps_momentum_; }
  bool keeps_angular_momentum() const { return keeps_angular_momentum_; }

 private:
  bool keeps_energy_ = false;
  bool keeps_momentum_ = false;
  bool keeps_angular_momentum_ = false;
  std::function<Kept(const std::vector<BodyState>&, const Skins&)> of_;
};

// Follows a run and remembers the largest changes and the deepest penetration.
class DriftMeter {
 public:
  explicit DriftMeter(const Invariants& invariants) : invariants_(invariants) {}
  void look(const std::vector<BodyState>& states);
  Drift drift() const;
  // What the drift of the energy is told over, J: the kinetic and elastic energy of the start or,
  // of what begins at rest, the most that its potential energy has fallen so far: what blows up is
  // not paid for by that.
  double energy_scale() const;
  double energy_change() const { return energy_; }  // the largest so far, J
  double penetration() const { return penetration_; }

 private:
  const Invariants& invariants_;
  bool begun_ = false;
  Kept start_;
  double energy_ = 0, momentum_ = 0, angular_momentum_ = 0;  // largest changes
  double most_fallen_ = 0;                                   // of all energy but the kinetic, J
  double penetration_ = 0;
};

}  // namespace lantern::measure
