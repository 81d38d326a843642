// The limits of stability on both sides, and stiff springs.
#include <cmath>
#include <complex>
#include <string>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/random.hpp"
#include "smooth_scene.hpp"

namespace lantern::physics {
namespace {

// A spring of no rest length, so that the force is linear however far it swings.
SmoothScene<2> linear_oscillator(double omega, double zeta) {
  SmoothScene<2> scene;
  scene.add({0, 0}, {0, 0}, 0);
  scene.add({1, 0}, {0, 0}, 1);
  scene.forces.springs.push_back({0, 1, {0, 0}, {0, 0}, 0, omega * omega, 2 * zeta * omega});
  return scene;
}

// The farthest that the mass, which starts at 1, comes within the steps; stops beyond 1e6.
double farthest(Integrator method, double omega_h, double zeta, int steps) {
  SmoothScene<2> scene = linear_oscillator(1, zeta);
  double far = 0;
  for (int i = 0; i < steps && far < 1e6; ++i) {
    scene.step(method, omega_h);
    far = std::max(far, std::abs(scene.bodies[1].position.x));
  }
  return far;
}

// Where |1 + z + z^2/2 + z^3/6 + z^4/24| passes 1, for z = omega h (-zeta +- i sqrt(1 - zeta^2)).
double runge_kutta_limit(double zeta) {
  const std::complex<double> way{-zeta, std::sqrt(1 - zeta * zeta)};
  const auto grows = [&](double r) {
    const auto z = r * way;
    return std::abs(1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0)))) > 1;
  };
  double lo = 2.5, hi = 4;
  for (int i = 0; i < 60; ++i) (grows((lo + hi) / 2) ? hi : lo) = (lo + hi) / 2;
  return lo;
}

void expect_limit(Integrator method, double zeta, double limit, int steps = 20000) {
  EXPECT_LT(farthest(method, 0.99 * limit, zeta, steps), 100)
      << to_string(method) << " is not stable below its limit, zeta " << zeta;
  EXPECT_GT(farthest(method, 1.01 * limit, zeta, steps), 1e4)
      << to_string(method) << " does not grow beyond its limit, zeta " << zeta;
}

TEST(Stability, SemiImplicitEuler) {
  for (const double zeta : {0.0, 0.1, 1.0})
    expect_limit(Integrator::semi_implicit_euler, zeta, 2 * (std::sqrt(1 + zeta * zeta) - zeta));
}

TEST(Stability, VelocityVerlet) {
  for (const double zeta : {0.0, 0.1, 1.0, 10.0})
    expect_limit(Integrator::velocity_verlet, zeta, 2);
  EXPECT_LT(farthest(Integrator::velocity_verlet, 1.98, 1e3, 5000), 100);
}

TEST(Stability, RungeKutta) {
  EXPECT_NEAR(runge_kutta_limit(0), 2 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(runge_kutta_limit(1), 2.785, 1e-3);
  for (const double zeta : {0.0, 0.1, 1.0})
    expect_limit(Integrator::runge_kutta_4, zeta, runge_kutta_limit(zeta));
}

TEST(Stability, ExplicitEuler) {
  for (const double zeta : {0.1, 1.0})
    expect_limit(Integrator::explicit_euler, zeta, 2 * zeta, 60000);
  // Undamped, each step multiplies the energy by 1 + (omega h)^2.
  SmoothScene<2> scene = linear_oscillator(3, 0);
  const double before = scene.energy().total();
  scene.run(Integrator::explicit_euler, 0.01, 1000);
  EXPECT_NEAR(scene.energy().total() / before / std::pow(1 + 0.03 * 0.03, 1000), 1, 1e-10);
}

TEST(Stability, ImplicitEulerDividesTheEnergy) {
  SmoothScene<2> scene = linear_oscillator(3, 0);
  const double before = scene.energy().total();
  scene.run(Integrator::implicit_euler, 0.01, 1000);
  EXPECT_NEAR(scene.energy().total() / before * std::pow(1 + 0.03 * 0.03, 1000), 1, 1e-10);
}

// k/m = 1e6 ... 1e10 at 1/60 s: omega h from 17 to 1700.
TEST(Stability, ImplicitMethodsTakeStiffSprings) {
  for (const double stiffness : {1e6, 1e8, 1e10}) {
    for (const double zeta : {0.0, 1e-6, 1.0, 1e3}) {
      for (const auto method : {Integrator::implicit_midpoint, Integrator::implicit_euler}) {
        SmoothScene<2> scene = linear_oscillator(std::sqrt(stiffness), zeta);
        scene.forces.springs[0].rest_length = 0.75;
        const double before = scene.energy().total();
        for (int i = 0; i < 600; ++i) {
          scene.step(method, 1.0 / 60);
          ASSERT_LE(scene.energy().total(), before * (1 + 1e-11))
              << to_string(method) << " k/m " << stiffness << " zeta " << zeta << " step " << i;
        }
      }
    }
  }
}

// Off any axis, and of no rest length: linear in the plane.
TEST(Stability, MidpointKeepsTheEnergyOfLinearSprings) {
  for (const double stiffness : {1e0, 1e6, 1e10}) {
    SmoothScene<2> scene = linear_oscillator(std::sqrt(stiffness), 0);
    scene.bodies[1].position = {0.6, -0.7};
    scene.bodies[1].velocity = {0.3, 0.2};
    const double before = scene.energy().total();
    double worst = 0;
    for (int i = 0; i < 2000; ++i) {
      scene.step(Integrator::implicit_midpoint, 1.0 / 60);
      worst = std::max(worst, std::abs(scene.energy().total() / before - 1));
    }
    // A step moves by h v, of which most cancels: rounding grows with omega h.
    EXPECT_LT(worst, 1e-13 * std::max(1.0, std::sqrt(stiffness) / 60)) << "k/m " << stiffness;
  }
}

// A rope of 1000 masses, soft and hard springs by turns, that falls from the level. The midpoint's
// energy is exact only for linear springs: here it creeps up once the rope swings.
TEST(Stability, ALongChainOfUnequalSpringsStaysBounded) {
  for (const auto method : {Integrator::implicit_midpoint, Integrator::implicit_euler}) {
    SmoothScene<2> scene;
    scene.forces.gravity = {0, -10};
    for (int i = 0; i <= 1000; ++i) scene.add({0.1 * i, 0}, {0, 0}, i == 0 ? 0 : 1);
    for (BodyId i = 0; i < 1000; ++i)
      scene.forces.springs.push_back({i, i + 1, {0, 0}, {0, 0}, 0.1, i % 2 == 0 ? 1e2 : 1e10, 0});
    double before = scene.energy().total();
    for (int i = 0; i < (method == Integrator::implicit_euler ? 40 : 10); ++i) {
      scene.step(method, 1.0 / 60);
      const double after = scene.energy().total();
      ASSERT_LT(after, before + 1) << to_string(method) << " step " << i;
      before = after;
    }
  }
}

// Nets of stiff springs between points chosen by chance, stretched and compressed by up to 1 %.
TEST(Stability, StiffNetsFindTheirStep) {
  Random random(7);
  for (int round = 0; round < 40; ++round) {
    SmoothScene<2> scene;
    const double stiffness = 100 * std::ldexp(1.0, static_cast<int>(random.whole(0, 26)));
    for (int i = 0; i < 12; ++i)
      scene.add({random.between(-1, 1), random.between(-1, 1)}, {random.between(-5, 5), 0},
                i == 0 ? 0 : random.between(0.1, 2));
    for (BodyId i = 0; i < 12; ++i)
      for (BodyId j = i + 1; j < 12; ++j)
        if (random.unit() < 0.4) {
          const double length = glm::length(scene.bodies[j].position - scene.bodies[i].position);
          const double rest = length * random.between(0.99, 1.01);
          scene.forces.springs.push_back({i, j, {0, 0}, {0, 0}, rest, stiffness, round % 3 * 10.0});
        }
    double before = scene.energy().total();
    for (int i = 0; i < 20; ++i) {
      ASSERT_NO_THROW(scene.step(Integrator::implicit_euler, 1.0 / 60))
          << "round " << round << " step " << i << " k " << stiffness;
      const double after = scene.energy().total();
      ASSERT_LE(after, before * (1 + 1e-9)) << "round " << round << " step " << i;
      before = after;
    }
  }
}

// Springs far shorter than they want to be, off the bodies' centres, have solutions that no method
// may find; then the step is refused by name, and neither hangs nor gives what is no number.
TEST(Stability, WhatDoesNotConvergeIsRefused) {
  Random random(11);
  int refused = 0;
  for (int round = 0; round < 3; ++round) {
    SmoothScene<3> scene;
    for (int i = 0; i < 8; ++i)
      scene.add({random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)}, Vec<3>(0.0),
                1, 0.1);
    for (BodyId i = 0; i + 1 < 8; ++i)
      for (BodyId j = i + 1; j < 8; ++j)
        scene.forces.springs.push_back({i, j, {0.1, 0.2, 0}, {0, 0, 0.1}, 3, 1e8, 0});
    try {
      scene.run(Integrator::implicit_euler, 1.0 / 60, 3);
      for (const Body<3>& body : scene.bodies) EXPECT_TRUE(std::isfinite(body.position.x));
    } catch (const Refused& error) {
      EXPECT_NE(std::string(error.what()).find("implicit_euler"), std::string::npos);
      ++refused;
    }
  }
  EXPECT_GT(refused, 0) << "nothing was hard enough to be a test";
}

}  // namespace
}  // namespace lantern::physics
