// Smooth forces: all that pushes bodies without their touching; and what they keep.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/scratch.hpp"
#include "physics/body.hpp"

namespace lantern::physics {

using SpringId = std::uint32_t;

// A damped spring between points of two bodies, given in the bodies' own axes from their centres:
// force = -stiffness * (length - rest) - damping * (rate of length), along the line between the
// points. A spring of no length has no direction and pulls nothing. A body that cannot be moved
// (static, kinematic, asleep) is an anchor.
template <int D>
struct Spring {
  BodyId a = 0;
  BodyId b = 0;
  Vec<D> at_a{0.0};
  Vec<D> at_b{0.0};
  double rest_length = 0;
  double stiffness = 0;  // N a unit
  double damping = 0;    // N s a unit
  SpringId id = 0;       // given by the world
};

// A force that a script applies for a while.
template <int D>
struct Push {
  BodyId body = 0;
  Vec<D> at{0.0};  // in the world's axes from the centre
  Vec<D> force{0.0};
  std::optional<double> until{};  // this time of the world; none: until it is cleared
};

// Newton's law, too: every two bodies of which one is dynamic attract each other with gravitation
// times both masses over the square of their distance, along the line between their centres. A
// static or kinematic body attracts if a mass was given to it. Two whose centres coincide have no
// direction and do not pull.
template <int D>
struct Forces {
  Vec<D> gravity{0.0};     // acceleration
  double gravitation = 0;  // of 0, bodies do not attract each other
  Scratch<Spring<D>> springs;
  Scratch<Push<D>> pushes;
};

// A spring, or two bodies that attract each other, at one moment.
//
//        a's centre --arm_a--> o/\/\/\/\o <--arm_b-- b's centre
//                                direction ->
template <int D>
struct Stretch {
  Vec<D> arm_a{0.0};  // from the centre, in the world's axes
  Vec<D> arm_b{0.0};
  Vec<D> direction{0.0};  // from a's point to b's, of unit length; zero if they coincide
  double length = 0;
  double rate = 0;       // of the length, units a second
  double tension = 0;    // N; a is pulled along the direction, b against it
  double stiffness = 0;  // by how much the tension grows with the length; below 0 of attraction
  double damping = 0;    // and with the rate
};

// How a body lies and moves, as far as a spring's end is concerned.
template <int D>
struct EndMotion {
  Rotation<D> orientation;
  Vec<D> velocity{0.0};
  Spin<D> angular_velocity{0.0};
};

// `between` leads from the centre of a to the centre of b.
template <int D>
Stretch<D> stretched(const Spring<D>& spring, const Vec<D>& between, const EndMotion<D>& a,
                     const EndMotion<D>& b);

// The mass by which a body attracts others; 0 if it does not.
template <int D>
double attracting_mass(const Body<D>& body) {
  return body.inverse_mass > 0 ? 1 / body.inverse_mass : body.mass;
}

// Bodies that attract each other by `strength`, gravitation times both masses; `between` leads from
// a to b.
template <int D>
Stretch<D> attracted(double strength, const Vec<D>& between) {
  Stretch<D> s;
  s.length = glm::length(between);
  if (!(s.length > 0)) return s;
  s.direction = between / s.length;
  s.tension = strength / s.length / s.length;
  s.stiffness = -2 * s.tension / s.length;
  return s;
}

// Where the body that a force names lies in a span of bodies, by its id.
template <int D>
class BodyLookup {
 public:
  explicit BodyLookup(std::span<const Body<D>> bodies) {
    places_.reserve(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) places_.emplace_back(bodies[i].id, i);
    std::ranges::sort(places_);
  }

  // Throws Refused, naming `who` looks, if there is no such body.
  std::size_t index_of(BodyId id, std::string_view who) const {
    const auto place = std::ranges::lower_bound(places_, std::pair{id, std::size_t{0}});
    if (place == places_.end() || place->first != id)
      throw Refused(fmt::format("{}: there is no body {}", who, id));
    return place->second;
  }

 private:
  Scratch<std::pair<BodyId, std::size_t>> places_;  // by id
};

// What a system of bodies should keep: energy, in joules; momentum and angular momentum. Pushes
// have no potential, drag and damping eat energy.
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
