#include <cmath>

#include "measure/closed_forms.hpp"
#include "measure/precise.hpp"

namespace lantern {
namespace {

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

}  // namespace

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

}  // namespace lantern
