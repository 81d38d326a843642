#include <cmath>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "smooth_scene.hpp"

namespace lantern {
namespace {

// Mass 1 on a spring of rest length 2 between an anchor at 0 and x = 2 + `stretch`, along x.
SmoothScene<2> oscillator(double omega, double zeta, double stretch) {
  SmoothScene<2> scene;
  const BodyId anchor = scene.add({0, 0}, {0, 0}, 0);
  const BodyId mass = scene.add({2 + stretch, 0}, {0, 0}, 1);
  scene.forces.springs.push_back(
      {anchor, mass, {0, 0}, {0, 0}, 2, omega * omega, 2 * zeta * omega});
  return scene;
}

TEST(Integrators, NamesAreReadBack) {
  for (const Integrator method : kAllIntegrators)
    EXPECT_EQ(integrator_named(to_string(method)), method);
  EXPECT_FALSE(integrator_named("euler"));
}

TEST(Integrators, TheCountedWorkIsThatOfTheMethod) {
  const auto work = [](Integrator method, double zeta) {
    SmoothScene<2> scene = oscillator(1, zeta, 0.1);
    scene.run(method, 0.1, 10);
    return scene.evaluations;
  };
  for (const double zeta : {0.0, 0.5}) {
    EXPECT_EQ(work(Integrator::explicit_euler, zeta), 10u);
    EXPECT_EQ(work(Integrator::semi_implicit_euler, zeta), 10u);
    EXPECT_EQ(work(Integrator::velocity_verlet, zeta), 20u);
    EXPECT_EQ(work(Integrator::runge_kutta_4, zeta), 40u);
    // The forces are linear here: one Newton step, and a look that it was enough.
    EXPECT_EQ(work(Integrator::implicit_midpoint, zeta), 20u);
    EXPECT_EQ(work(Integrator::implicit_euler, zeta), 20u);
  }
}

}  // namespace
}  // namespace lantern
