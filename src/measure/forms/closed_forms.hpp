// Closed forms of motion.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace lantern::measure {

// Numbers of twice the length of a long double, for the phase of what swings very often: after a
// million periods a phase that was rounded once has lost seven digits.

constexpr long double kPi = std::numbers::pi_v<long double>;

// The sum of both, of which `low` is below the last digit of `high`.
struct Precise {
  long double high = 0;
  long double low = 0;
};

// Exact but for the last digits of `low` (Dekker, "A floating-point technique for extending the
// available precision", 1971). All arguments must be finite, divisors not zero.
inline Precise product(long double a, long double b) {
  const long double high = a * b;
  return {high, std::fma(a, b, -high)};
}
inline Precise product(Precise a, long double b) {
  const Precise p = product(a.high, b);
  return {p.high, p.low + a.low * b};
}
inline Precise quotient(long double a, long double b) {
  const long double high = a / b;
  return {high, std::fma(-high, b, a) / b};
}
inline Precise root(Precise a) {  // a > 0
  const long double high = std::sqrt(a.high);
  return {high, (std::fma(-high, high, a.high) + a.low) / (2 * high)};
}

struct CosSin {
  long double cos = 1;
  long double sin = 0;
};

// Of an angle in radians.
inline CosSin cos_sin(Precise angle) {
  const long double c = std::cos(angle.high), s = std::sin(angle.high);
  return {c - s * angle.low, s + c * angle.low};
}

using LongQuat = glm::qua<long double>;
using LongVec = glm::vec<3, long double>;

// A body that is thrown, with or without drag: x'' = g - rate x'.
struct FlightState {
  long double position = 0;
  long double velocity = 0;
};

// On one axis, `time` >= 0 seconds after the start. `acceleration` is that of gravity, `rate` >= 0
// is drag over mass, in 1/s. Without cancellation for any of them: with rate * time near 0 it is
// the parabola, with a large one the fall at its last speed, acceleration / rate.
FlightState exact_flight(FlightState start, long double acceleration, long double rate,
                         long double time);

// A damped oscillator: m x'' + c x' + k x = 0.
struct Swing {
  long double x = 0;
  long double v = 0;
};

// `time` >= 0 seconds after `start`, for any stiffness > 0, damping >= 0 and mass > 0: below, at
// and above critical damping, and without cancellation near it. The phase is kept to twice the
// length of a long double, so that a million periods lose nothing.
Swing exact_swing(long double stiffness, long double damping, long double mass, Swing start,
                  long double time);

// A point mass on a rod, under gravity: angle'' = -(g / length) sin(angle).
struct PendulumState {
  long double angle = 0;  // radians from straight down, within half a turn
  long double speed = 0;  // radians a second
};

// `time` seconds after `start`; `omega` > 0 is sqrt(g / length). Throws Refused if it goes over the
// top, or stands there.
PendulumState exact_pendulum(long double omega, PendulumState start, long double time);

// Two bodies that attract each other by Newton's law: the ellipse of one about the other.
struct Orbit {
  LongVec position{0.0L}, velocity{0.0L};  // of one from the other
};

// `time` seconds after `start`, where `mu` > 0 is the constant of gravitation times both masses'
// sum. Throws Refused if the two are not bound to each other, or fall straight into each other.
Orbit exact_orbit(long double mu, const Orbit& start, long double time);

// Half the greater axis of the ellipse; below 0 if they are not bound.
long double half_axis(long double mu, const Orbit& start);

// Masses in a row, each tied to the next by a spring: small or large motion along the row, since
// the springs are linear.
//
// Both ends are fixed, or only the first: with N masses there are N + 1 or N springs. Masses and
// stiffnesses above 0. Displacements and velocities are from rest, at time 0.
class ChainMotion {
 public:
  ChainMotion(const std::vector<long double>& masses, const std::vector<long double>& stiffnesses,
              const std::vector<long double>& displacements,
              const std::vector<long double>& velocities);

  void at(long double time, std::vector<long double>& displacements,
          std::vector<long double>& velocities) const;

  const std::vector<long double>& frequencies() const { return omega_; }  // radians a second

 private:
  void find_uniform_modes(std::size_t n, long double mass, long double stiffness);
  void find_modes(const std::vector<long double>& masses,
                  const std::vector<long double>& stiffnesses);

  std::vector<long double> omega_;
  std::vector<std::vector<long double>> modes_;  // [mode][mass], of unit length
  std::vector<long double> root_mass_;
  std::vector<long double> cosines_, sines_;  // what of each mode there is at the start
};

// A body that turns freely, whatever its three moments of inertia.
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

}  // namespace lantern::measure
