// Two bodies that attract each other by Newton's law: the ellipse of one about the other.
#pragma once

#include <glm/vec3.hpp>

namespace lantern {

struct Orbit {
  glm::vec<3, long double> position{0.0L};  // of one from the other
  glm::vec<3, long double> velocity{0.0L};
};

// `time` seconds after `start`, where `mu` > 0 is the constant of gravitation times both masses'
// sum. Throws Refused if the two are not bound to each other, or fall straight into each other.
Orbit exact_orbit(long double mu, const Orbit& start, long double time);

// Half the greater axis of the ellipse; below 0 if they are not bound.
long double half_axis(long double mu, const Orbit& start);

// 0 for a circle, below 1 for what is bound.
long double eccentricity(long double mu, const Orbit& start);

}  // namespace lantern
