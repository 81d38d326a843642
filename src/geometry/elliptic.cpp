#include "geometry/elliptic.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "geometry/elementary.hpp"

namespace lantern::geometry {
namespace {

using std::abs, std::atan2, std::sqrt;

template <class Number>
Number pi() {
  if constexpr (std::is_same_v<Number, Twofold>)
    return kTwofoldPi;
  else
    return std::numbers::pi_v<Number>;
}
struct LongSinCos {
  long double sin, cos;
};
LongSinCos sin_cos(long double x) { return {std::sin(x), std::cos(x)}; }
long double artanh(long double x) { return std::atanh(x); }
Twofold artanh(const Twofold& x) { return log((1 + x) / (1 - x)) / 2; }

// Means of two numbers as near as this are equal: the next two are nearer by twice as many digits.
constexpr double kHalfTheDigits = 1e-16;

// The degenerate integral R_C(x, y) = R_F(x, y, y), here of x = 1 and y = 1 + e: arctan or artanh,
// as a series where they cancel.
template <class Number>
Number carlson_rc_one(const Number& e) {
  if (abs(e) < 0.01) {
    Number sum = 0, power = 1;
    for (int n = 0; n < 14; ++n) {
      sum += power / (2 * n + 1);
      power *= -e;
    }
    return sum;
  }
  const Number r = sqrt(abs(e));
  return (e > 0 ? atan2(r, Number(1)) : artanh(r)) / r;
}

}  // namespace

template <class Number>
Number quarter_period(Number m1) {
  Number a = 1, b = sqrt(m1);
  for (int i = 0; i < 40 && abs(a - b) > kHalfTheDigits * a; ++i) {
    const Number mean = (a + b) / 2;
    b = sqrt(a * b);
    a = mean;
  }
  return pi<Number>() / (a + b);
}

template <class Number>
Jacobi<Number> jacobi(Number u, Number m1) {
  constexpr int kMost = 24;
  Number means[kMost], roots[kMost];
  Number a = 1, b = sqrt(m1), c = 0;
  int last = 0;
  for (int i = 0; i < kMost; ++i) {
    last = i;
    means[i] = a;
    roots[i] = b;
    c = (a + b) / 2;
    if (abs(a - b) <= kHalfTheDigits * a) break;
    b = sqrt(a * b);
    a = c;
  }
  u *= c;
  const auto [sine, cosine] = sin_cos(u);
  Jacobi<Number> f{sine, cosine, 1};
  if (f.sn == 0) return f;
  a = f.cn / f.sn;
  c *= a;
  for (int i = last; i >= 0; --i) {
    const Number mean = means[i];
    a *= c;
    c *= f.dn;
    f.dn = (roots[i] + a) / (mean + a);
    a = c / mean;
  }
  const Number r = 1 / sqrt(c * c + 1);
  f.sn = f.sn < 0 ? -r : r;
  f.cn = c * f.sn;
  return f;
}

template <class Number>
Number argument_of(const Jacobi<Number>& f, Number m1) {
  const Number u = f.sn * carlson_rf<Number>(f.cn * f.cn, f.dn * f.dn, 1);
  if (f.cn >= 0) return u;
  const Number half = 2 * quarter_period(m1);
  return f.sn < 0 ? -half - u : half - u;
}

template <class Number>
Number carlson_rf(Number x, Number y, Number z) {
  const Number start = (x + y + z) / 3;
  const Number spread = std::max<Number>({abs(start - x), abs(start - y), abs(start - z)});
  Number a = start, q = spread * 1e4;  // (3 epsilon)^(-1/8) is 2e2: room to spare
  const Number dx = start - x, dy = start - y;
  Number four = 1;
  while (q > abs(a) * four) {
    const Number rx = sqrt(x), ry = sqrt(y), rz = sqrt(z);
    const Number lambda = rx * ry + ry * rz + rz * rx;
    x = (x + lambda) / 4;
    y = (y + lambda) / 4;
    z = (z + lambda) / 4;
    a = (a + lambda) / 4;
    four *= 4;
  }
  const Number ex = dx / (four * a), ey = dy / (four * a), ez = -ex - ey;
  const Number e2 = ex * ey - ez * ez, e3 = ex * ey * ez;
  return (1 - e2 / 10 + e3 / 14 + e2 * e2 / 24 - 3 * e2 * e3 / 44) / sqrt(a);
}

template <class Number>
Number carlson_rj(Number x, Number y, Number z, Number p) {
  const Number start = (x + y + z + 2 * p) / 5;
  const Number spread =
      std::max<Number>({abs(start - x), abs(start - y), abs(start - z), abs(start - p)});
  const Number dx = start - x, dy = start - y, dz = start - z;
  const Number delta = (p - x) * (p - y) * (p - z);
  Number a = start, q = spread * 1e4, four = 1, sum = 0;
  while (q > abs(a) * four) {
    const Number rx = sqrt(x), ry = sqrt(y), rz = sqrt(z), rp = sqrt(p);
    const Number lambda = rx * ry + ry * rz + rz * rx;
    const Number d = (rp + rx) * (rp + ry) * (rp + rz);
    sum += carlson_rc_one(delta / (four * four * four * d * d)) / (four * d);
    x = (x + lambda) / 4;
    y = (y + lambda) / 4;
    z = (z + lambda) / 4;
    p = (p + lambda) / 4;
    a = (a + lambda) / 4;
    four *= 4;
  }
  const Number ex = dx / (four * a), ey = dy / (four * a), ez = dz / (four * a);
  const Number ep = -(ex + ey + ez) / 2;
  const Number e2 = ex * ey + ex * ez + ey * ez - 3 * ep * ep;
  const Number e3 = ex * ey * ez + 2 * e2 * ep + 4 * ep * ep * ep;
  const Number e4 = (2 * ex * ey * ez + e2 * ep + 3 * ep * ep * ep) * ep;
  const Number e5 = ex * ey * ez * ep * ep;
  const Number series =
      1 - 3 * e2 / 14 + e3 / 6 + 9 * e2 * e2 / 88 - 3 * e4 / 22 - 9 * e2 * e3 / 52 + 3 * e5 / 26;
  return series / (four * a * sqrt(a)) + 6 * sum;
}

template long double quarter_period(long double);
template Twofold quarter_period(Twofold);
template Jacobi<long double> jacobi(long double, long double);
template Jacobi<Twofold> jacobi(Twofold, Twofold);
template long double argument_of(const Jacobi<long double>&, long double);
template Twofold argument_of(const Jacobi<Twofold>&, Twofold);
template long double carlson_rf(long double, long double, long double);
template Twofold carlson_rf(Twofold, Twofold, Twofold);
template long double carlson_rj(long double, long double, long double, long double);
template Twofold carlson_rj(Twofold, Twofold, Twofold, Twofold);

}  // namespace lantern::geometry
