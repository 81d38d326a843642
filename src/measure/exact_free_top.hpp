// A body that turns freely, whatever its three moments of inertia.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace lantern {

using LongQuat = glm::qua<long double>;
using LongVec = glm::vec<3, long double>;

class FreeTop {
 public:
  // At time 0: inverse moments of inertia > 0 about the body's own axes, the orientation (from the
  // body's axes to the world's, of unit length) and the angular momentum in the body's axes.
  // Throws Refused on the boundary between tumbling about one axis and about another, where the
  // body takes for ever to turn over.
  FreeTop(const LongVec& inverse_inertia, const LongQuat& orientation, const LongVec& momentum);

  LongQuat orientation(long double time) const;
  LongVec momentum(long double time) const;  // in the body's axes

 private:
  struct Phase {
    long double half_turns = 0;  // of L about axis 3, whole
    long double rest = 0;        // within a quarter period
  };
  Phase phase(long double time) const;
  LongVec named(long double time) const;  // L along axes 1, 2, 3
  LongQuat to_momentum_frame(const LongVec& l, long double precession) const;
  long double precession(long double time) const;
  long double integral(long double rest) const;

  bool fixed_ = false;  // L stands still in the body, and spin_ with it
  LongQuat start_;
  LongVec momentum_{0.0L};
  LongVec spin_{0.0L};  // angular velocity in the body's axes

  LongQuat names_;              // from the body's axes to those named 1, 2, 3
  LongQuat base_;               // from the frame of L to the world's
  long double inverse1_ = 1;    // a1
  long double length_ = 0;      // of L
  LongVec size_{0.0L};          // A1, A2, A3
  long double rate_ = 0;        // of u
  long double m1_ = 1, n_ = 0;  // complementary parameter, characteristic
  long double wobble_ = 0;      // (a1 - a3) n
  long double u0_ = 0;
  long double half_period_ = 1, half_integral_ = 0, integral0_ = 0;
};

}  // namespace lantern
