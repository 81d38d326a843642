// Joints keep the order of the method that moves what they hold.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "jointed_scene.hpp"

namespace lantern::physics {
namespace {

template <int D>
using Make = std::function<World<D>(Integrator)>;

template <int D>
double distance(const World<D>& a, const World<D>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.bodies().size(); ++i)
    most = std::max(most, glm::length(a.bodies()[i].position - b.bodies()[i].position));
  return most;
}

// From one halving of the step to the next, over four of them, against a fine run of order 4.
template <int D>
void expect_order(const Make<D>& make, Integrator integrator, double order, double seconds,
                  int steps) {
  World<D> fine = make(Integrator::runge_kutta_4);
  run(fine, seconds, seconds / (steps * 64));
  double first = 0, last = 0;
  for (int halvings = 0; halvings <= 4; ++halvings) {
    World<D> world = make(integrator);
    run(world, seconds, seconds / (steps << halvings));
    last = distance(world, fine);
    if (halvings == 0) first = last;
    EXPECT_LE(widest_gap(world), 1e-11);
  }
  EXPECT_NEAR(std::log2(first / last) / 4, order, 0.1) << to_string(integrator);
}

template <int D>
void expect_orders(const Make<D>& make, double seconds) {
  expect_order<D>(make, Integrator::velocity_verlet, 2, seconds, 40);
  expect_order<D>(make, Integrator::semi_implicit_euler, 2, seconds, 40);
  expect_order<D>(make, Integrator::implicit_midpoint, 2, seconds, 20);
  expect_order<D>(make, Integrator::runge_kutta_4, 4, seconds, 20);
}

TEST(JointOrders, PendulumOnARod) { expect_orders<2>(rod_pendulum, 0.5); }
TEST(JointOrders, PendulumOnAPin) {
  expect_orders<2>([](auto i) { return planks(i, 1); }, 0.5);
}
TEST(JointOrders, DoublePendulum) {
  expect_orders<2>([](auto i) { return planks(i, 2); }, 0.5);
}
TEST(JointOrders, Chain) {
  expect_orders<2>([](auto i) { return planks(i, 4); }, 0.4);
}
TEST(JointOrders, ClosedLoop) { expect_orders<2>(four_bars, 0.4); }
TEST(JointOrders, BoxOnABallJoint) { expect_orders<3>(spherical_pendulum, 0.4); }

TEST(JointOrders, DampedSpringsBesideJoints) {
  expect_orders<2>(
      [](Integrator integrator) {
        World<2> world = planks(integrator, 2);
        Spring<2> spring{.a = 0, .b = 2, .at_b = {1, 0}, .rest_length = 3, .stiffness = 20};
        spring.damping = 2;
        world.add_spring(spring);
        return world;
      },
      0.4);
}

TEST(JointOrders, EulersHaveOne) {
  for (const Integrator integrator : {Integrator::explicit_euler, Integrator::implicit_euler})
    expect_order<2>([](auto i) { return planks(i, 2); }, integrator, 1, 0.4, 40);
}

}  // namespace
}  // namespace lantern::physics
