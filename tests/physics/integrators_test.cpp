// Names, counted work, order of accuracy, and the exact problems.
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/random.hpp"
#include "exact_oscillator.hpp"
#include "smooth_scene.hpp"

namespace lantern::physics {
namespace {

constexpr long double kPi = std::numbers::pi_v<long double>;
constexpr double kRest = 2;

// Mass 1 on a spring of rest length 2, along x from an anchor at 0.
SmoothScene<2> oscillator(double omega, double zeta, double stretch) {
  SmoothScene<2> scene;
  const BodyId anchor = scene.add({0, 0}, {0, 0}, 0);
  const BodyId mass = scene.add({kRest + stretch, 0}, {0, 0}, 1);
  scene.forces.springs.push_back(
      {anchor, mass, {0, 0}, {0, 0}, kRest, omega * omega, 2 * zeta * omega});
  return scene;
}

// Relative to the start's.
struct Errors {
  double state;
  double energy;
};

Errors oscillator_errors(Integrator method, double omega, double zeta, long double time,
                         int steps) {
  SmoothScene<2> scene = oscillator(omega, zeta, 0.5);
  const double before = scene.energy().total();
  scene.run(method, static_cast<double>(time / steps), steps);
  const auto exact = exact_oscillator(omega, zeta, {0.5L, 0}, time);
  const Body<2>& mass = scene.bodies[1];
  const long double dx = mass.position.x - (kRest + exact.x);
  const long double dv = (mass.velocity.x - exact.v) / omega;
  const long double energy = (exact.v * exact.v + omega * omega * exact.x * exact.x) / 2;
  return {static_cast<double>(std::sqrt(dx * dx + dv * dv) / 0.5L),
          static_cast<double>(std::abs(scene.energy().total() - energy) / before)};
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

struct Order {
  Integrator method;
  double state;
  double energy;  // of an undamped spring; 0: no error but rounding
  long double periods;
  int first_steps;  // of the coarsest run
};
constexpr std::array<Order, 6> kOrders{{
    {Integrator::explicit_euler, 1, 1, 1.3L, 800},
    {Integrator::semi_implicit_euler, 1, 1, 10.3L, 4000},
    {Integrator::velocity_verlet, 2, 2, 10.3L, 1000},
    {Integrator::runge_kutta_4, 4, 5, 10.3L, 600},
    {Integrator::implicit_midpoint, 2, 0, 10.3L, 1000},
    {Integrator::implicit_euler, 1, 1, 1.3L, 800},
}};

// Not at whole periods, where semi-implicit Euler looks like second order; and after few for the
// two methods whose amplitude changes at each step, else that change is no longer small.
TEST(Integrators, TheErrorFallsByTheOrderOfTheMethod) {
  for (const Order& order : kOrders) {
    for (const double zeta : {0.0, 0.1}) {
      const long double time = order.periods * 2 * kPi;
      Errors coarse = oscillator_errors(order.method, 1, zeta, time, order.first_steps);
      for (int halving = 1; halving <= 4; ++halving) {
        const Errors fine =
            oscillator_errors(order.method, 1, zeta, time, order.first_steps << halving);
        EXPECT_NEAR(std::log2(coarse.state / fine.state), order.state, 0.1)
            << to_string(order.method) << " zeta " << zeta << " halving " << halving;
        if (zeta == 0 && order.energy > 0) {
          EXPECT_NEAR(std::log2(coarse.energy / fine.energy), order.energy, 0.1)
              << to_string(order.method) << " energy, halving " << halving;
        } else if (zeta == 0) {
          EXPECT_LT(fine.energy, 1e-12) << to_string(order.method);
        }
        coarse = fine;
      }
    }
  }
}

TEST(Integrators, TheRowSaysWhatTheMethodIs) {
  const auto gain = [](Integrator method, double omega, double h, int steps) {
    SmoothScene<2> scene = oscillator(omega, 0, 0.5);
    const double before = scene.energy().total();
    scene.run(method, h, steps);
    return scene.energy().total() / before;
  };
  for (const Order& order : kOrders) {
    const Integration& row = integration(order.method);
    EXPECT_EQ(row.name, to_string(order.method));
    EXPECT_EQ(row.order, order.state) << row.name;
    EXPECT_EQ(gain(order.method, 1000, 0.1, 20) < 1.001, row.implicit) << row.name;
    EXPECT_EQ(gain(order.method, 1, 0.01, 1000) > 1.05, row.gains_energy) << row.name;
    SmoothScene<2> falling;
    falling.add({0, 0}, {1, 2}, 1);
    falling.forces.gravity = {0, -10};
    Scratch<Increment<2>> all;
    find_increments<2>(order.method, falling.bodies, falling.forces, 0.1, all, falling.evaluations);
    const Vec<2> kick = all[0].kick;
    EXPECT_NEAR(-glm::dot(all[0].drift, kick) / (0.1 * glm::dot(kick, kick)), row.lag, 1e-12)
        << row.name;
  }
}

TEST(Integrators, AnyDampingRatioIsFollowed) {
  for (const double zeta : {0.0, 1e-6, 1.0, 1e3}) {
    EXPECT_LT(oscillator_errors(Integrator::runge_kutta_4, 1, zeta, 10, 10000).state, 1e-10)
        << zeta;
    for (const auto method : {Integrator::velocity_verlet, Integrator::implicit_midpoint})
      EXPECT_LT(oscillator_errors(method, 1, zeta, 10, 10000).state, 1e-6)
          << to_string(method) << " " << zeta;
    EXPECT_LT(oscillator_errors(Integrator::implicit_euler, 1, zeta, 10, 10000).state, 6e-3)
        << zeta;
  }
}

// The bar of free fall: 10 s at 1 ms, to 1e-10 m.
TEST(Integrators, FreeFallFollowsTheParabola) {
  for (const auto method :
       {Integrator::velocity_verlet, Integrator::runge_kutta_4, Integrator::implicit_midpoint}) {
    SmoothScene<3> scene;
    scene.add({1, 2, 3}, {3, 4, -5}, 0.7);
    scene.forces.gravity = {0, -10, 0};
    scene.run(method, 1e-3, 10000);
    const Vec<3> exact{1 + 30, 2 + 40 - 500, 3 - 50};
    EXPECT_LT(glm::length(scene.bodies[0].position - exact), 1e-10) << to_string(method);
    EXPECT_LT(glm::length(scene.bodies[0].velocity - Vec<3>(3, -96, -5)), 1e-10);
  }
}

TEST(Integrators, DragFollowsTheExponential) {
  const double c = 0.3, m = 0.5, t = 2;
  const auto error = [&](Integrator method, int steps) {
    SmoothScene<2> scene;
    scene.add({0, 0}, {5, 8}, m);
    scene.bodies[0].linear_drag = c;
    scene.forces.gravity = {0, -10};
    scene.run(method, t / steps, steps);
    const double rate = c / m, gone = -std::expm1(-rate * t) / rate;
    const Vec<2> limit = Vec<2>(0, -10) / rate;
    const Vec<2> exact = limit * t + (Vec<2>(5, 8) - limit) * gone;
    return glm::length(scene.bodies[0].position - exact);
  };
  for (const Order& order : kOrders) {
    const int first = order.state == 4 ? 8 : 64;
    for (int halving = 0; halving < 4; ++halving)
      EXPECT_NEAR(std::log2(error(order.method, first << halving) /
                            error(order.method, first << (halving + 1))),
                  order.state, 0.1)
          << to_string(order.method);
  }
}

// Drag so strong that it stops the body within a step: implicit methods take it as it is.
TEST(Integrators, StiffDragIsNoTrouble) {
  for (const auto method :
       {Integrator::velocity_verlet, Integrator::implicit_midpoint, Integrator::implicit_euler}) {
    SmoothScene<2> scene;
    scene.add({0, 0}, {5, 8}, 1);
    scene.bodies[0].linear_drag = 1e4;
    scene.forces.gravity = {0, -10};
    for (int i = 0; i < 600; ++i) {
      scene.step(method, 1.0 / 60);
      ASSERT_LE(glm::length(scene.bodies[0].velocity), 10) << to_string(method);
    }
    if (method == Integrator::implicit_euler) {
      EXPECT_NEAR(scene.bodies[0].velocity.y, -1e-3, 1e-12);
    }
  }
}

// N equal masses between two walls: mode k swings at 2 sqrt(k/m) sin(k pi / 2(N + 1)).
TEST(Integrators, AChainSwingsInItsNormalModes) {
  constexpr int n = 10;
  SmoothScene<3> scene;
  std::array<long double, n + 2> moved{};
  for (int i = 1; i <= n; ++i) moved[i] = 0.01L * ((i * 7) % 5 - 2);
  for (int i = 0; i <= n + 1; ++i)
    scene.add({static_cast<double>(i + moved[i]), 0, 0}, {0, 0, 0}, i == 0 || i == n + 1 ? 0 : 1);
  for (BodyId i = 0; i <= n; ++i)
    scene.forces.springs.push_back({i, i + 1, {0, 0, 0}, {0, 0, 0}, 1, 100, 0});
  scene.run(Integrator::runge_kutta_4, 1e-3, 2000);
  for (int i = 1; i <= n; ++i) {
    long double x = 0;
    for (int k = 1; k <= n; ++k) {
      long double amplitude = 0;
      for (int j = 1; j <= n; ++j)
        amplitude += 2 * moved[j] * std::sin(j * k * kPi / (n + 1)) / (n + 1);
      const long double omega = 2 * 10 * std::sin(k * kPi / (2 * (n + 1)));
      x += amplitude * std::sin(i * k * kPi / (n + 1)) * std::cos(omega * 2);
    }
    EXPECT_NEAR(scene.bodies[i].position.x, static_cast<double>(i + x), 1e-9) << "mass " << i;
  }
}

TEST(Integrators, FarFromTheOriginNothingIsLostButThePlace) {
  for (const Integrator method : kAllIntegrators) {
    SmoothScene<2> near = oscillator(3, 0.1, 0.5), far = near;
    const double offset = 0x1p30;
    for (Body<2>& body : far.bodies) body.position += offset;
    Scratch<Increment<2>> here, there;
    find_increments<2>(method, near.bodies, near.forces, 0.1, here, near.evaluations);
    find_increments<2>(method, far.bodies, far.forces, 0.1, there, far.evaluations);
    EXPECT_EQ(here[1].kick, there[1].kick) << to_string(method) << ": rounded within the step";
    EXPECT_EQ(here[1].drift, there[1].drift) << to_string(method);
    near.run(method, 0x1p-8, 256);
    far.run(method, 0x1p-8, 256);
    EXPECT_NEAR(far.bodies[1].position.x - offset, near.bodies[1].position.x, 256 * 8 * 0x1p-22)
        << to_string(method);
  }
}

TEST(Integrators, BodiesThatNoForceMovesGetNothing) {
  for (const Integrator method : kAllIntegrators) {
    SmoothScene<2> scene = oscillator(1, 0.1, 0.5);
    scene.forces.gravity = {0, -10};
    for (int i = 0; i < 3; ++i) scene.add({static_cast<double>(i), 5}, {1, 1}, 1, 1);
    scene.bodies[2].asleep = true;
    scene.bodies[3].kind = BodyKind::kinematic_body;
    scene.bodies[4].inverse_mass = 0;
    for (BodyId i = 2; i < 5; ++i)
      scene.forces.springs.push_back({i, 1, {0.1, 0}, {0, 0}, 1, 10, 1});
    Scratch<Increment<2>> all;
    find_increments<2>(method, scene.bodies, scene.forces, 0.01, all, scene.evaluations);
    ASSERT_EQ(all.size(), 5u);
    EXPECT_NE(all[1].kick, Vec<2>(0.0));
    for (const int i : {0, 2, 3, 4}) {
      EXPECT_EQ(all[i].kick, Vec<2>(0.0)) << to_string(method) << " body " << i;
      EXPECT_EQ(all[i].drift, Vec<2>(0.0)) << to_string(method) << " body " << i;
      EXPECT_EQ(all[i].twist, 0) << to_string(method) << " body " << i;
    }
  }
}

// The anchor at the rim of a wheel that turns: the mass hangs at rest in the turning frame.
TEST(Integrators, AKinematicBodyCarriesTheEndOfItsSpring) {
  SmoothScene<2> scene;
  scene.add({0, 0}, {0, 0}, 1);
  scene.bodies[0].kind = BodyKind::kinematic_body;
  scene.bodies[0].kinematic_spin = 2;
  // At radius r the spring from the rim (1) pulls by k (r - 1) = m w^2 r: r = k / (k - 4).
  const double k = 20, r = k / (k - 4);
  scene.add({r, 0}, {0, 2 * r}, 1);
  scene.forces.springs.push_back({0, 1, {1, 0}, {0, 0}, 0, k, 0});
  scene.run(Integrator::runge_kutta_4, 1e-3, 3000);
  const Vec<2> exact{r * std::cos(6.0), r * std::sin(6.0)};
  EXPECT_LT(glm::length(scene.bodies[1].position - exact), 1e-9);
}

// What swings on a spring of any stiffness k from an anchor: the middle of a step lies on the line
// to p = x + h/2 v + h^2/4 g, at the distance (|p| + q L) / (1 + q) with q = h^2 k / 4m.
template <int D>
void expect_exact_middles(Random& random) {
  const auto any = [&](double most) {
    glm::vec<D, double> v(0.0);
    for (int i = 0; i < D; ++i) v[i] = random.between(-most, most);
    return v;
  };
  SmoothScene<D> scene;
  const double h = std::exp(random.between(-6, -3)), mass = random.between(0.5, 2);
  const double stiffness = std::pow(10, random.between(3, 12)), rest = random.between(1, 3);
  scene.add(Vec<D>(0.0), Vec<D>(0.0), 0);
  scene.add(glm::normalize(any(1)) * rest, any(3), mass);
  scene.forces.springs.push_back({0, 1, Vec<D>(0.0), Vec<D>(0.0), rest, stiffness, 0});
  scene.forces.gravity = any(10);
  using Exact = glm::vec<D, long double>;
  const long double q = static_cast<long double>(h) * h * stiffness / 4 / mass;
  for (int step = 0; step < 100; ++step) {
    const Exact x = scene.bodies[1].position, v = scene.bodies[1].velocity;
    const Exact p = x + v * (h / 2.0L) + Exact(scene.forces.gravity) * (h * (h / 4.0L));
    const long double far = glm::length(p);
    if (glm::length(v) * h > rest) return;  // has gained beyond all sense, as the method may
    const Exact middle = p / far * ((far + q * rest) / (1 + q));
    scene.step(Integrator::implicit_midpoint, h);
    const Exact end = 2.0L * middle - x, mean = (end - x) / static_cast<long double>(h);
    const double allowed = 1e-12 * rest;
    ASSERT_LT(glm::length(Exact(scene.bodies[1].position) - end), allowed) << step;
    ASSERT_LT(glm::length(Exact(scene.bodies[1].velocity) - (2.0L * mean - v)), 10 * allowed / h)
        << step << ", stiffness " << stiffness;
  }
}

TEST(Integrators, TheMiddleOfAStiffSwingIsThatOfTheMethod) {
  Random random(17);
  for (int round = 0; round < 20; ++round) {
    expect_exact_middles<2>(random);
    expect_exact_middles<3>(random);
  }
}

TEST(Integrators, RefusesAStepThatIsNoStep) {
  SmoothScene<2> scene = oscillator(1, 0, 0.1);
  Scratch<Increment<2>> all;
  for (const double h : {0.0, -0.1, std::nan(""), HUGE_VAL})
    EXPECT_THROW(find_increments<2>(Integrator::runge_kutta_4, scene.bodies, scene.forces, h, all,
                                    scene.evaluations),
                 Refused);
}

}  // namespace
}  // namespace lantern::physics
