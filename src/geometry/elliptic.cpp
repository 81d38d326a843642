#include "geometry/elliptic.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lantern::geometry {
namespace {

constexpr long double kEpsilon = 0x1p-64L;

// The degenerate integral R_C(x, y) = R_F(x, y, y), here of x = 1 and y = 1 + e: arctan or artanh,
// as a series where they cancel.
long double carlson_rc_one(long double e) {
  if (std::abs(e) < 0.01L) {
    long double sum = 0, power = 1;
    for (int n = 0; n < 14; ++n) {
      sum += power / (2 * n + 1);
      power *= -e;
    }
    return sum;
  }
  const long double r = std::sqrt(std::abs(e));
  return e > 0 ? std::atan(r) / r : std::atanh(r) / r;
}

}  // namespace

long double quarter_period(long double m1) {
  long double a = 1, b = std::sqrt(m1);
  for (int i = 0; i < 40 && std::abs(a - b) > 4 * kEpsilon * a; ++i) {
    const long double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return std::numbers::pi_v<long double> / (a + b);
}

Jacobi jacobi(long double u, long double m1) {
  constexpr int kMost = 24;
  long double means[kMost], roots[kMost];
  long double a = 1, b = std::sqrt(m1), c = 0;
  int last = 0;
  for (int i = 0; i < kMost; ++i) {
    last = i;
    means[i] = a;
    roots[i] = b;
    c = (a + b) / 2;
    if (std::abs(a - b) <= 1e-10L * a) break;  // the next one has twice as many digits
    b = std::sqrt(a * b);
    a = c;
  }
  u *= c;
  Jacobi f{std::sin(u), std::cos(u), 1};
  if (f.sn == 0) return f;
  a = f.cn / f.sn;
  c *= a;
  for (int i = last; i >= 0; --i) {
    const long double mean = means[i];
    a *= c;
    c *= f.dn;
    f.dn = (roots[i] + a) / (mean + a);
    a = c / mean;
  }
  const long double r = 1 / std::sqrt(c * c + 1);
  f.sn = f.sn < 0 ? -r : r;
  f.cn = c * f.sn;
  return f;
}

long double argument_of(const Jacobi& f, long double m1) {
  const long double u = f.sn * carlson_rf(f.cn * f.cn, f.dn * f.dn, 1);
  if (f.cn >= 0) return u;
  const long double half = 2 * quarter_period(m1);
  return f.sn < 0 ? -half - u : half - u;
}

long double carlson_rf(long double x, long double y, long double z) {
  const long double start = (x + y + z) / 3;
  const long double spread =
      std::max({std::abs(start - x), std::abs(start - y), std::abs(start - z)});
  long double a = start, q = spread * 1e4L;  // (3 epsilon)^(-1/8) is 2e2: room to spare
  const long double dx = start - x, dy = start - y;
  long double four = 1;
  while (q > std::abs(a) * four) {
    const long double rx = std::sqrt(x), ry = std::sqrt(y), rz = std::sqrt(z);
    const long double lambda = rx * ry + ry * rz + rz * rx;
    x = (x + lambda) / 4;
    y = (y + lambda) / 4;
    z = (z + lambda) / 4;
    a = (a + lambda) / 4;
    four *= 4;
  }
  const long double ex = dx / (four * a), ey = dy / (four * a), ez = -ex - ey;
  const long double e2 = ex * ey - ez * ez, e3 = ex * ey * ez;
  return (1 - e2 / 10 + e3 / 14 + e2 * e2 / 24 - 3 * e2 * e3 / 44) / std::sqrt(a);
}

long double carlson_rj(long double x, long double y, long double z, long double p) {
  const long double start = (x + y + z + 2 * p) / 5;
  const long double spread = std::max(
      {std::abs(start - x), std::abs(start - y), std::abs(start - z), std::abs(start - p)});
  const long double dx = start - x, dy = start - y, dz = start - z;
  const long double delta = (p - x) * (p - y) * (p - z);
  long double a = start, q = spread * 1e4L, four = 1, sum = 0;
  while (q > std::abs(a) * four) {
    const long double rx = std::sqrt(x), ry = std::sqrt(y), rz = std::sqrt(z), rp = std::sqrt(p);
    const long double lambda = rx * ry + ry * rz + rz * rx;
    const long double d = (rp + rx) * (rp + ry) * (rp + rz);
    sum += carlson_rc_one(delta / (four * four * four * d * d)) / (four * d);
    x = (x + lambda) / 4;
    y = (y + lambda) / 4;
    z = (z + lambda) / 4;
    p = (p + lambda) / 4;
    a = (a + lambda) / 4;
    four *= 4;
  }
  const long double ex = dx / (four * a), ey = dy / (four * a), ez = dz / (four * a);
  const long double ep = -(ex + ey + ez) / 2;
  const long double e2 = ex * ey + ex * ez + ey * ez - 3 * ep * ep;
  const long double e3 = ex * ey * ez + 2 * e2 * ep + 4 * ep * ep * ep;
  const long double e4 = (2 * ex * ey * ez + e2 * ep + 3 * ep * ep * ep) * ep;
  const long double e5 = ex * ey * ez * ep * ep;
  const long double series =
      1 - 3 * e2 / 14 + e3 / 6 + 9 * e2 * e2 / 88 - 3 * e4 / 22 - 9 * e2 * e3 / 52 + 3 * e5 / 26;
  return series / (four * a * std::sqrt(a)) + 6 * sum;
}

}  // namespace lantern::geometry
