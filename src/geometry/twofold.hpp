// A number in twice the digits of a double: the sum of a double and of what its rounding has lost.
//
// Sums and products of doubles are rounded, but what is lost is a double itself and can be found
// with a few more operations (Dekker, "A floating-point technique for extending the available
// precision", Numer. Math. 18, 1971; Knuth, "The Art of Computer Programming" 2, 4.2.2). The
// operations below are right to about 31 digits (Joldes, Muller and Popescu, "Tight and rigorous
// error bounds for basic building blocks of double-word arithmetic", ACM TOMS 44, 2017). They ask
// of the machine that each operation on doubles is rounded alone, to nearest, as everywhere in
// Lantern; then they give the same bits everywhere, as a `long double` does not.
//
// Between about 1e-140 and 1e150; beyond, what is lost is no longer a number.
#pragma once

#include <cmath>
#include <compare>

#include "rooms.hpp"

namespace lantern::geometry {

struct Twofold {
  double high, low;  // |low| <= half a unit in the last place of `high`

  Twofold() = default;
  constexpr Twofold(double x, double rest = 0) : high(x), low(rest) {}
  explicit constexpr operator double() const { return high + low; }

  // a + b, exactly; the second if |a| >= |b|.
  static constexpr Twofold sum(double a, double b) {
    const double s = a + b, part = s - a;
    return {s, (a - (s - part)) + (b - part)};
  }
  static constexpr Twofold quick_sum(double a, double b) {
    const double s = a + b;
    return {s, b - (s - a)};
  }
  // a b, exactly: each factor in two halves of 26 bits.
  static constexpr Twofold product(double a, double b) {
    constexpr double kHalves = 0x1p27 + 1;
    const double p = a * b;
    const double scaled_a = kHalves * a, scaled_b = kHalves * b;
    const double a1 = scaled_a - (scaled_a - a), b1 = scaled_b - (scaled_b - b);
    const double a2 = a - a1, b2 = b - b1;
    return {p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2};
  }

  friend constexpr Twofold operator-(const Twofold& a) { return {-a.high, -a.low}; }
  friend constexpr Twofold operator+(const Twofold& a, const Twofold& b) {
    const Twofold s = sum(a.high, b.high), t = sum(a.low, b.low);
    const Twofold v = quick_sum(s.high, s.low + t.high);
    return quick_sum(v.high, t.low + v.low);
  }
  friend constexpr Twofold operator-(const Twofold& a, const Twofold& b) { return a + -b; }
  friend constexpr Twofold operator*(const Twofold& a, const Twofold& b) {
    const Twofold p = product(a.high, b.high);
    return quick_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
  }
  friend constexpr Twofold operator/(const Twofold& a, const Twofold& b) {
    const double quotient = a.high / b.high;
    const Twofold rest = a - b * quotient;
    return quick_sum(quotient, rest.high / b.high);
  }
  constexpr Twofold& operator+=(const Twofold& b) { return *this = *this + b; }
  constexpr Twofold& operator-=(const Twofold& b) { return *this = *this - b; }
  constexpr Twofold& operator*=(const Twofold& b) { return *this = *this * b; }
  constexpr Twofold& operator/=(const Twofold& b) { return *this = *this / b; }

  friend bool operator==(const Twofold&, const Twofold&) = default;
  friend std::partial_ordering operator<=>(const Twofold&, const Twofold&) = default;
};

constexpr Twofold abs(const Twofold& x) { return x.high < 0 ? -x : x; }
inline Twofold scaled(const Twofold& x, int exponent) {  // x 2^exponent
  return {std::ldexp(x.high, exponent), std::ldexp(x.low, exponent)};
}
// Of a number >= 0.
inline Twofold sqrt(const Twofold& x) {
  const double root = std::sqrt(x.high);
  if (root == 0) return 0;
  const Twofold rest = x - Twofold::product(root, root);
  return Twofold::quick_sum(root, rest.high / (2 * root));
}

}  // namespace lantern::geometry
