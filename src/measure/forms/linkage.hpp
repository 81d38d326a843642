// Flat bodies on pins and rods under gravity: the constrained equations of motion, by the adaptive
// method of Dormand and Prince in long double. Nothing of the engine is used.
#pragma once

#include <optional>

#include <glm/vec2.hpp>

#include "measure/forms/dormand_prince.hpp"

namespace lantern::measure {

using FlatLong = glm::vec<2, long double>;

class Linkage {
 public:
  struct Body {
    long double mass = 1;     // above 0
    long double inertia = 1;  // about the centre, above 0
    FlatLong position{0.0L}, velocity{0.0L};
    long double angle = 0, spin = 0;  // radians, radians a second
  };
  // Between a body and another one, or a fixed point.
  struct Joint {
    std::size_t a = 0;
    std::optional<std::size_t> b;       // none: `at_b` is a point of the world
    FlatLong at_a{0.0L}, at_b{0.0L};    // in the bodies' axes from their centres
    std::optional<long double> length;  // of a rod, above 0; none: a pin
  };

  // Joints must be met at first, in place and in velocity, and not depend on each other.
  Linkage(std::vector<Body> bodies, std::vector<Joint> joints, const FlatLong& gravity);

  // `time` >= that of the call before. Throws Refused if joints come to depend on each other.
  const std::vector<Body>& at(long double time);
  // The largest change of the energy since the start, in parts of the largest kinetic energy: how
  // true the integration is.
  long double energy_error() const { return worst_ / most_kinetic_; }

 private:
  using State = DormandPrince<long double>::State;
  struct Rows;

  void unpack(const State& y);
  void slope(const State& y, State& dy);
  void add_rows(const Joint& joint, Rows& rows) const;
  std::vector<long double> scale() const;
  void look_at_energy();

  std::vector<Body> bodies_;
  std::vector<Joint> joints_;
  FlatLong gravity_;
  State y_;
  DormandPrince<long double> method_;
  long double time_ = 0;
  long double start_ = 0, worst_ = 0, most_kinetic_ = 0;  // joules
};

}  // namespace lantern::measure
