// Elliptic integrals and Jacobi's elliptic functions, of numbers of type long double or Twofold: to
// the last digits of a long double, and to 24 digits in a Twofold.
//
// The modulus is given by the complementary parameter m1 = 1 - m = 1 - k^2, in (0, 1]: near 1 the
// modulus itself has lost what matters, as for a pendulum that is let go almost upright.
#pragma once

namespace lantern::geometry {

template <class Number>
struct Jacobi {
  Number sn = 0;
  Number cn = 1;
  Number dn = 1;
};

// K(m), a quarter of the period. By the arithmetic-geometric mean.
template <class Number>
Number quarter_period(Number m1);

// Of an argument of a few periods at most; longer ones are for the caller to reduce. By Landen's
// transformation (Bulirsch, Numerische Mathematik 7, 1965).
template <class Number>
Jacobi<Number> jacobi(Number u, Number m1);

// The argument in (-2 K, 2 K] that these functions are of.
template <class Number>
Number argument_of(const Jacobi<Number>& functions, Number m1);

// Carlson's symmetric integrals of the first and third kind (Numerical Algorithms 10, 1995). All
// arguments >= 0, at most one of x, y, z is 0; p > 0.
template <class Number>
Number carlson_rf(Number x, Number y, Number z);
template <class Number>
Number carlson_rj(Number x, Number y, Number z, Number p);

}  // namespace lantern::geometry
