// Elliptic integrals and Jacobi's elliptic functions, to the last digits of a long double.
//
// The modulus is given by the complementary parameter m1 = 1 - m = 1 - k^2, in (0, 1]: near 1 the
// modulus itself has lost what matters, as for a pendulum that is let go almost upright.
#pragma once

namespace lantern::geometry {

struct Jacobi {
  long double sn = 0;
  long double cn = 1;
  long double dn = 1;
};

// K(m), a quarter of the period. By the arithmetic-geometric mean.
long double quarter_period(long double m1);

// Of an argument of a few periods at most; longer ones are for the caller to reduce. By Landen's
// transformation (Bulirsch, Numerische Mathematik 7, 1965).
Jacobi jacobi(long double u, long double m1);

// The argument in (-2 K, 2 K] that these functions are of.
long double argument_of(const Jacobi& functions, long double m1);

// Carlson's symmetric integrals of the first and third kind (Numerical Algorithms 10, 1995). All
// arguments >= 0, at most one of x, y, z is 0; p > 0.
long double carlson_rf(long double x, long double y, long double z);
long double carlson_rj(long double x, long double y, long double z, long double p);

}  // namespace lantern::geometry
