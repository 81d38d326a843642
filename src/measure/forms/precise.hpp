// Numbers of twice the length of a long double, for the phase of what swings very often: after a
// million periods a phase that was rounded once has lost seven digits.
#pragma once

#include <cmath>
#include <numbers>

namespace lantern::measure {

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

}  // namespace lantern::measure
