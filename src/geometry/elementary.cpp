#include "geometry/elementary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace lantern::geometry {
namespace {

constexpr Twofold kHalfPi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr Twofold kLog2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};
constexpr Twofold kLog10{0x1.26bb1bbb55516p+1, -0x1.f48ad494ea3e9p-53};

// x = quadrant pi/2 + rest, with |rest| <= pi/4 but for rounding; the quadrant modulo 4.
template <class Number>
struct Reduced {
  Number rest;
  unsigned quadrant;
};

// The bits of 2/pi after the point, 32 at a time; enough for the largest double.
constexpr auto kTwoOverPi = std::to_array<std::uint32_t>(
    {0xA2F9836E, 0x4E441529, 0xFC2757D1, 0xF534DDC0, 0xDB629599, 0x3C439041, 0xFE5163AB,
     0xDEBBC561, 0xB7246E3A, 0x424DD2E0, 0x06492EEA, 0x09D1921C, 0xFE1DEB1C, 0xB129A73E,
     0xE88235F5, 0x2EBB4484, 0xE99C7026, 0xB45F7E41, 0x3991D639, 0x835339F4, 0x9C845F8B,
     0xBDF9283B, 0x1FF897FF, 0xDE05980F, 0xEF2F118B, 0x5A0A6D1F, 0x6D367ECF, 0x27CB09B7,
     0x4F463F66, 0x9E5FEA2D, 0x7527BAC7, 0xEBE5F17B, 0x3D0739F7, 0x8A5292EA, 0x6BFB5FB1,
     0x1F8D5D08, 0x56033046, 0xFC7B6BAB, 0xF0CFBC20, 0x9AF4361D});

// Of a finite number, whatever its size (Payne and Hanek, "Radian reduction for trigonometric
// functions", SIGNUM 18, 1983). Bits of 2/pi that only add whole turns are left out, and so are
// those that are too small: of eight words, at least 170 bits after the point are right.
Reduced<Twofold> reduced(double x) {
  int exponent = 0;
  const auto mantissa =
      static_cast<std::uint64_t>(std::ldexp(std::frexp(std::abs(x), &exponent), 53));
  exponent -= 53;                                  // |x| = mantissa 2^exponent
  const int first = (exponent - 2 + 64) / 32 - 2;  // rounded down, for |x| >= 2^-9
  const int shift = exponent - 32 * first;         // 2 to 33
  constexpr std::size_t kWords = 8;
  // mantissa 2^shift in three words, times the eight, from the lowest.
  const std::array<std::uint64_t, 3> factor{(mantissa << (shift % 32)) & 0xffffffff,
                                            (mantissa >> (32 - shift % 32)) & 0xffffffff,
                                            shift % 32 == 0 ? 0 : mantissa >> (64 - shift % 32)};
  const std::size_t words_up = static_cast<std::size_t>(shift / 32);
  std::array<std::uint64_t, kWords + 5> product{};
  for (std::size_t k = 0; k < kWords; ++k) {
    const int place = first + static_cast<int>(kWords - 1 - k);
    const std::uint64_t word = place < 0 ? 0 : kTwoOverPi[static_cast<std::size_t>(place)];
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < factor.size(); ++i) {
      std::uint64_t& sum = product[k + i + words_up];
      sum += word * factor[i] + carry;
      carry = sum >> 32;
      sum &= 0xffffffff;
    }
    product[k + factor.size() + words_up] += carry;
  }
  // The point is below word 8. The rest is what is above the nearest whole number.
  unsigned quadrant = static_cast<unsigned>(product[kWords] & 3);
  Twofold rest = 0;
  for (std::size_t k = 0; k < kWords; ++k)
    rest += std::ldexp(static_cast<double>(product[k]), 32 * (static_cast<int>(k) - 8));
  if (rest.high >= 0.5) {
    // Not 1 - rest, which may have lost what is left of it: the words from the other side.
    rest = -0x1p-256;
    for (std::size_t k = 0; k < kWords; ++k)
      rest -=
          std::ldexp(static_cast<double>(0xffffffff - product[k]), 32 * (static_cast<int>(k) - 8));
    ++quadrant;
  }
  rest *= kHalfPi;
  return x < 0 ? Reduced<Twofold>{-rest, (4 - quadrant % 4) % 4}
               : Reduced<Twofold>{rest, quadrant % 4};
}

// The two of an angle from those of its rest.
template <class Pair>
Pair in_quadrant(const Pair& of_rest, unsigned quadrant) {
  const auto& [s, c] = of_rest;
  switch (quadrant) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

constexpr auto kInverseFactorials = [] {
  std::array<Twofold, 30> inverse{};
  inverse[0] = 1;
  for (std::size_t n = 1; n < inverse.size(); ++n)
    inverse[n] = inverse[n - 1] / static_cast<double>(n);
  return inverse;
}();

// Taylor's series of |x| <= pi/4.
TwofoldSinCos series(const Twofold& x) {
  const Twofold square = x * x;
  TwofoldSinCos sum{0, 0};
  for (std::size_t n = 28;; n -= 2) {
    sum.sin = kInverseFactorials[n + 1] - square * sum.sin;
    sum.cos = kInverseFactorials[n] - square * sum.cos;
    if (n == 0) break;
  }
  sum.sin *= x;
  return sum;
}

// The same in doubles. What is added last is small beside what it is added to, so that little more
// than that sum's own rounding is lost.
SinCos quick_series(const Twofold& x) {
  const double square = x.high * x.high;
  double odd = 0, even = 0;  // sums from the third power, and from the fourth
  for (std::size_t n = 18; n >= 4; n -= 2) {
    odd = kInverseFactorials[n + 1].high - square * odd;
    even = kInverseFactorials[n].high - square * even;
  }
  odd = square * odd - kInverseFactorials[3].high;
  const double half = square / 2, most = 1 - half;
  return {x.high + (x.high * square * odd + x.low * most),
          most + (((1 - most) - half) + (square * square * even - x.high * x.low))};
}

constexpr double kMostQuickAngle = 1e5;         // whose quadrants are counted exactly below
constexpr double kLeastQuickRest = 0x1p-20;     // of which 53 bits are right
constexpr double kQuarterTurn = 0.78539816339;  // a little less

// As `reduced`, for most angles: pi/2 in three parts, of which two have 33 bits, so that their
// products are exact (Cody and Waite, "Software Manual for the Elementary Functions", 1980).
Reduced<Twofold> quickly_reduced(double x) {
  constexpr double kNearest = 0x1.8p52;  // adding it leaves no place for a fraction
  const double quadrants = (x * (1 / kHalfPi.high) + kNearest) - kNearest;
  const Twofold rest = Twofold::sum(x - quadrants * 0x1.921fb544p+0, quadrants * -0x1.0b4611a6p-34);
  return {Twofold::quick_sum(rest.high, rest.low - quadrants * 0x1.3198a2e037073p-69),
          static_cast<unsigned>(static_cast<int>(quadrants)) % 4};
}

// sum of q^n / (2 n + 1), of |q| <= 0.03 to all digits.
Twofold odd_series(const Twofold& q) {
  constexpr auto kInverseOdds = [] {
    std::array<Twofold, 22> inverse{};
    for (std::size_t n = 0; n < inverse.size(); ++n)
      inverse[n] = 1 / Twofold(2 * static_cast<double>(n) + 1);
    return inverse;
  }();
  Twofold sum = 0;
  for (std::size_t n = kInverseOdds.size(); n > 0; --n) sum = kInverseOdds[n - 1] + q * sum;
  return sum;
}

// Of 0 <= y <= x. Each half of the angle has the tangent t / (1 + sqrt(1 + t^2)).
Twofold atan_below_one(const Twofold& y, const Twofold& x) {
  Twofold t = y / x;
  for (int halves = 0; halves < 3; ++halves) t /= 1 + sqrt(1 + t * t);
  return 8 * t * odd_series(-t * t);
}

struct Power {  // mantissa 2^exponent
  Twofold mantissa;
  int exponent;
};
// e^x by Taylor's series of a sixteenth of what is left of whole powers of 2.
Power exp_in_parts(const Twofold& x) {
  const double twos = std::nearbyint(x.high / kLog2.high);
  const Twofold part = scaled(x - twos * kLog2, -4);
  Twofold sum = 0;
  for (std::size_t n = 15; n > 0; --n) sum = kInverseFactorials[n - 1] + part * sum;
  for (int doubled = 0; doubled < 4; ++doubled) sum *= sum;
  return {sum, static_cast<int>(twos)};
}

bool is_positive(double x) { return x > 0 && std::isfinite(x); }

}  // namespace

const Twofold kTwofoldPi = 2 * kHalfPi;

TwofoldSinCos sin_cos(const Twofold& x) {
  if (std::abs(x.high) < kQuarterTurn) return series(x);
  const auto [rest, quadrant] = reduced(x.high);
  return in_quadrant(series(rest + x.low), quadrant);
}

Twofold atan2(const Twofold& y, const Twofold& x) {
  const Twofold up = abs(y), along = abs(x);
  Twofold angle = up <= along ? atan_below_one(up, along) : kHalfPi - atan_below_one(along, up);
  if (x < 0) angle = kTwofoldPi - angle;
  return y < 0 ? -angle : angle;
}

Twofold exp(const Twofold& x) {
  const auto [mantissa, exponent] = exp_in_parts(x);
  return scaled(mantissa, exponent);
}

// log(m) = 2 artanh((m - 1) / (m + 1)), of a mantissa m between the roots of 1/2 and 2.
Twofold log(const Twofold& x) {
  int exponent = 0;
  if (std::frexp(x.high, &exponent) < 0.70710678) --exponent;
  const Twofold mantissa = scaled(x, -exponent);
  const Twofold s = (mantissa - 1) / (mantissa + 1);
  return exponent * kLog2 + 2 * s * odd_series(s * s);
}

SinCos sin_cos(double x) {
  if (std::abs(x) < kQuarterTurn) return quick_series(x);
  if (!std::isfinite(x)) return {x - x, x - x};
  if (std::abs(x) < kMostQuickAngle) {
    const auto [rest, quadrant] = quickly_reduced(x);
    if (std::abs(rest.high) > kLeastQuickRest) return in_quadrant(quick_series(rest), quadrant);
  }
  const auto [rest, quadrant] = reduced(x);
  return in_quadrant(quick_series(rest), quadrant);
}
double sin(double x) { return sin_cos(x).sin; }
double cos(double x) { return sin_cos(x).cos; }

double tan(double x) {
  if (!std::isfinite(x)) return x - x;
  const auto [s, c] = sin_cos(Twofold(x));
  return double(s / c);
}

double atan2(double y, double x) {
  if (y == 0 || x == 0 || !std::isfinite(y) || !std::isfinite(x)) return std::atan2(y, x);
  int exponent = 0;
  std::frexp(std::max(std::abs(x), std::abs(y)), &exponent);
  const double up = std::ldexp(y, -exponent), along = std::ldexp(x, -exponent);
  if (along > 0 && std::abs(up) < 0x1p-60) return y / x;
  return std::copysign(double(atan2(Twofold(std::abs(up)), Twofold(along))), y);
}
double atan(double x) { return atan2(x, 1.0); }
double asin(double x) {
  if (!(std::abs(x) < 1)) return std::asin(x);
  return double(atan2(Twofold(x), sqrt(Twofold::sum(1, -x) * Twofold::sum(1, x))));
}

double hypot(double x, double y, double z) {
  if (std::isinf(x) || std::isinf(y) || std::isinf(z)) return INFINITY;
  const double most = std::max({std::abs(x), std::abs(y), std::abs(z)});
  int exponent = 0;
  if (most > 1e100 || most < 1e-100) std::frexp(most, &exponent);
  const auto square = [&](double a) {
    const double part = exponent == 0 ? a : std::ldexp(a, -exponent);
    return Twofold::product(part, part);
  };
  return std::ldexp(double(sqrt(square(x) + square(y) + square(z))), exponent);
}
double hypot(double x, double y) { return hypot(x, y, 0); }

double log(double x) { return is_positive(x) ? double(log(Twofold(x))) : std::log(x); }
double log2(double x) { return is_positive(x) ? double(log(Twofold(x)) / kLog2) : std::log2(x); }
double log10(double x) { return is_positive(x) ? double(log(Twofold(x)) / kLog10) : std::log10(x); }

double pow(double x, double y) {
  if (x == 0 || y == 0 || x == 1 || !std::isfinite(x) || !std::isfinite(y)) return std::pow(x, y);
  const double whole = std::nearbyint(y);
  if (x < 0 && y != whole) return std::pow(x, y);
  const Twofold power = y * log(Twofold(std::abs(x)));
  const auto [mantissa, exponent] =
      exp_in_parts(std::abs(power.high) < 800 ? power : std::copysign(800, power.high));
  const double size = std::ldexp(double(mantissa), exponent);
  return x < 0 && std::fmod(whole, 2) != 0 ? -size : size;
}

}  // namespace lantern::geometry
