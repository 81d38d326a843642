// Each exact answer against an independent integration of the equations of motion.
#include <cmath>

#include <gtest/gtest.h>

#include "../physics/exact_oscillator.hpp"
#include "geometry/elliptic.hpp"
#include "measure/forms/closed_forms.hpp"
#include "measure/forms/dormand_prince.hpp"

namespace lantern::measure {
namespace {

using State = std::vector<long double>;

template <class Slope>
State integrated(const Slope& slope, State y, long double end) {
  DormandPrince<long double> method(1e-15L, State(y.size(), 1.0L));
  method.run(slope, 0.0L, end, y);
  return y;
}

TEST(Projectile, IsTheIntegralOfItsForces) {
  for (const long double rate : {0.0L, 1e-9L, 0.3L, 1.0L, 3.0L}) {
    const auto slope = [&](long double, const State& y, State& dy) {
      dy = {y[1], -10 - rate * y[1]};
    };
    const State y = integrated(slope, {2, 30}, 3);
    const FlightState exact = exact_flight({2, 30}, -10, rate, 3);
    EXPECT_NEAR(static_cast<double>(exact.position - y[0]), 0, 1e-13) << "rate " << rate;
    EXPECT_NEAR(static_cast<double>(exact.velocity - y[1]), 0, 1e-13) << "rate " << rate;
  }
}

TEST(Projectile, LosesNoDigitsAtAnyDrag) {
  // Just below and above where the series ends, and against the parabola and the last speed.
  for (const long double z : {0.999999L, 1.000001L}) {
    const FlightState a = exact_flight({0, 0}, 1, z, 1);
    EXPECT_NEAR(static_cast<double>(a.position - (z - 1 + std::exp(-z)) / (z * z)), 0, 1e-18);
  }
  const FlightState parabola = exact_flight({0, 1}, -1, 1e-18L, 2);
  EXPECT_NEAR(static_cast<double>(parabola.position), 0, 1e-17);
  const FlightState stiff = exact_flight({0, 5}, -10, 1e4L, 10);
  EXPECT_NEAR(static_cast<double>(stiff.velocity + 1e-3L), 0, 1e-20);
  EXPECT_NEAR(static_cast<double>(stiff.position - (5 + 1e-3L) / 1e4L + 0.01L), 0, 1e-18);
}

TEST(Oscillator, AgreesWithTheTestsOwnFormulas) {
  for (const long double zeta : {0.0L, 1e-6L, 0.3L, 1.0L, 1.5L, 1e3L}) {
    const long double k = 9, m = 4, omega = 1.5L;  // exact
    for (const long double t : {0.0L, 0.1L, 1.0L, 7.0L}) {
      const Swing a = exact_swing(k, 2 * zeta * m * omega, m, {1, 0.5L}, t);
      const OscillatorState b = exact_oscillator(omega, zeta, {1, 0.5L}, t);
      EXPECT_NEAR(static_cast<double>(a.x - b.x), 0, 2e-15) << "zeta " << zeta << " t " << t;
      EXPECT_NEAR(static_cast<double>(a.v - b.v), 0, 2e-15) << "zeta " << zeta << " t " << t;
    }
  }
}

TEST(Oscillator, IsSmoothThroughCriticalDamping) {
  const Swing at = exact_swing(1, 2, 1, {1, 0.5L}, 2);
  for (const long double off : {-1e-12L, -1e-17L, 1e-17L, 1e-12L}) {
    const Swing near = exact_swing(1, 2 + off, 1, {1, 0.5L}, 2);
    EXPECT_LT(std::abs(near.x - at.x), 2 * std::abs(off) + 1e-18L) << "off by " << off;
    EXPECT_LT(std::abs(near.v - at.v), 2 * std::abs(off) + 1e-18L) << "off by " << off;
  }
}

TEST(Oscillator, IsTheIntegralOfItsForces) {
  for (const long double c : {0.0L, 2e-6L, 0.4L, 2.0L, 5.0L}) {
    const auto slope = [&](long double, const State& y, State& dy) {
      dy = {y[1], -3 * y[0] - c * y[1]};
    };
    const State y = integrated(slope, {1, 0.5L}, 8);
    const Swing exact = exact_swing(3, c, 1, {1, 0.5L}, 8);
    EXPECT_NEAR(static_cast<double>(exact.x - y[0]), 0, 1e-13) << "damping " << c;
    EXPECT_NEAR(static_cast<double>(exact.v - y[1]), 0, 1e-13) << "damping " << c;
  }
}

TEST(Oscillator, KeepsItsPhaseForAMillionPeriods) {
  // 3 is no square: after t = 2^40 the phase is 1.9e12. Going there in one go or by steps of a
  // quarter million, from state to state, must agree; and the energy stays.
  const long double end = 0x1p22L;
  Swing steps{1, 0};
  for (int i = 0; i < 16; ++i) steps = exact_swing(3, 0, 1, steps, end / 16);
  const Swing once = exact_swing(3, 0, 1, {1, 0}, end);
  EXPECT_NEAR(static_cast<double>(once.x - steps.x), 0, 1e-17);
  EXPECT_NEAR(static_cast<double>(once.v * once.v + 3 * once.x * once.x - 3), 0, 1e-18);
}

TEST(Chain, UniformModesAreThoseFoundByRotations) {
  const std::size_t n = 7;
  const State masses(n, 2), springs(n + 1, 50), springs_almost = [&] {
    State s(n + 1, 50);
    s[3] = 50 * (1 + 1e-18L);  // so that the formula is not used
    return s;
  }();
  State x(n, 0), v(n, 0);
  x[0] = 0.25L;
  v[5] = -1;
  const ChainMotion formula(masses, springs, x, v), rotations(masses, springs_almost, x, v);
  State xa, va, xb, vb;
  for (const long double t : {0.0L, 0.3L, 20.0L}) {
    formula.at(t, xa, va);
    rotations.at(t, xb, vb);
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_NEAR(static_cast<double>(xa[i] - xb[i]), 0, 1e-16) << "mass " << i << " at " << t;
      EXPECT_NEAR(static_cast<double>(va[i] - vb[i]), 0, 1e-15) << "mass " << i << " at " << t;
    }
  }
}

TEST(Chain, IsTheIntegralOfItsForcesWhenSpringsDiffer) {
  const State masses{1, 2, 0.5L}, springs{100, 3, 40};  // the last mass is free
  const auto slope = [&](long double, const State& y, State& dy) {
    for (std::size_t i = 0; i < 3; ++i) {
      const long double left = springs[i] * (y[i] - (i > 0 ? y[i - 1] : 0));
      const long double right = i < 2 ? springs[i + 1] * (y[i + 1] - y[i]) : 0;
      dy[i] = y[i + 3];
      dy[i + 3] = (right - left) / masses[i];
    }
  };
  const State y = integrated(slope, {0.1L, 0, 0, 0, 1, -1}, 5);
  State x, v;
  ChainMotion(masses, springs, {0.1L, 0, 0}, {0, 1, -1}).at(5, x, v);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(static_cast<double>(x[i] - y[i]), 0, 1e-12) << "mass " << i;
    EXPECT_NEAR(static_cast<double>(v[i] - y[i + 3]), 0, 1e-12) << "mass " << i;
  }
}

TEST(Chain, SlowModesKeepTheirDigitsBesideStiffSprings) {
  // Two masses on a spring of 1e8 between them move as one on the soft one: omega^2 is the smaller
  // root of m^2 w^4 - m (k1 + 2 k2) w^2 + k1 k2.
  const long double k1 = 1, k2 = 1e8L;
  const ChainMotion chain({1, 1}, {k1, k2}, {1, 1}, {0, 0});
  const long double b = k1 + 2 * k2;
  const long double fast = (b + std::sqrt(b * b - 4 * k1 * k2)) / 2, slow = k1 * k2 / fast;
  const auto [low, high] = std::minmax(chain.frequencies()[0], chain.frequencies()[1]);
  EXPECT_NEAR(static_cast<double>(low * low / slow), 1, 1e-17) << "the slow mode lost digits";
  EXPECT_NEAR(static_cast<double>(high * high / fast), 1, 1e-17);
}

void expect_orbit(const Orbit& start, long double time, double tolerance) {
  const auto slope = [](long double, const State& y, State& dy) {
    const long double r = std::sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2]);
    for (std::size_t i = 0; i < 3; ++i) {
      dy[i] = y[i + 3];
      dy[i + 3] = -2 * y[i] / (r * r * r);
    }
  };
  const auto [p, v] = start;
  const State y = integrated(slope, {p.x, p.y, p.z, v.x, v.y, v.z}, time);
  const Orbit exact = exact_orbit(2, start, time);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(static_cast<double>(exact.position[i] - y[i]), 0, tolerance) << "at " << time;
    EXPECT_NEAR(static_cast<double>(exact.velocity[i] - y[i + 3]), 0, tolerance) << "at " << time;
  }
}

TEST(Kepler, IsTheIntegralOfNewtonsLaw) {
  for (const long double time : {0.01L, 1.0L, 3.0L, 6.0L, 12.5L})
    expect_orbit({{1, 0.5L, -0.3L}, {-0.2L, 1.1L, 0.4L}}, time, 2e-13);
  const long double near = 0.1L, e = 0.9L;  // from the nearest point of a narrow ellipse on
  const long double speed = std::sqrt(2 * (1 + e) / near);
  for (const long double time : {0.001L, 0.1L, 2.0L, 4.3L})
    expect_orbit({{near, 0, 0}, {0, speed, 0}}, time, 2e-11);
}

TEST(Kepler, ReturnsAfterTenThousandPeriods) {
  for (const long double e : {0.0L, 0.6L, 0.9L}) {
    const Orbit start{{1 - e, 0, 0}, {0, std::sqrt((1 + e) / (1 - e)), 0}};
    const Orbit end = exact_orbit(1, start, 2 * kPi * 10000);
    // The end of the time itself is rounded, and so is the axis of a narrow ellipse.
    EXPECT_LT(static_cast<double>(glm::length(end.position - start.position)), 3e-12) << "e " << e;
    const long double half = glm::length(exact_orbit(1, start, kPi).position);
    EXPECT_NEAR(static_cast<double>(half - (1 + e)), 0, 1e-17) << "e " << e;
  }
}

TEST(Kepler, KeepsEnergyAndAngularMomentum) {
  const Orbit start{{0.1L, 0, 0}, {0, std::sqrt(19.0L), 0}};
  for (int i = 0; i < 500; ++i) {
    const Orbit now = exact_orbit(1, start, 0.0131L * i);
    const long double energy =
        glm::dot(now.velocity, now.velocity) / 2 - 1 / glm::length(now.position);
    EXPECT_NEAR(static_cast<double>(energy + 0.5L), 0, 3e-17) << "at " << i;
    const long double turn = glm::cross(now.position, now.velocity).z;
    EXPECT_NEAR(static_cast<double>(turn - std::sqrt(0.19L)), 0, 1e-17) << "at " << i;
  }
}

TEST(Kepler, RefusesWhatIsNoEllipse) {
  EXPECT_THROW(exact_orbit(1, {{1, 0, 0}, {0, 2, 0}}, 1), Refused) << "it flies away";
  EXPECT_THROW(exact_orbit(1, {{1, 0, 0}, {0.1L, 0, 0}}, 1), Refused) << "it falls in";
}

TEST(Pendulum, HasTheKnownPeriods) {
  const auto ratio = [](long double degrees) {
    const long double c = std::cos(degrees * kPi / 360);
    return static_cast<double>(4 * quarter_period(c * c) / (2 * kPi));
  };
  EXPECT_NEAR(ratio(90), 1.18034, 5e-6);
  EXPECT_NEAR(ratio(179), 3.90107, 5e-6);
  EXPECT_NEAR(ratio(179.9L), 5.36687, 5e-6);
}

TEST(Pendulum, IsTheIntegralOfItsForces) {
  const auto slope = [](long double, const State& y, State& dy) {
    dy = {y[1], -9 * std::sin(y[0])};
  };
  const long double top = 179.9L * kPi / 180;
  for (const PendulumState start : {PendulumState{0.001L, 0}, {1.5L, -0.7L}, {-2, 3}, {top, 0}})
    for (const long double time : {0.1L, 2.0L, 5.0L}) {
      const State y = integrated(slope, {start.angle, start.speed}, time);
      const PendulumState exact = exact_pendulum(3, start, time);
      EXPECT_NEAR(static_cast<double>(exact.angle - y[0]), 0, 1e-11) << "from " << start.angle;
      EXPECT_NEAR(static_cast<double>(exact.speed - y[1]), 0, 1e-11) << "from " << start.angle;
    }
  EXPECT_THROW(exact_pendulum(3, {0, 6.1L}, 1), Refused) << "it goes over the top";
}

LongVec spin_of(const State& y, const LongVec& inverse) {
  return LongVec(y[4], y[5], y[6]) * inverse;
}

// Angle between the exact orientation and that found by integrating Euler's equations.
double top_error(const LongVec& inertia, const LongVec& spin, long double time) {
  const LongVec inverse = 1.0L / inertia;
  const LongQuat start = glm::normalize(LongQuat(0.3L, -0.5L, 0.7L, 0.2L));
  const auto slope = [&](long double, const State& y, State& dy) {
    const LongVec w = spin_of(y, inverse), l(y[4], y[5], y[6]);
    const LongQuat q = LongQuat(y[0], y[1], y[2], y[3]) * LongQuat(0, w.x, w.y, w.z);
    const LongVec dl = glm::cross(l, w);
    dy = {q.w / 2, q.x / 2, q.y / 2, q.z / 2, dl.x, dl.y, dl.z};
  };
  const LongVec l = inertia * spin;
  const State y = integrated(slope, {start.w, start.x, start.y, start.z, l.x, l.y, l.z}, time);
  const FreeTop top(inverse, start, l);
  const LongQuat q = glm::normalize(LongQuat(y[0], y[1], y[2], y[3]));
  const LongQuat off = glm::conjugate(top.orientation(time)) * q;
  EXPECT_NEAR(static_cast<double>(glm::length(top.momentum(time) - LongVec(y[4], y[5], y[6]))), 0,
              1e-10);
  return static_cast<double>(
      2 * std::atan2(std::sqrt(off.x * off.x + off.y * off.y + off.z * off.z), std::abs(off.w)));
}

TEST(FreeTop, IsTheIntegralOfEulersEquations) {
  const LongVec inertias[] = {{1, 2, 3},    {3, 1, 2}, {2, 3, 1},    {1, 3, 2},
                              {3, 2, 1},    {2, 1, 3}, {1, 1, 0.2L}, {0.2L, 1, 1},
                              {1, 0.2L, 1}, {2, 2, 2}, {97, 82, 17}};
  const LongVec spins[] = {{0.1L, 2, 0.1L}, {2, 0.1L, -0.1L}, {-0.3L, 0.2L, -2}, {1, 1, 1},
                           {0, 1, 0.5L},    {0, 0, 1},        {0.1L, 5, 0.1L},   {1e-9L, 0, 1}};
  for (const LongVec& inertia : inertias)
    for (const LongVec& spin : spins)
      for (const long double time : {0.0L, 0.7L, 9.0L})
        EXPECT_LT(top_error(inertia, spin, time), 1e-10)
            << "inertia " << inertia.x << ' ' << inertia.y << ' ' << inertia.z << ", spin "
            << spin.x << ' ' << spin.y << ' ' << spin.z << ", time " << time;
}

TEST(FreeTop, KeepsItsMomentumInTheWorld) {
  const LongVec inertia(1, 1, 1e-4L), spin(0.3L, -0.2L, 50);
  const FreeTop top(1.0L / inertia, LongQuat(1, 0, 0, 0), inertia * spin);
  for (const long double time : {1.0L, 100.0L, 1e5L})
    EXPECT_LT(static_cast<double>(
                  glm::length(top.orientation(time) * top.momentum(time) - inertia * spin)),
              1e-15)
        << "at " << time;
}

}  // namespace
}  // namespace lantern::measure
