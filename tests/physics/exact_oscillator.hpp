// The exact solution of x'' + 2 zeta omega x' + omega^2 x = 0, for any damping ratio.
#pragma once

#include <cmath>

namespace lantern::physics {

struct OscillatorState {
  long double x, v;
};

inline OscillatorState exact_oscillator(long double omega, long double zeta, OscillatorState start,
                                        long double t) {
  const auto [x, v] = start;
  if (zeta == 1) {
    const long double e = std::exp(-omega * t), slope = v + omega * x;
    return {e * (x + slope * t), e * (slope - omega * (x + slope * t))};
  }
  if (zeta < 1) {
    const long double fall = zeta * omega, w = omega * std::sqrt(1 - zeta * zeta);
    const long double e = std::exp(-fall * t), c = std::cos(w * t), s = std::sin(w * t);
    const long double b = (v + fall * x) / w;
    return {e * (x * c + b * s), e * ((b * w - fall * x) * c - (x * w + fall * b) * s)};
  }
  // Two rates of decay; the slow one without the difference of two nearly equal numbers.
  const long double fast = -omega * (zeta + std::sqrt(zeta * zeta - 1));
  const long double slow = omega * omega / fast;
  const long double a = (v - slow * x) / (fast - slow), b = x - a;
  const long double ef = a * std::exp(fast * t), es = b * std::exp(slow * t);
  return {ef + es, fast * ef + slow * es};
}

}  // namespace lantern::physics
