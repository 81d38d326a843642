// Whittaker, "A treatise on the analytical dynamics of particles and rigid bodies", section 44:
//
//     sin(angle/2) = k sn(u),  cos(angle/2) = dn(u),  speed = 2 k omega cn(u),  u = omega t + u0
#include <cmath>

#include "base/error.hpp"
#include "measure/closed_forms.hpp"
#include "measure/elliptic.hpp"
#include "measure/precise.hpp"

namespace lantern {

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

}  // namespace lantern
