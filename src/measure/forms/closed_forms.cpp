
#include "measure/forms/closed_forms.hpp"

#include <algorithm>
#include <array>

#include <glm/geometric.hpp>

#include "base/check.hpp"
#include "base/error.hpp"
#include "geometry/elliptic.hpp"

namespace lantern::measure {
namespace {

// (1 - e^-z) / z, which is 1 at 0.
long double mean_decay(long double z) { return z == 0 ? 1 : -std::expm1(-z) / z; }

// (z - 1 + e^-z) / z^2, which is 1/2 at 0. Below 1 its series, where the formula cancels.
long double mean_lag(long double z) {
  if (z >= 1) return (z + std::expm1(-z)) / (z * z);
  long double sum = 0, term = 0.5L;
  for (int n = 3; n < 40; ++n) {
    sum += term;
    term *= -z / n;
  }
  return sum;
}

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

// Kepler's equation from any point of the orbit on (Battin, "An introduction to the mathematics and
// methods of astrodynamics", 1999, section 4.3): by how much the eccentric anomaly has grown,
//
//     E + s (1 - cos E) - (1 - r0/a) sin E = mean,     s = r0 . v0 / sqrt(mu a)
//
// The left side grows with E, at r/a. So Newton's method within a bracket always gets there. For a
// mean anomaly within half a turn.
long double anomaly(long double s, long double near, long double mean) {
  const auto miss = [&](long double e) {
    const long double half = std::sin(e / 2);
    return e - mean + 2 * s * half * half - near * std::sin(e);
  };
  long double low = mean - 4, high = mean + 4, e = mean;
  for (int i = 0; i < 200; ++i) {
    const long double value = miss(e);
    if (value == 0) return e;
    (value > 0 ? high : low) = e;
    const long double slope = 1 + s * std::sin(e) - near * std::cos(e);
    long double next = e - value / slope;
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (next == e || std::abs(next - e) < 0x1p-66L) return next;
    e = next;
  }
  return e;
}

LongQuat about(const LongVec& axis, long double angle) {
  const long double s = std::sin(angle / 2);
  return {std::cos(angle / 2), axis.x * s, axis.y * s, axis.z * s};
}

LongQuat turned_by(const LongVec& vector) {
  const long double angle = glm::length(vector);
  return angle > 0 ? about(vector / angle, angle) : LongQuat(1, 0, 0, 0);
}

// The columns are the body's axes seen along those named 1, 2, 3: a turn, so that one is flipped if
// the order is left-handed.
LongQuat naming(const std::array<int, 3>& axis) {
  glm::mat<3, 3, long double> m(0.0L);
  const bool right_handed = (axis[1] - axis[0] + 3) % 3 == 1;
  for (int i = 0; i < 3; ++i) m[axis[i]][i] = i == 0 && !right_handed ? -1 : 1;
  return glm::quat_cast(m);
}

using Column = std::vector<long double>;

long double dot(const Column& a, const Column& b) {
  long double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

void rotate(Column& a, Column& b, long double c, long double s) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const long double x = a[i], y = b[i];
    a[i] = c * x - s * y;
    b[i] = s * x + c * y;
  }
}

}  // namespace

// With z = rate t:  v = v0 e^-z + g t (1 - e^-z)/z,  x = x0 + v0 t (1 - e^-z)/z
//                                                        + g t^2 (z - 1 + e^-z)/z^2.
FlightState exact_flight(FlightState start, long double acceleration, long double rate,
                         long double time) {
  const long double z = rate * time, decay = mean_decay(z);
  return {start.position + time * (start.velocity * decay + acceleration * time * mean_lag(z)),
          start.velocity * std::exp(-z) + acceleration * time * decay};
}

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

// Whittaker, "A treatise on the analytical dynamics of particles and rigid bodies", section 44:
//
//     sin(angle/2) = k sn(u),  cos(angle/2) = dn(u),  speed = 2 k omega cn(u),  u = omega t + u0
PendulumState exact_pendulum(long double omega, PendulumState start, long double time) {
  const long double s = std::sin(start.angle / 2), c = std::cos(start.angle / 2);
  const long double w = start.speed / (2 * omega);
  const long double k = std::sqrt(s * s + w * w);
  const long double m1 = (c - w) * (c + w);  // 1 - k^2, where 1 - s^2 would have lost its digits
  if (!(m1 > 0)) throw Refused("the pendulum goes over the top");
  if (!(k > 0)) return start;
  const Jacobi<long double> at_start{s / k, w / k, c};
  const long double period = 4 * quarter_period(m1);
  const Precise way = product(omega, time);
  const long double turns = std::round(way.high / period);
  const long double reduced = std::fma(-turns, period, way.high) + way.low;
  const auto f = jacobi(reduced + argument_of(at_start, m1), m1);
  return {2 * std::atan2(k * f.sn, f.dn), 2 * k * omega * f.cn};
}

long double half_axis(long double mu, const Orbit& start) {
  return 1 / (2 / glm::length(start.position) - glm::dot(start.velocity, start.velocity) / mu);
}

Orbit exact_orbit(long double mu, const Orbit& start, long double time) {
  const long double r0 = glm::length(start.position), a = half_axis(mu, start);
  const auto momentum = glm::cross(start.position, start.velocity);
  if (!(a > 0) || !std::isfinite(a)) throw Refused("the two bodies are not bound to each other");
  if (!(glm::dot(momentum, momentum) > 0)) throw Refused("the two bodies fall into each other");
  const long double s = glm::dot(start.position, start.velocity) / std::sqrt(mu * a);
  // Whole turns are taken off while the phase is still exact.
  const Precise phase = product(root(quotient(mu, a * a * a)), time);
  const long double turns = std::round(phase.high / (2 * kPi));
  const long double two_pi_low = -1.0033115225336664e-19L;  // 2 pi - its long double
  const long double mean = std::fma(-turns, 2 * kPi, phase.high) + (phase.low - turns * two_pi_low);
  const long double e = anomaly(s, 1 - r0 / a, mean);
  const long double half = std::sin(e / 2), sin = std::sin(e), versine = 2 * half * half;
  const long double r = a * (1 + s * sin - (1 - r0 / a) * (1 - versine));
  // Lagrange's coefficients.
  const long double f = 1 - a / r0 * versine;
  const long double g = std::sqrt(a / mu) * (a * s * versine + r0 * sin);
  const long double ft = -std::sqrt(mu * a) / (r * r0) * sin;
  const long double gt = 1 - a / r * versine;
  return {f * start.position + g * start.velocity, ft * start.position + gt * start.velocity};
}

// Jacobi's solution (Whittaker, section 69; van Zon and Schofield, "Numerical implementation of the
// exact dynamics of free rigid bodies", Journal of Computational Physics 225, 2007). Axes 1, 2, 3
// are named so that L circles axis 3, and 2 is the middle one. With a = 1 / I:
//
//     L1 = A1 cn(u),  L2 = A2 sn(u),  L3 = A3 dn(u),   u = rate t + u0
//
// L stands still in the world and is the z axis there. Then tilt and spin are its polar angles in
// the body, and the precession about it is an elliptic integral of the third kind.
FreeTop::FreeTop(const LongVec& inverse_inertia, const LongQuat& orientation,
                 const LongVec& momentum)
    : start_(orientation), momentum_(momentum), spin_(momentum * inverse_inertia) {
  fixed_ = glm::cross(momentum, spin_) == LongVec(0.0L);
  if (fixed_) return;
  std::array<int, 3> axis{0, 1, 2};
  std::ranges::stable_sort(axis, {}, [&](int i) { return inverse_inertia[i]; });
  // 2T - L^2 a2 tells which of the outer axes L circles.
  const auto part = [&](int i) {
    return (inverse_inertia[axis[i]] - inverse_inertia[axis[1]]) * momentum[axis[i]] *
           momentum[axis[i]];
  };
  const long double side = part(0) + part(2);
  if (side == 0) throw Refused("the body is on the boundary between two ways of tumbling");
  if (side < 0) std::swap(axis[0], axis[2]);
  const LongVec a(inverse_inertia[axis[0]], inverse_inertia[axis[1]], inverse_inertia[axis[2]]);
  const long double d31 = a[2] - a[0], d32 = a[2] - a[1], d21 = a[1] - a[0];
  names_ = naming(axis);
  const LongVec l = names_ * momentum;
  length_ = glm::length(l);
  inverse1_ = a[0];
  size_[0] = std::sqrt(l[0] * l[0] + l[1] * l[1] * (d32 / d31));
  size_[2] = std::copysign(std::sqrt(l[2] * l[2] + l[1] * l[1] * (d21 / d31)), l[2]);
  // L1' = L2 L3 (a3 - a2) tells which way L goes round.
  size_[1] = size_[0] * std::sqrt(d31 / d32) * (d32 * size_[2] > 0 ? -1 : 1);
  rate_ = std::abs(size_[2]) * std::sqrt(d32 * d31);
  m1_ = std::min(1.0L, side / (d32 * size_[2] * size_[2]));
  n_ = -d21 / d32;
  wobble_ = d31 * d21 / d32;
  half_period_ = 2 * quarter_period(m1_);
  half_integral_ = 2 * integral(half_period_ / 2);
  u0_ = argument_of<long double>({l[1] / size_[1], l[0] / size_[0], l[2] / size_[2]}, m1_);
  const Phase start = phase(0);
  integral0_ = start.half_turns * half_integral_ + integral(start.rest);
  base_ = orientation * glm::conjugate(names_) * glm::conjugate(to_momentum_frame(l, 0));
}

FreeTop::Phase FreeTop::phase(long double time) const {
  const Precise way = product(rate_, time);
  const long double half_turns = std::round((way.high + u0_) / half_period_);
  return {half_turns, std::fma(-half_turns, half_period_, way.high) + (way.low + u0_)};
}

LongVec FreeTop::named(long double time) const {
  const auto [half_turns, rest] = phase(time);
  const auto f = jacobi(rest, m1_);
  const long double sign = std::fmod(half_turns, 2.0L) == 0 ? 1 : -1;
  return {sign * size_[0] * f.cn, sign * size_[1] * f.sn, size_[2] * f.dn};
}

// The integral of sn^2 / (1 - n sn^2) up to there.
long double FreeTop::integral(long double rest) const {
  const auto [s, c, d] = jacobi(rest, m1_);
  return s * s * s / 3 * carlson_rj<long double>(c * c, d * d, 1, 1 - n_ * s * s);
}

// precession' = |L| (a1 L1^2 + a2 L2^2) / (L1^2 + L2^2)
long double FreeTop::precession(long double time) const {
  const auto [half_turns, rest] = phase(time);
  const long double grown = half_turns * half_integral_ + integral(rest) - integral0_;
  return length_ * (inverse1_ * time + wobble_ / rate_ * grown);
}

LongQuat FreeTop::to_momentum_frame(const LongVec& l, long double precession) const {
  const LongVec x(1, 0, 0), z(0, 0, 1);
  return about(z, precession) * about(x, std::atan2(std::hypot(l.x, l.y), l.z)) *
         about(z, std::atan2(l.x, l.y));
}

LongQuat FreeTop::orientation(long double time) const {
  if (fixed_) return start_ * turned_by(spin_ * time);
  const LongQuat now = to_momentum_frame(named(time), precession(time));
  return base_ * now * names_;
}

LongVec FreeTop::momentum(long double time) const {
  return fixed_ ? momentum_ : glm::conjugate(names_) * named(time);
}

ChainMotion::ChainMotion(const Column& masses, const Column& stiffnesses,
                         const Column& displacements, const Column& velocities) {
  const std::size_t n = masses.size();
  LANTERN_CHECK(n > 0 && (stiffnesses.size() == n || stiffnesses.size() == n + 1), ==, true);
  for (const long double m : masses) root_mass_.push_back(std::sqrt(m));
  const auto all_equal = [](const Column& v) {
    return std::ranges::all_of(v, [&](long double x) { return x == v.front(); });
  };
  if (stiffnesses.size() == n + 1 && all_equal(masses) && all_equal(stiffnesses))
    find_uniform_modes(n, masses.front(), stiffnesses.front());
  else
    find_modes(masses, stiffnesses);
  Column x(n), v(n);
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = root_mass_[i] * displacements[i];
    v[i] = root_mass_[i] * velocities[i];
  }
  for (std::size_t k = 0; k < n; ++k) {
    cosines_.push_back(dot(modes_[k], x));
    sines_.push_back(dot(modes_[k], v) / omega_[k]);
  }
}

// omega_k = 2 sqrt(k/m) sin(k pi / (2 (N+1))), and mode k is sin(j k pi / (N+1)): Rayleigh, "The
// theory of sound", section 120.
void ChainMotion::find_uniform_modes(std::size_t n, long double mass, long double stiffness) {
  Column sines(2 * (n + 1));  // of all angles that come up
  for (std::size_t j = 0; j < sines.size(); ++j)
    sines[j] = std::sin(kPi * static_cast<long double>(j) / static_cast<long double>(n + 1));
  const long double unit = std::sqrt(2 / static_cast<long double>(n + 1));
  const long double fastest = 2 * std::sqrt(stiffness / mass);
  for (std::size_t k = 1; k <= n; ++k) {
    omega_.push_back(fastest * std::sin(kPi * static_cast<long double>(k) /
                                        static_cast<long double>(2 * (n + 1))));
    Column mode(n);
    for (std::size_t j = 1; j <= n; ++j) mode[j - 1] = unit * sines[j * k % sines.size()];
    modes_.push_back(std::move(mode));
  }
}

// The matrix of stretches, one row a spring: B = sqrt(k_i) (x_i - x_(i-1)) / sqrt(m). Its singular
// values are the frequencies. Rotating its columns until they are at right angles (Hestenes, 1958)
// gives even the slow ones to the last digits, whatever the ratio of stiffnesses (Demmel and
// Veselic, "Jacobi's method is more accurate than QR", 1992); the eigenvalues of B^T B would not.
void ChainMotion::find_modes(const Column& masses, const Column& stiffnesses) {
  const std::size_t n = masses.size();
  std::vector<Column> b(n, Column(stiffnesses.size(), 0.0L));
  modes_.assign(n, Column(n, 0.0L));
  for (std::size_t j = 0; j < n; ++j) {
    modes_[j][j] = 1;
    b[j][j] = std::sqrt(stiffnesses[j]) / root_mass_[j];
    if (j + 1 < stiffnesses.size()) b[j][j + 1] = -std::sqrt(stiffnesses[j + 1]) / root_mass_[j];
  }
  bool changed = true;
  for (int sweep = 0; changed && sweep < 60; ++sweep) {
    changed = false;
    for (std::size_t p = 0; p < n; ++p) {
      for (std::size_t q = p + 1; q < n; ++q) {
        const long double pp = dot(b[p], b[p]), qq = dot(b[q], b[q]), pq = dot(b[p], b[q]);
        if (std::abs(pq) <= 0x1p-62L * std::sqrt(pp) * std::sqrt(qq)) continue;
        changed = true;
        const long double z = (qq - pp) / (2 * pq);
        const long double t = std::copysign(1 / (std::abs(z) + std::hypot(1.0L, z)), z);
        const long double c = 1 / std::hypot(1.0L, t);
        rotate(b[p], b[q], c, c * t);
        rotate(modes_[p], modes_[q], c, c * t);
      }
    }
  }
  for (const Column& column : b) omega_.push_back(std::sqrt(dot(column, column)));
}

void ChainMotion::at(long double time, Column& displacements, Column& velocities) const {
  const std::size_t n = root_mass_.size();
  displacements.assign(n, 0);
  velocities.assign(n, 0);
  for (std::size_t k = 0; k < n; ++k) {
    const auto [c, s] = cos_sin(product(omega_[k], time));
    const long double x = cosines_[k] * c + sines_[k] * s;
    const long double v = omega_[k] * (sines_[k] * c - cosines_[k] * s);
    for (std::size_t j = 0; j < n; ++j) {
      displacements[j] += x * modes_[k][j];
      velocities[j] += v * modes_[k][j];
    }
  }
  for (std::size_t j = 0; j < n; ++j) {
    displacements[j] /= root_mass_[j];
    velocities[j] /= root_mass_[j];
  }
}

}  // namespace lantern::measure
