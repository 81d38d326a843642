// For how long two convex bodies that fly and turn are sure not to touch.
#pragma once

#include "physics/body.hpp"

namespace lantern::physics {

// A body at a moment of its free flight.
template <int D>
struct Flying {
  Shape<D> shape{};
  Vec<D> position{0.0};
  Mat<D> axes{1.0};  // of its core, as columns
  Vec<D> velocity{0.0};
  Spin<D> spin{0.0};   // radians a second
  double pull = 0;     // its centre is accelerated by so much, never more
  double fastest = 0;  // it never spins faster
  double swerve = 0;   // acceleration of a point that is 1 from the centre, by turning alone
};

// The most that a free body's spin becomes as it wanders: exact, since the energy and |L| are kept.
template <int D>
double fastest_spin(const Body<D>& body);

// Seconds, at most `within`, in which the two are sure not to touch. `normal` points from a to b
// and nearly parts them; the better it does, the longer. What is no deeper than `depth` along it
// counts as apart: touching bodies may part.
//
// They are apart as long as all corners are on their sides of a plane. Planes that stay as they
// are, and such as turn with a or with b, are tried: the last is best for a corner near a face.
// Along each corners fly on parabolas at worst.
template <int D>
double sure_advance(const Flying<D>& a, const Flying<D>& b, const Vec<D>& normal, double depth,
                    double within);

}  // namespace lantern::physics
