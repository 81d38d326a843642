// What is kept and what is not; and bodies that springs turn.
#include <cmath>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "smooth_scene.hpp"

namespace lantern::physics {
namespace {

// Two bodies that a spring off their centres joins, turns and swings.
template <int D>
SmoothScene<D> pair_of_bodies() {
  SmoothScene<D> scene;
  Vec<D> x(0.0), v(0.0), at_a(0.0), at_b(0.0);
  v[0] = 0.3, v[1] = 0.5, at_a[0] = 0.2, at_a[D - 1] = 0.3, at_b[1] = -0.4;
  scene.add(x, v, 1, 0.2);
  x[0] = 2, x[1] = 0.5, v[D - 1] = -0.7;
  scene.add(x, v, 3, 0.5);
  if constexpr (D == 3) {
    scene.bodies[0].inverse_inertia = {5, 3, 2};
    scene.bodies[1].angular_momentum = {0.1, 0.3, -0.2};
  }
  scene.forces.springs.push_back({0, 1, at_a, at_b, 1.5, 8, 0});
  return scene;
}

TEST(Energy, IsTheSumOfItsParts) {
  SmoothScene<2> scene;
  scene.add({1, 2}, {3, 4}, 2, 4);
  scene.bodies[0].angular_momentum = 6;
  scene.add({5, 2}, {0, 0}, 0);
  scene.forces.gravity = {0, -10};
  scene.forces.springs.push_back({0, 1, {0, 0}, {0, 0}, 1, 8, 0});
  const Energy e = scene.energy();
  EXPECT_DOUBLE_EQ(e.linear, 25);
  EXPECT_DOUBLE_EQ(e.rotational, 4.5);
  EXPECT_DOUBLE_EQ(e.gravity, 40);
  EXPECT_DOUBLE_EQ(e.springs, 36);
  EXPECT_DOUBLE_EQ(e.kinetic(), 29.5);
  EXPECT_DOUBLE_EQ(e.total(), 105.5);
  EXPECT_EQ(momentum<2>(scene.bodies), Vec<2>(6, 8));
  EXPECT_DOUBLE_EQ(angular_momentum<2>(scene.bodies), 2 * (1 * 4 - 2 * 3) + 6);
  scene.forces.springs[0].b = 9;
  EXPECT_THROW(scene.energy(), Refused);
}

template <int D>
double size_of(const Vec<D>& v) {
  return glm::length(v);
}
double size_of(double v) { return std::abs(v); }

template <int D>
void expect_kept_momentum() {
  for (const Integrator method : kAllIntegrators) {
    SmoothScene<D> scene = pair_of_bodies<D>();
    const Vec<D> p = momentum<D>(scene.bodies);
    const Spin<D> l = angular_momentum<D>(scene.bodies);
    scene.run(method, 0.01, 1000);
    EXPECT_LT(size_of<D>(momentum<D>(scene.bodies) - p), 1e-12) << to_string(method);
    // Kicks from one place along one line keep the angular momentum whatever the step.
    if (method == Integrator::semi_implicit_euler || method == Integrator::velocity_verlet) {
      EXPECT_LT(size_of(angular_momentum<D>(scene.bodies) - l), 1e-12) << to_string(method);
    }
  }
}
TEST(Energy, ASpringKeepsMomentum2) { expect_kept_momentum<2>(); }
TEST(Energy, ASpringKeepsMomentum3) { expect_kept_momentum<3>(); }

// With the lag, bodies that springs turn are followed to second order.
template <int D>
void expect_second_order() {
  const auto end = [](Integrator method, int steps) {
    SmoothScene<D> scene = pair_of_bodies<D>();
    scene.run(method, 2.0 / steps, steps);
    return scene.bodies[1].position;
  };
  const Vec<D> exact = end(Integrator::velocity_verlet, 1 << 14);
  for (const auto method :
       {Integrator::velocity_verlet, Integrator::implicit_midpoint, Integrator::runge_kutta_4}) {
    const double coarse = size_of<D>(end(method, 128) - exact);
    const double fine = size_of<D>(end(method, 256) - exact);
    EXPECT_GT(std::log2(coarse / fine), 1.9) << to_string(method);
  }
}
TEST(Energy, TurningBodiesAreOfSecondOrder2) { expect_second_order<2>(); }
TEST(Energy, TurningBodiesAreOfSecondOrder3) { expect_second_order<3>(); }

// Verlet is symplectic: energy swings but does not drift.
TEST(Energy, VerletDoesNotDrift) {
  SmoothScene<3> scene = pair_of_bodies<3>();
  const double before = scene.energy().total();
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    scene.step(Integrator::velocity_verlet, 0.01);
    worst = std::max(worst, std::abs(scene.energy().total() / before - 1));
  }
  EXPECT_LT(worst, 1e-2);
}

// A rod that hangs by its end on a spring as stiff as a joint: implicit Euler loses its swing, yet
// the joint stays closed. The midpoint, which damps nothing, lets the stiffest ones ring.
TEST(Energy, AStiffJointHoldsATurningBody) {
  for (const double stiffness : {1e4, 1e6, 1e8, 1e10}) {
    for (const auto method : {Integrator::implicit_euler, Integrator::implicit_midpoint}) {
      if (method == Integrator::implicit_midpoint && stiffness > 1e6) continue;
      SmoothScene<2> scene;
      scene.add({0, 0}, {0, 0}, 0);
      scene.add({0.5, 0}, {0, 0}, 1, 1.0 / 12);
      scene.forces.gravity = {0, -10};
      scene.forces.springs.push_back({0, 1, {0, 0}, {-0.5, 0}, 0, stiffness, 0});
      for (int i = 0; i < 300; ++i) {
        scene.step(method, 1.0 / 60);
        const Body<2>& rod = scene.bodies[1];
        const Vec<2> end = rod.position + matrix(rod.orientation) * Vec<2>(-0.5, 0);
        ASSERT_LT(glm::length(end), 0.1)
            << to_string(method) << " k " << stiffness << " step " << i;
      }
    }
  }
}

}  // namespace
}  // namespace lantern::physics
