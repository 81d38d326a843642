// What one step does to a damped spring, against the methods' own formulas.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/stop.hpp"
#include "measure/stress.hpp"

namespace lantern::measure {
namespace {

constexpr Integrator kAll[] = {Integrator::explicit_euler,    Integrator::semi_implicit_euler,
                               Integrator::velocity_verlet,   Integrator::runge_kutta_4,
                               Integrator::implicit_midpoint, Integrator::implicit_euler};

// For a linear problem y' = A y with eigenvalue l, explicit Euler multiplies by 1 + hl, implicit
// Euler by 1/(1 - hl), the midpoint by (1 + hl/2)/(1 - hl/2). Without damping hl = i w.
TEST(StabilityMap, UndampedGrowthIsThatOfTheFormulas) {
  for (const double w : {0.01, 0.3, 1.0, 3.0, 100.0}) {
    EXPECT_NEAR(measured_growth(Integrator::explicit_euler, w, 0) / std::sqrt(1 + w * w), 1, 1e-13);
    EXPECT_NEAR(measured_growth(Integrator::implicit_euler, w, 0) * std::sqrt(1 + w * w), 1, 1e-11);
    EXPECT_NEAR(measured_growth(Integrator::implicit_midpoint, w, 0), 1, 1e-12) << w;
    const double w2 = w * w;
    const double squared = 1 - w2 * w2 * w2 / 72 + w2 * w2 * w2 * w2 / 576;
    EXPECT_NEAR(measured_growth(Integrator::runge_kutta_4, w, 0) / std::sqrt(squared), 1, 1e-12);
  }
  for (const double w : {0.1, 1.0, 1.9}) {
    EXPECT_NEAR(measured_growth(Integrator::velocity_verlet, w, 0), 1, 1e-13) << "within its limit";
    EXPECT_NEAR(measured_growth(Integrator::semi_implicit_euler, w, 0), 1, 1e-13) << w;
  }
}

// Critical damping: a double eigenvalue -w.
TEST(StabilityMap, CriticalGrowthIsThatOfTheFormulas) {
  for (const double w : {0.1, 0.7, 5.0}) {  // a double eigenvalue keeps half of the digits
    EXPECT_NEAR(measured_growth(Integrator::explicit_euler, w, 1), std::abs(1 - w), 1e-7);
    EXPECT_NEAR(measured_growth(Integrator::implicit_euler, w, 1), 1 / (1 + w), 1e-7);
  }
}

TEST(StabilityMap, LimitsAreThoseOfTheory) {
  EXPECT_EQ(stability_limit(Integrator::explicit_euler, 0), 0) << "never stable undamped";
  EXPECT_EQ(stability_limit(Integrator::explicit_euler, 0.25), 0.5);
  EXPECT_EQ(stability_limit(Integrator::explicit_euler, 1), 2);
  EXPECT_NEAR(stability_limit(Integrator::explicit_euler, 1.25), 1, 1e-15) << "2 (zeta - sqrt)";
  EXPECT_NEAR(stability_limit(Integrator::semi_implicit_euler, 0), 2, 1e-15);
  EXPECT_NEAR(stability_limit(Integrator::semi_implicit_euler, 0.75), 1, 1e-15);
  EXPECT_EQ(stability_limit(Integrator::velocity_verlet, 1e3), 2);
  EXPECT_NEAR(stability_limit(Integrator::runge_kutta_4, 0), 2 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(stability_limit(Integrator::runge_kutta_4, 1), 2.785, 1e-3);
  EXPECT_NEAR(stability_limit(Integrator::runge_kutta_4, 1.25) * 2, 2.785, 1e-3)
      << "the faster of two decays counts";
  for (const auto method : {Integrator::implicit_midpoint, Integrator::implicit_euler})
    EXPECT_TRUE(std::isinf(stability_limit(method, 0)));
}

// Much closer than the map's cells are: both sides of each limit.
TEST(StabilityMap, MeasuredAndTheoreticalLimitsAreOne) {
  for (const Integrator method : kAll)
    for (const double zeta : {0.0, 1e-3, 0.03, 0.3, 0.9, 1.0, 1.1, 3.0, 30.0, 1e3}) {
      const double limit = stability_limit(method, zeta);
      if (std::isinf(limit)) {
        for (double w = 0.001; w < 1e4; w *= 10)
          EXPECT_FALSE(grows(measured_growth(method, w, zeta))) << to_string(method) << " " << w;
        continue;
      }
      if (limit > 0) {
        EXPECT_FALSE(grows(measured_growth(method, 0.999 * limit, zeta)))
            << to_string(method) << " grows below its limit at zeta " << zeta;
      }
      EXPECT_TRUE(grows(measured_growth(method, limit > 0 ? 1.001 * limit : 1e-3, zeta)))
          << to_string(method) << " does not grow beyond its limit at zeta " << zeta;
    }
}

TEST(StabilityMap, EveryCellIsOnItsSideOfTheLimit) {
  const StabilityMap map = make_stability_map();
  ASSERT_EQ(map.panels.size(), 6u);
  std::size_t growing = 0;
  for (const StabilityMap::Panel& panel : map.panels) {
    ASSERT_EQ(panel.growth.size(), map.omega_h.size() * map.zeta.size());
    for (std::size_t row = 0; row < map.zeta.size(); ++row)
      for (std::size_t column = 0; column < map.omega_h.size(); ++column) {
        const bool expected = map.omega_h[column] > stability_limit(panel.method, map.zeta[row]);
        growing += expected;
        EXPECT_EQ(grows(map.growth_at(panel, column, row)), expected)
            << to_string(panel.method) << ", omega h " << map.omega_h[column] << ", zeta "
            << map.zeta[row];
      }
  }
  EXPECT_GT(growing, 1000u) << "nothing grows: no test";
  EXPECT_EQ(map.zeta.front(), 0);
  EXPECT_GT(map.omega_h.front(), map.omega_low);
  EXPECT_LT(map.omega_h.back(), map.omega_high);
}

TEST(StabilityMap, EndsWhenToldTo) {
  ask_to_stop();
  EXPECT_THROW(make_stability_map(), Stopped);
  forget_stop();
}

}  // namespace
}  // namespace lantern::measure
