// The elementary functions. Those of <cmath> differ in their last bits from one C library to the
// next, and a picture or a count with them; these are made of operations that IEEE 754 defines to
// the last bit (+ - * / sqrt, whole exponents), and so are the same wherever Lantern is built.
//
// Each result is within 1 unit in the last place (ulp) of the true one. All but sines and cosines
// are computed in twice the digits and rounded once: a little more than half a ulp. At what is no
// number, infinite or outside of a function's range they return what those of <cmath> do.
#pragma once

#include "geometry/twofold.hpp"

namespace lantern::geometry {

// Angles in radians, of any size.
struct SinCos {
  double sin = 0, cos = 1;
};
SinCos sin_cos(double x);
double sin(double x);
double cos(double x);
double tan(double x);
double asin(double x);
double atan(double x);
double atan2(double y, double x);

double hypot(double x, double y);
double hypot(double x, double y, double z);
double log(double x);
double log2(double x);
double log10(double x);
double pow(double x, double y);

// In twice the digits: right to 29 or more.
extern const Twofold kTwofoldPi;
struct TwofoldSinCos {
  Twofold sin = 0, cos = 1;
};
TwofoldSinCos sin_cos(const Twofold& x);
Twofold atan2(const Twofold& y, const Twofold& x);
Twofold exp(const Twofold& x);  // of |x| <= 700
Twofold log(const Twofold& x);  // of a number above 0

}  // namespace lantern::geometry
