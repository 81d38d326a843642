#include "measure/closed_forms.hpp"

#include <cmath>

#include <glm/geometric.hpp>

#include "base/error.hpp"
#include "measure/elliptic.hpp"
#include "measure/precise.hpp"

namespace lantern {
namespace {

// (1 - e^-z) / z, which is 1 at 0.
long double mean_decay(long double z) { return z == 0 ? 1 : -std::expm1(-z) / z; }

// (z - 1 + e^-z) / z^2, which is 1/2 at 0. Below 1 its series, where the formula cancels.
long double mean_lag(long double z) {
  if (z >= 1) return (z + std::expm1(-z)) / (z * z);
  long double sum = 0, term = 0.5L;
  for (int n = 3; n < 40; ++n) {
    sum += term;
    term *= -z / n;
  }
  return sum;
}

// With fall = c / 2m and omega^2 = k/m:
//
//     x = A x0 + S v0,   v = B v0 - omega^2 S x0,      S = e^(-fall t) sin(w t) / w
//     A = e^(-fall t) cos(w t) + fall S,   B = e^(-fall t) cos(w t) - fall S,   w^2 = omega^2 -
//     fall^2
//
// Above critical damping w = i u, and cos and sin become cosh and sinh: two rates of decay, fall -
// u and fall + u.
struct FundamentalPair {
  long double a = 1;
  long double b = 1;
  long double s = 0;
};

FundamentalPair below_critical(long double fall, Precise w, long double t) {
  const auto [cos, sin] = cos_sin(product(w, t));
  const long double e = std::exp(-fall * t), s = e * sin / w.high;
  return {e * cos + fall * s, e * cos - fall * s, s};
}

FundamentalPair at_critical(long double fall, long double t) {
  const long double e = std::exp(-fall * t);
  return {e * (1 + fall * t), e * (1 - fall * t), e * t};
}

// The slow rate without a difference of nearly equal numbers.
FundamentalPair above_critical(long double fall, long double omega_squared, long double u,
                               long double t) {
  const long double fast = fall + u, slow = omega_squared / fast;
  const long double es = std::exp(-slow * t), ef = std::exp(-fast * t);
  const long double s = -es * std::expm1(-2 * u * t) / (2 * u);
  // (fast es - slow ef) / 2u, where both differ little near critical damping.
  return {es + slow * s, ef - slow * s, s};
}

// Kepler's equation from any point of the orbit on (Battin, "An introduction to the mathematics and
// methods of astrodynamics", 1999, section 4.3): by how much the eccentric anomaly has grown,
//
//     E + s (1 - cos E) - (1 - r0/a) sin E = mean,     s = r0 . v0 / sqrt(mu a)
//
// The left side grows with E, at r/a. So Newton's method within a bracket always gets there. For a
// mean anomaly within half a turn.
long double anomaly(long double s, long double near, long double mean) {
  const auto miss = [&](long double e) {
    const long double half = std::sin(e / 2);
    return e - mean + 2 * s * half * half - near * std::sin(e);
  };
  long double low = mean - 4, high = mean + 4, e = mean;
  for (int i = 0; i < 200; ++i) {
    const long double value = miss(e);
    if (value == 0) return e;
    (value > 0 ? high : low) = e;
    const long double slope = 1 + s * std::sin(e) - near * std::cos(e);
    long double next = e - value / slope;
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (next == e || std::abs(next - e) < 0x1p-66L) return next;
    e = next;
  }
  return e;
}

}  // namespace

// With z = rate t:  v = v0 e^-z + g t (1 - e^-z)/z,  x = x0 + v0 t (1 - e^-z)/z
//                                                        + g t^2 (z - 1 + e^-z)/z^2.
FlightState exact_flight(FlightState start, long double acceleration, long double rate,
                         long double time) {
  const long double z = rate * time, decay = mean_decay(z);
  return {start.position + time * (start.velocity * decay + acceleration * time * mean_lag(z)),
          start.velocity * std::exp(-z) + acceleration * time * decay};
}

Swing exact_swing(long double stiffness, long double damping, long double mass, Swing start,
                  long double time) {
  const long double fall = damping / (2 * mass), omega_squared = stiffness / mass;
  // 4 m k - c^2, rounded once: its sign tells the kind of damping.
  const Precise mk = product(4 * mass, stiffness), cc = product(damping, damping);
  const long double excess = (mk.high - cc.high) + (mk.low - cc.low);
  const long double u = std::sqrt(std::abs(excess)) / (2 * mass);
  const FundamentalPair basis = damping == 0
                                    ? below_critical(0, root(quotient(stiffness, mass)), time)
                                : excess > 0 ? below_critical(fall, {u, 0}, time)
                                : excess < 0 ? above_critical(fall, omega_squared, u, time)
                                             : at_critical(fall, time);
  return {basis.a * start.x + basis.s * start.v,
          basis.b * start.v - omega_squared * basis.s * start.x};
}

// Whittaker, "A treatise on the analytical dynamics of particles and rigid bodies", section 44:
//
//     sin(angle/2) = k sn(u),  cos(angle/2) = dn(u),  speed = 2 k omega cn(u),  u = omega t + u0
PendulumState exact_pendulum(long double omega, PendulumState start, long double time) {
  const long double s = std::sin(start.angle / 2), c = std::cos(start.angle / 2);
  const long double w = start.speed / (2 * omega);
  const long double k = std::sqrt(s * s + w * w);
  const long double m1 = (c - w) * (c + w);  // 1 - k^2, where 1 - s^2 would have lost its digits
  if (!(m1 > 0)) throw Refused("the pendulum goes over the top");
  if (!(k > 0)) return start;
  const Jacobi at_start{s / k, w / k, c};
  const long double period = 4 * quarter_period(m1);
  const Precise way = product(omega, time);
  const long double turns = std::round(way.high / period);
  const long double reduced = std::fma(-turns, period, way.high) + way.low;
  const Jacobi f = jacobi(reduced + argument_of(at_start, m1), m1);
  return {2 * std::atan2(k * f.sn, f.dn), 2 * k * omega * f.cn};
}

long double half_axis(long double mu, const Orbit& start) {
  return 1 / (2 / glm::length(start.position) - glm::dot(start.velocity, start.velocity) / mu);
}

Orbit exact_orbit(long double mu, const Orbit& start, long double time) {
  const long double r0 = glm::length(start.position), a = half_axis(mu, start);
  const auto momentum = glm::cross(start.position, start.velocity);
  if (!(a > 0) || !std::isfinite(a)) throw Refused("the two bodies are not bound to each other");
  if (!(glm::dot(momentum, momentum) > 0)) throw Refused("the two bodies fall into each other");
  const long double s = glm::dot(start.position, start.velocity) / std::sqrt(mu * a);
  // Whole turns are taken off while the phase is still exact.
  const Precise phase = product(root(quotient(mu, a * a * a)), time);
  const long double turns = std::round(phase.high / (2 * kPi));
  const long double two_pi_low = -1.0033115225336664e-19L;  // 2 pi - its long double
  const long double mean = std::fma(-turns, 2 * kPi, phase.high) + (phase.low - turns * two_pi_low);
  const long double e = anomaly(s, 1 - r0 / a, mean);
  const long double half = std::sin(e / 2), sin = std::sin(e), versine = 2 * half * half;
  const long double r = a * (1 + s * sin - (1 - r0 / a) * (1 - versine));
  // Lagrange's coefficients.
  const long double f = 1 - a / r0 * versine;
  const long double g = std::sqrt(a / mu) * (a * s * versine + r0 * sin);
  const long double ft = -std::sqrt(mu * a) / (r * r0) * sin;
  const long double gt = 1 - a / r * versine;
  return {f * start.position + g * start.velocity, ft * start.position + gt * start.velocity};
}

}  // namespace lantern
