// The methods for forces that follow from places alone: Kahan and Li's, Dormand and Prince's.
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "exact_oscillator.hpp"
#include "physics/integrate/dormand_prince.hpp"
#include "physics/integrate/smooth_system.hpp"
#include "physics/world.hpp"
#include "smooth_scene.hpp"

namespace lantern::physics {
namespace {

constexpr double kHalfCircle = std::numbers::pi;
constexpr double kEccentricity = 0.3;
constexpr std::pair<Integrator, int> kOrdersOfPlaces[] = {{Integrator::kahan_li_8, 8},
                                                          {Integrator::dormand_prince, 5}};

// A planet in its perihelion, at a mean distance of 1 of a sun of mass 1, whose orbit takes 2 pi
// seconds. In space its plane is tilted.
template <int D>
World<D> orbit(Integrator method) {
  World<D> world({.gravitation = 1, .integrator = method, .contacts = ContactMethod::none});
  Body<D> sun;
  sun.shape = Sphere{0.1};
  sun.kind = BodyKind::static_body;
  sun.mass = 1;
  world.add(sun);
  Body<D> planet;
  planet.shape = Sphere{0.1};
  planet.mass = 1;
  planet.position[0] = 1 - kEccentricity;
  const double speed = std::sqrt((1 + kEccentricity) / (1 - kEccentricity));
  planet.velocity[1] = D == 2 ? speed : 0.6 * speed;
  if (D == 3) planet.velocity[D - 1] = 0.8 * speed;
  world.add(planet);
  return world;
}

// The larger of those of place and velocity, after whole orbits.
template <int D>
double error_of(Integrator method, int steps, double orbits = 2,
                std::uint64_t* evaluations = nullptr) {
  World<D> world = orbit<D>(method);
  const Body<D> start = world.bodies()[1];
  for (int i = 0; i < steps; ++i) world.step(orbits * 2 * kHalfCircle / steps);
  if (evaluations) *evaluations = world.work().force_evaluations;
  const Body<D>& end = world.bodies()[1];
  return std::max(glm::length(end.position - start.position),
                  glm::length(end.velocity - start.velocity));
}

TEST(PositionMethods, TwoOrbitsToTenDigitsTakeFewEvaluations) {
  std::uint64_t evaluations = 0;
  EXPECT_LT(error_of<2>(Integrator::kahan_li_8, 130, 2, &evaluations), 1e-10);
  EXPECT_EQ(evaluations, 130u * 17);
  EXPECT_LT(error_of<3>(Integrator::kahan_li_8, 130, 2, &evaluations), 1e-10);
  EXPECT_EQ(evaluations, 130u * 17);
  EXPECT_LT(error_of<2>(Integrator::dormand_prince, 1400, 2, &evaluations), 1e-10);
  EXPECT_EQ(evaluations, 1400u * 6);
  EXPECT_LT(error_of<3>(Integrator::dormand_prince, 1400), 1e-10);
}

TEST(PositionMethods, TheErrorOfAnOrbitFallsByTheOrder) {
  for (const auto& [method, order] : kOrdersOfPlaces) {
    EXPECT_EQ(integration(method).order, order);
    const int steps = order == 8 ? 80 : 640;
    const double coarse = error_of<2>(method, steps), fine = error_of<2>(method, 2 * steps);
    EXPECT_NEAR(std::log2(coarse / fine), order, 0.3) << to_string(method);
    const double solid = error_of<3>(method, steps);
    EXPECT_NEAR(solid / coarse, 1, 1e-3) << to_string(method);
  }
}

// Of the rows of the table: Butcher's conditions for trees without branches, and for bushes.
TEST(PositionMethods, TheTableMeetsItsConditions) {
  double tall[6] = {1, 1, 1, 1, 1, 1};
  double factorial = 1;
  const auto weight = [](int k) { return kDormandPrince[5][k] / double(kDormandPrince[5][6]); };
  const auto time = [](int k) { return k == 0 ? 0 : time_of_stage<double>(k - 1); };
  for (int order = 1; order <= 5; ++order) {
    factorial *= order;
    double chain = 0, bush = 0;
    for (int k = 0; k < 6; ++k) {
      chain += weight(k) * tall[k];
      bush += weight(k) * std::pow(time(k), order - 1);
    }
    EXPECT_NEAR(chain, 1 / factorial, 1e-14);
    EXPECT_NEAR(bush, 1.0 / order, 1e-14);
    for (int stage = 5; stage >= 0; --stage) {
      double next = 0;
      for (int k = 0; k < stage; ++k)
        next += kDormandPrince[stage - 1][k] / double(kDormandPrince[stage - 1][6]) * tall[k];
      tall[stage] = next;
    }
  }
}

TEST(PositionMethods, AnOscillatorIsThatOfItsFormula) {
  for (const auto& [method, order] : kOrdersOfPlaces) {
    SmoothScene<2> scene;
    const BodyId anchor = scene.add({0, 0}, {0, 0}, 0);
    const BodyId mass = scene.add({2.5, 0}, {0, 0}, 1);
    scene.forces.springs.push_back({anchor, mass, {0, 0}, {0, 0}, 2, 1, 0});
    scene.run(method, 0.01, 1000);
    const auto exact = exact_oscillator(1, 0, {0.5L, 0}, 10);
    EXPECT_NEAR(scene.bodies[1].position.x, static_cast<double>(2 + exact.x), 1e-12);
    EXPECT_NEAR(scene.bodies[1].velocity.x, static_cast<double>(exact.v), 1e-12);
  }
}

// Constant forces, and bodies that keep their way whatever pulls them: forces of time.
TEST(PositionMethods, AThrowAndATowedBodyAreExact) {
  for (const auto& [method, order] : kOrdersOfPlaces) {
    World<2> thrown({.gravity = {0, -10}, .integrator = method, .contacts = ContactMethod::none});
    Body<2> ball;
    ball.shape = Sphere{0.1};
    ball.velocity = {3, 4};
    ball.mass = 2;
    const BodyId id = thrown.add(ball);
    thrown.push(id, {4, 0}, {0, 0});
    for (int i = 0; i < 10; ++i) thrown.step(0.1);
    EXPECT_NEAR(thrown.bodies()[0].position.x, 4, 1e-14) << to_string(method);
    EXPECT_NEAR(thrown.bodies()[0].position.y, -1, 1e-14) << to_string(method);

    SmoothScene<2> towed;
    const BodyId tug = towed.add({0, 0}, {1, 0}, 0);
    towed.bodies[tug].kind = BodyKind::kinematic_body;
    const BodyId load = towed.add({-1, 0}, {0, 0}, 1);
    towed.forces.springs.push_back({tug, load, {0, 0}, {0, 0}, 1, 4, 0});
    towed.run(method, 0.01, 100);
    EXPECT_NEAR(towed.bodies[load].position.x, -1 + 1 - std::sin(2.0) / 2, 1e-11)
        << to_string(method);
  }
}

TEST(PositionMethods, KahanAndLiGoBackToWhereTheyCameFrom) {
  World<3> world = orbit<3>(Integrator::kahan_li_8);
  const Body<3> start = world.bodies()[1];
  // So long a step that the way itself is wrong by more than a thousandth.
  for (int i = 0; i < 20; ++i) world.step(0.5);
  EXPECT_GT(std::abs(glm::length(world.bodies()[1].position - start.position)), 0.1);
  world.set_velocities(
      std::array{std::pair(world.bodies()[1].id, Vec<3>(-world.bodies()[1].velocity))});
  for (int i = 0; i < 20; ++i) world.step(0.5);
  EXPECT_LT(glm::length(world.bodies()[1].position - start.position), 1e-12);
  EXPECT_LT(glm::length(world.bodies()[1].velocity + start.velocity), 1e-12);
}

TEST(PositionMethods, EnergyStaysWithinItsBoundsOverAThousandOrbits) {
  World<2> world = orbit<2>(Integrator::kahan_li_8);
  const double before = energy<2>(world.bodies(), world.forces()).total();
  double early = 0, late = 0;
  constexpr int kSteps = 25;  // an orbit
  for (int i = 0; i < 1000 * kSteps; ++i) {
    world.step(2 * kHalfCircle / kSteps);
    double& most = i < 10 * kSteps ? early : late;
    most = std::max(most, std::abs(energy<2>(world.bodies(), world.forces()).total() / before - 1));
  }
  EXPECT_GT(early, 1e-9);
  EXPECT_LT(late, 1.5 * early);
}

// Two tops without an axis of symmetry, held by springs at their sides: torques turn them.
template <int D>
SmoothScene<D> tied_tops() {
  SmoothScene<D> scene;
  const auto at = [](double x, double y, double z) {
    Vec<D> v(0.0);
    v[0] = x;
    v[1] = y;
    if (D == 3) v[D - 1] = z;
    return v;
  };
  const BodyId wall = scene.add(at(0, 0, 0), at(0, 0, 0), 0);
  for (const double x : {1.5, 3.0}) {
    const BodyId id = scene.add(at(x, 0.2, -0.1), at(0.1, -0.2, 0.3), 1, 0.2);
    Body<D>& body = scene.bodies[id];
    if constexpr (D == 3) {
      body.inverse_inertia = {5, 3, 2};
      body.angular_momentum = {0.2, 0.5, -0.3};
    } else {
      body.angular_momentum = 0.4;
    }
  }
  scene.forces.springs.push_back({wall, 1, at(0, 0.3, 0), at(-0.4, 0.2, 0.1), 1, 9, 0});
  scene.forces.springs.push_back({1, 2, at(0.3, -0.2, 0.2), at(-0.4, 0.1, -0.3), 1, 7, 0});
  scene.forces.pushes.push_back({2, at(0.1, 0.3, 0.2), at(0.2, -0.4, 0.3)});
  return scene;
}

template <int D>
double difference(const SmoothScene<D>& a, const SmoothScene<D>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    const Body<D>&p = a.bodies[i], &q = b.bodies[i];
    most =
        std::max({most, glm::length(p.position - q.position), glm::length(p.velocity - q.velocity),
                  size_of(Spin<D>(p.angular_momentum - q.angular_momentum)),
                  size_of(turn_between(p.orientation, q.orientation))});
  }
  return most;
}

template <int D>
void expect_order_of_turning() {
  for (const auto& [method, order] : kOrdersOfPlaces) {
    const auto after = [&](int steps) {
      SmoothScene<D> scene = tied_tops<D>();
      scene.run(method, 2.0 / steps, steps);
      return scene;
    };
    const int steps = order == 8 ? 12 : 40;
    const SmoothScene<D> exact = after(16 * steps);
    const double coarse = difference(after(steps), exact),
                 fine = difference(after(2 * steps), exact);
    EXPECT_GT(std::log2(coarse / fine), order - 0.5) << to_string(method) << " in " << D;
    EXPECT_LT(std::log2(coarse / fine), order + 1) << to_string(method) << " in " << D;
    SmoothScene<D> other = tied_tops<D>();
    other.run(Integrator::runge_kutta_4, 1e-3, 2000);
    EXPECT_LT(difference(other, exact), 1e-9) << to_string(method) << " in " << D;
  }
}
TEST(PositionMethods, TorquesTurnBodiesByTheOrder) {
  expect_order_of_turning<2>();
  expect_order_of_turning<3>();
}

template <class Act>
void expect_refused(const std::string& why, Act&& act) {
  try {
    act();
    ADD_FAILURE() << "not refused: " << why;
  } catch (const Refused& refused) {
    EXPECT_EQ(std::string(refused.what()), why);
  }
}

TEST(PositionMethods, OtherForcesAreRefusedWithTheReason) {
  for (const auto& [method, order] : kOrdersOfPlaces) {
    const std::string who = "body 'b': " + std::string(to_string(method));
    const WorldConfig<2> config{.integrator = method, .contacts = ContactMethod::none};
    Body<2> body;
    body.name = "b";
    body.shape = Sphere{0.1};
    expect_refused(who + " knows forces of places alone, no contacts", [&] {
      World<2>({.integrator = method, .contacts = ContactMethod::soft}).add(body);
    });
    Body<2> own = body;
    own.integrator = method;
    expect_refused(who + " knows forces of places alone, no contacts",
                   [&] { World<2>(WorldConfig<2>{}).add(own); });
    Body<2> braked = body, braked_turning = body;
    braked.linear_drag = braked_turning.angular_drag = 1;
    for (const Body<2>& b : {braked, braked_turning})
      expect_refused(who + " knows forces of places alone, no drag",
                     [&] { World<2>(config).add(b); });
    World<2> world(config);
    const BodyId a = world.add(body), b = world.add(body);
    expect_refused(who + " knows forces of places alone, no damping", [&] {
      world.add_spring({a, b, {0, 0}, {0, 0}, 1, 1, 0.1});
    });
    expect_refused(who + " knows forces of places alone, no joints", [&] {
      Joint<2> pin;
      pin.kind = JointKind::pin;
      pin.a = a;
      pin.b = b;
      world.add_joint(pin);
    });
    EXPECT_NO_THROW(world.add_spring({a, b, {0, 0}, {0, 0}, 1, 1, 0}));

    // What another method may move, this one may not go on with.
    const WorldConfig<2> free{.integrator = Integrator::velocity_verlet,
                              .contacts = ContactMethod::none};
    World<2> damped(free), jointed(free), braked_world(free);
    damped.add(body), damped.add(body), jointed.add(body), jointed.add(body);
    damped.add_spring({0, 1, {0, 0}, {0, 0}, 1, 1, 0.1});
    Joint<2> pin;
    pin.kind = JointKind::pin;
    pin.a = 0;
    pin.b = 1;
    jointed.add_joint(pin);
    braked_world.add(braked);
    for (const World<2>* as : {&damped, &jointed, &braked_world})
      EXPECT_THROW(World<2>(*as, config), Refused);
    WorldConfig<2> touching = config;
    touching.contacts = ContactMethod::soft;
    EXPECT_THROW(World<2>(world, touching), Refused);
    EXPECT_EQ(World<2>(world, config).bodies().size(), 2u);

    SmoothScene<2> scene;
    scene.add({0, 0}, {1, 0}, 1);
    scene.bodies[0].linear_drag = 1;
    expect_refused(std::string(to_string(method)) + " knows neither drag nor damping",
                   [&] { scene.step(method, 0.1); });
  }
}

}  // namespace
}  // namespace lantern::physics
