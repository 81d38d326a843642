#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "smooth_scene.hpp"
#include "world_scene.hpp"

namespace lantern::physics {
namespace {

template <int D>
Scratch<Increment<D>> increments(SmoothScene<D>& scene, Integrator method, double h) {
  Scratch<Increment<D>> all;
  find_increments<D>(method, scene.bodies, scene.forces, h, all, scene.evaluations);
  return all;
}

TEST(Forces, ASpringPullsAlongTheLineBetweenItsPoints) {
  const Spring<2> spring{0, 1, {1, 0}, {0, -1}, 2, 10, 3};
  const EndMotion<2> a{{std::acos(0.0)}, {0, 0}, 2};  // turned by a quarter: its point is at (0, 1)
  const EndMotion<2> b{{0}, {1, 0}, 0};
  const Stretch<2> s = stretched<2>(spring, {5, 2}, a, b);  // b's point is at (5, 1)
  EXPECT_NEAR(s.length, 5, 1e-15);
  EXPECT_NEAR(s.direction.x, 1, 1e-15);
  EXPECT_NEAR(s.rate, 1 + 2, 1e-14) << "the turning point of a runs to the left at 2";
  EXPECT_NEAR(s.tension, 10 * 3 + 3 * 3, 1e-13);
}

TEST(Forces, ASpringOfNoLengthPullsNothing) {
  for (const Integrator method : kAllIntegrators) {
    SmoothScene<3> scene;
    scene.add({1, 1, 1}, {0, 0, 0}, 0);
    scene.add({1, 1, 1}, {0, 0, 0}, 2);
    scene.forces.springs.push_back({0, 1, {0, 0, 0}, {0, 0, 0}, 1, 50, 5});
    EXPECT_EQ(increments(scene, method, 0.1)[1].kick, Vec<3>(0.0)) << to_string(method);
  }
}

TEST(Forces, APushTurnsByItsLever) {
  for (const Integrator method : kAllIntegrators) {
    SmoothScene<2> scene;
    scene.add({3, 3}, {0, 0}, 2, 5);
    scene.forces.pushes.push_back({0, {0.5, 0}, {0, 4}});
    const auto all = increments(scene, method, 0.25);
    EXPECT_NEAR(all[0].kick.y, 0.5, 1e-15) << to_string(method);
    EXPECT_NEAR(all[0].twist, 0.5, 1e-15) << to_string(method);
    scene.bodies[0].may_turn = false;
    EXPECT_EQ(increments(scene, method, 0.25)[0].twist, 0) << to_string(method);
  }
}

TEST(Forces, AngularDragSlowsTheTurning) {
  const auto error = [](Integrator method, int steps) {
    SmoothScene<3> scene;
    scene.add({0, 0, 0}, {0, 0, 0}, 1, 2);
    scene.bodies[0].angular_drag = 3;
    scene.bodies[0].angular_momentum = {1, 2, 2};
    scene.run(method, 1.0 / steps, steps);
    const double left = std::exp(-1.5);
    return glm::length(scene.bodies[0].angular_momentum - Vec<3>(1, 2, 2) * left);
  };
  for (const Integrator method : kAllIntegrators) {
    const double order =
        method == Integrator::runge_kutta_4                                                ? 4
        : method == Integrator::velocity_verlet || method == Integrator::implicit_midpoint ? 2
                                                                                           : 1;
    EXPECT_NEAR(std::log2(error(method, 32) / error(method, 64)), order, 0.1) << to_string(method);
  }
}

TEST(Forces, NamesWhatCannotBeApplied) {
  World<2> world;
  for (const double x : {0.0, 1.0}) world.add(ball_at<2>({x, 0}));
  const Spring<2> good{0, 1, {0, 0}, {0, 0}, 1, 10, 1};
  EXPECT_EQ(world.add_spring(good), 0u);

  const auto refuses = [&](const std::string& text, auto&& spoil) {
    Spring<2> bad = good;
    spoil(bad);
    try {
      world.add_spring(bad);
      ADD_FAILURE() << "accepted, though " << text;
    } catch (const Refused& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  refuses("spring 1: stiffness", [&](auto& spring) { spring.stiffness = -1; });
  refuses("spring 1: damping", [&](auto& spring) { spring.damping = inf; });
  refuses("spring 1: rest_length", [&](auto& spring) { spring.rest_length = nan; });
  refuses("spring 1: at_b", [&](auto& spring) { spring.at_b.x = inf; });
  refuses("there is no body 7", [&](auto& spring) { spring.a = 7; });
  refuses("both ends are on body 1", [&](auto& spring) { spring.a = 1; });
  EXPECT_EQ(world.add_spring(good), 1u) << "a refusal takes no id";
}

TEST(Forces, ASpringOnNoBodyIsRefused) {
  SmoothScene<2> scene;
  scene.add({0, 0}, {0, 0}, 1);
  scene.forces.springs.push_back({0, 5, {0, 0}, {0, 0}, 1, 10, 1});
  EXPECT_THROW(increments(scene, Integrator::runge_kutta_4, 0.1), Refused);
}

// Ids with gaps, bodies in any order: the same increments.
TEST(Forces, BodiesAreFoundByTheirIds) {
  SmoothScene<2> scene;
  for (int i = 0; i < 4; ++i) scene.add({1.5 * i, 0.1 * i * i}, {0, 0}, 1 + i, 1);
  for (BodyId i = 0; i < 3; ++i)
    scene.forces.springs.push_back({i, i + 1, {0.2, 0.1}, {0, 0}, 1, 10, 1});
  const auto expected = increments(scene, Integrator::implicit_euler, 0.1);
  SmoothScene<2> other = scene;
  for (Body<2>& body : other.bodies) body.id = 5 + 3 * body.id;
  for (Spring<2>& spring : other.forces.springs) {
    spring.a = 5 + 3 * spring.a;
    spring.b = 5 + 3 * spring.b;
  }
  std::swap(other.bodies[0], other.bodies[2]);
  auto all = increments(other, Integrator::implicit_euler, 0.1);
  std::swap(all[0], all[2]);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(all[i].kick.x, expected[i].kick.x, 1e-14);
    EXPECT_NEAR(all[i].twist, expected[i].twist, 1e-14);
  }
}

}  // namespace
}  // namespace lantern::physics
