#include <cmath>

#include <glm/geometric.hpp>

#include "base/error.hpp"
#include "measure/closed_forms.hpp"
#include "measure/precise.hpp"

namespace lantern {
namespace {

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
