// Bodies that attract each other by Newton's law.
#include <cmath>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "physics/integrate/smooth_system.hpp"
#include "physics/world.hpp"
#include "smooth_scene.hpp"

namespace lantern::physics {
namespace {

WorldConfig<2> attracting(double gravitation, ContactMethod contacts) {
  WorldConfig<2> config;
  config.gravitation = gravitation;
  config.contacts = contacts;
  return config;
}

// Two on a circle about their centre, of masses 3 and 1 and a way of 1 between them.
SmoothScene<2> couple() {
  SmoothScene<2> scene;
  scene.forces.gravitation = 0.25;
  scene.add({-0.25, 0}, {0, -0.25}, 3);
  scene.add({0.75, 0}, {0, 0.75}, 1);
  return scene;
}

TEST(Attraction, PullsBothByBothMassesOverTheSquareOfTheWay) {
  SmoothScene<3> scene;
  scene.forces.gravitation = 2;
  scene.add({0, 0, 0}, {0, 0, 0}, 3);
  scene.add({0, 4, 3}, {0, 0, 0}, 5);
  SmoothSystem<3> system(scene.bodies, scene.forces, scene.evaluations);
  const Pull<3> pull = system.evaluate(system.start());
  EXPECT_NEAR(pull.acceleration[0].y, 2 * 5 / 25.0 * 0.8, 1e-15);
  EXPECT_NEAR(pull.acceleration[0].z, 2 * 5 / 25.0 * 0.6, 1e-15);
  EXPECT_NEAR(pull.acceleration[1].y, -2 * 3 / 25.0 * 0.8, 1e-15);
  EXPECT_EQ(scene.evaluations, 1u) << "attraction counts in the evaluation of all forces";
}

TEST(Attraction, AStaticBodyAttractsOnlyWithAMass) {
  for (const double mass : {0.0, 3.0}) {
    World<2> world(attracting(1, ContactMethod::none));
    Body<2> sun;
    sun.name = "sun";
    sun.shape = Sphere{0.1};
    sun.kind = BodyKind::static_body;
    sun.mass = mass;
    world.add(sun);
    Body<2> planet = sun;
    planet.kind = BodyKind::dynamic_body;
    planet.mass = 1;
    planet.position = {2, 0};
    const BodyId id = world.add(planet);
    world.step(0.125);
    EXPECT_NEAR(world.find(id)->velocity.x, -0.125 * mass / 4, 1e-15);
    EXPECT_EQ(world.bodies()[0].position, Vec<2>(0.0));
  }
}

TEST(Attraction, CentresThatCoincideDoNotPull) {
  for (const Integrator method : kAllIntegrators) {
    SmoothScene<3> scene;
    scene.forces.gravitation = 1;
    scene.add({1, 1, 1}, {0, 0, 0}, 1);
    scene.add({1, 1, 1}, {0, 0, 0}, 2);
    scene.step(method, 0.1);
    EXPECT_EQ(scene.bodies[0].velocity, Vec<3>(0.0)) << to_string(method);
    EXPECT_EQ(scene.energy().total(), 0) << to_string(method);
  }
}

TEST(Attraction, EveryMethodHasItsOrderOnACircle) {
  const double orders[] = {1, 1, 2, 4, 2, 1};
  const double time = 4.4;  // no half turn, where first order looks like second
  for (std::size_t m = 0; m < std::size(kAllIntegrators); ++m) {
    const auto error = [&](int steps) {
      SmoothScene<2> scene = couple();
      scene.run(kAllIntegrators[m], time / steps, steps);
      return glm::length(scene.bodies[1].position - 0.75 * Vec<2>(std::cos(time), std::sin(time)));
    };
    const int steps = orders[m] == 4 ? 100 : 4000;
    EXPECT_NEAR(std::log2(error(steps) / error(2 * steps)), orders[m], 0.1)
        << to_string(kAllIntegrators[m]);
  }
}

TEST(Attraction, MomentumAndEnergyAreKept) {
  SmoothScene<2> scene = couple();
  const double energy = scene.energy().total(), turn = angular_momentum<2>(scene.bodies);
  EXPECT_NEAR(energy, -0.375, 1e-15) << "half the potential energy, of a circle";
  scene.run(Integrator::implicit_midpoint, 0.05, 2000);
  EXPECT_LT(glm::length(momentum<2>(scene.bodies)), 1e-12);
  EXPECT_NEAR(angular_momentum<2>(scene.bodies), turn, 1e-11) << "implicit midpoint keeps it";
  EXPECT_NEAR(scene.energy().total(), energy, 1e-3);
}

TEST(Attraction, ActsAcrossIslandsThatTouch) {
  // Two that touch are moved as an island; the third, far away, still pulls them, and is pulled.
  World<2> world(attracting(1, ContactMethod::soft));
  Body<2> body;
  body.shape = Sphere{0.5};
  body.mass = 1;
  for (const double x : {0.0, 1.0, 10.0}) {
    body.position = {x, 0};
    world.add(body);
  }
  for (int i = 0; i < 10; ++i) world.step(0.01);
  const auto& bodies = world.bodies();
  EXPECT_LT(glm::length(momentum<2>(bodies)), 1e-12) << "what one gains the others must lose";
  EXPECT_NEAR(bodies[2].velocity.x, -0.1 * (1 / 100.0 + 1 / 81.0), 1e-5);
}

TEST(Attraction, RefusesAConstantThatIsNone) {
  for (const double bad : {-1.0, std::nan(""), HUGE_VAL})
    EXPECT_THROW(World<2>(attracting(bad, ContactMethod::none)), Refused) << bad;
}

}  // namespace
}  // namespace lantern::physics
