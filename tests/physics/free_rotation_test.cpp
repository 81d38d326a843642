#include <algorithm>
#include <array>
#include <cmath>

#include <glm/exponential.hpp>
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "physics/body.hpp"
#include "physics/forces.hpp"
#include "physics/world.hpp"

namespace lantern::physics {
namespace {

Body<3> spinning(const Vec<3>& inertia, const Vec<3>& spin) {
  Body<3> body;
  body.shape = Sphere{1};
  body.inverse_mass = 1;
  body.inverse_inertia = 1.0 / inertia;
  body.angular_momentum = inertia * spin;  // the body's axes are the world's at first
  return body;
}

// A box of 1 x 4 x 9 and mass 12, thrown almost about its middle axis.
const Vec<3> kBoxInertia{16 + 81, 1 + 81, 1 + 16};
Body<3> thrown_box() { return spinning(kBoxInertia, {0.1, 5, 0.1}); }

double rotational(const Body<3>& body) {
  return glm::dot(body.angular_momentum, angular_velocity(body)) / 2;
}

struct Drift {
  double energy = 0;
  double momentum = 0;
};

// Largest relative change over 10 s.
Drift drift_of(RotationMethod method, double h, int steps) {
  Body<3> body = thrown_box();
  const double energy = rotational(body), momentum = glm::length(body.angular_momentum);
  const Vec<3> axis = body.angular_momentum;
  Drift worst;
  for (int i = 0; i < steps; ++i) {
    turn_freely(body, h, method);
    worst.energy = std::max(worst.energy, std::abs(rotational(body) / energy - 1));
    worst.momentum = std::max(worst.momentum, glm::length(body.angular_momentum - axis) / momentum);
  }
  return worst;
}

// The top in long double by the classical Runge-Kutta method: orientation and Euler's equation.
using Long = long double;
struct Top {
  std::array<Long, 4> q{1, 0, 0, 0};
  std::array<Long, 3> w{};
};
Top rate(const Top& t, const std::array<Long, 3>& inertia) {
  const auto [w, x, y, z] = t.q;
  const auto [a, b, c] = t.w;
  Top d;
  d.q = {(-x * a - y * b - z * c) / 2, (w * a + y * c - z * b) / 2, (w * b + z * a - x * c) / 2,
         (w * c + x * b - y * a) / 2};
  d.w = {(inertia[1] - inertia[2]) * b * c / inertia[0],
         (inertia[2] - inertia[0]) * c * a / inertia[1],
         (inertia[0] - inertia[1]) * a * b / inertia[2]};
  return d;
}
Top plus(Top t, const Top& d, Long h) {
  for (int i = 0; i < 4; ++i) t.q[i] += h * d.q[i];
  for (int i = 0; i < 3; ++i) t.w[i] += h * d.w[i];
  return t;
}
glm::dquat reference(const Vec<3>& inertia, const Vec<3>& spin, Long time, int steps) {
  const std::array<Long, 3> in{inertia.x, inertia.y, inertia.z};
  Top t;
  t.w = {spin.x, spin.y, spin.z};
  const Long h = time / steps;
  for (int i = 0; i < steps; ++i) {
    const Top a = rate(t, in), b = rate(plus(t, a, h / 2), in), c = rate(plus(t, b, h / 2), in),
              d = rate(plus(t, c, h), in);
    t = plus(plus(plus(plus(t, a, h / 6), b, h / 3), c, h / 3), d, h / 6);
  }
  return glm::normalize(glm::dquat(static_cast<double>(t.q[0]), static_cast<double>(t.q[1]),
                                   static_cast<double>(t.q[2]), static_cast<double>(t.q[3])));
}

// The angle, in radians, between two orientations.
double angle_between(const glm::dquat& a, const glm::dquat& b) {
  const glm::dquat d = glm::conjugate(a) * b;
  return 2 * std::asin(std::min(1.0, glm::length(Vec<3>(d.x, d.y, d.z))));
}

TEST(FreeRotation, TheThrownBoxKeepsEnergyAndAngularMomentum) {
  const Drift second = drift_of(RotationMethod::splitting_2, 1e-3, 10000);
  EXPECT_LE(second.energy, 4e-7);
  EXPECT_LE(second.momentum, 1e-12);
  const Drift fourth = drift_of(RotationMethod::splitting_4, 1e-3, 10000);
  EXPECT_LE(fourth.energy, 1e-12);
  EXPECT_LE(fourth.momentum, 1e-12);
}

TEST(FreeRotation, TheNaiveMethodIsAWarning) {
  const Drift naive = drift_of(RotationMethod::explicit_gyroscopic, 1e-3, 10000);
  EXPECT_GT(naive.energy, 1e-4);
  EXPECT_GT(naive.momentum, 1e-4);
}

TEST(FreeRotation, TheErrorFallsByTheOrderOfTheMethod) {
  const Vec<3> spin{3, 4, 5};
  const glm::dquat exact = reference(kBoxInertia, spin, 5, 100000);
  const auto error = [&](RotationMethod method, int steps) {
    Body<3> body = spinning(kBoxInertia, spin);
    for (int i = 0; i < steps; ++i) turn_freely(body, 5.0 / steps, method);
    return angle_between(exact, body.orientation.q);
  };
  const auto expect_order = [&](RotationMethod method, double order, int first, const char* name) {
    for (int halving = 0; halving < 4; ++halving)
      EXPECT_NEAR(
          std::log2(error(method, first << halving) / error(method, first << (halving + 1))), order,
          0.1)
          << name << " halving " << halving;
  };
  expect_order(RotationMethod::splitting_2, 2, 200, "splitting_2");
  expect_order(RotationMethod::splitting_4, 4, 70, "splitting_4");
}

// Two equal inertias: the axis of the top runs round L at |L| / I, at any step.
TEST(FreeRotation, ASymmetricTopIsExactAtAnyStep) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double other : {0.3, 5.0}) {
      Vec<3> inertia(2.0), spin{0.7, -1.1, 0.4};
      inertia[axis] = other;
      Body<3> body = spinning(inertia, spin);
      for (int i = 0; i < 7; ++i) turn_freely(body, 0.5, RotationMethod::splitting_2);
      EXPECT_LT(angle_between(reference(inertia, spin, 3.5L, 20000), body.orientation.q), 1e-13)
          << "axis " << axis << " inertia " << other;
    }
  }
}

TEST(FreeRotation, ASphereTurnsAboutItsAxisExactly) {
  const Vec<3> spin{0.7, -1.1, 0.4};
  Body<3> body = spinning(Vec<3>(2.5), spin);
  body.orientation = freely_turned(body, 3.0);
  const glm::dquat exact = turned(Rotation<3>{}, spin * 3.0).q;
  EXPECT_LT(angle_between(exact, body.orientation.q), 1e-15);
}

TEST(FreeRotation, ADiscTurnsByItsSpin) {
  Body<2> body;
  body.shape = Sphere{1};
  body.inverse_inertia = 0.25;
  body.angular_momentum = 3;
  EXPECT_EQ(freely_turned(body, 2.0).angle, 1.5);
  turn_freely(body, 2.0, RotationMethod::explicit_gyroscopic);
  EXPECT_EQ(body.orientation.angle, 1.5);
}

TEST(FreeRotation, TurningBackLeadsBack) {
  Random random(3);
  for (int round = 0; round < 20; ++round) {
    const auto any = [&](double lo, double hi) {
      return Vec<3>{random.between(lo, hi), random.between(lo, hi), random.between(lo, hi)};
    };
    for (const auto method : {RotationMethod::splitting_2, RotationMethod::splitting_4}) {
      Body<3> body = spinning(any(0.1, 3), any(-9, 9));
      for (int i = 0; i < 100; ++i) turn_freely(body, 0.02, method);
      for (int i = 0; i < 100; ++i) turn_freely(body, -0.02, method);
      EXPECT_LT(angle_between(glm::dquat(1, 0, 0, 0), body.orientation.q), 1e-12);
    }
  }
}

// Tops of boxes from cubes to needles and plates, spun about any axis, or nearly about one of their
// own, or near the boundary between two ways of tumbling.
Body<3> any_top(Random& random) {
  const auto any = [&] {
    return Vec<3>{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
  };
  const double most = random.whole(0, 1) == 0 ? 0.7 : 7;
  const Vec<3> size =
      glm::exp(Vec<3>{random.between(0, most), random.between(0, most), random.between(0, most)});
  Body<3> body = spinning({size.y * size.y + size.z * size.z, size.z * size.z + size.x * size.x,
                           size.x * size.x + size.y * size.y},
                          Vec<3>(0.0));
  body.angular_momentum = any();
  if (random.whole(0, 2) == 0) body.angular_momentum *= std::exp(-random.between(0, 9));
  body.angular_momentum[static_cast<int>(random.whole(0, 2))] += 1;
  body.orientation = turned(body.orientation, any());
  return body;
}

glm::dquat turned_by(const Body<3>& top, double h, RotationMethod method) {
  return freely_turned(top, top.angular_momentum, h, method).q;
}

// The seconds in which its fastest turn about an axis of its own is one radian.
double radian_of(const Body<3>& body) {
  const Vec<3> m = body.inverse_inertia;
  const double least = std::min({m.x, m.y, m.z}), most = std::max({m.x, m.y, m.z});
  return 1 / ((most - least) * glm::length(body.angular_momentum));
}

double energy_change(const Body<3>& body, const glm::dquat& orientation) {
  Body<3> later = body;
  later.orientation.q = orientation;
  return std::abs(rotational(later) / rotational(body) - 1);
}

TEST(FreeRotation, AnyTopKeepsItsEnergyAtAnySpinAndStep) {
  Random random(11);
  for (int round = 0; round < 300; ++round) {
    const Body<3> top = any_top(random);
    for (const double radians : {0.01, 0.1, 0.5, 0.7, 1.5, 17.0, -167.0, 1e4, 1e7})
      for (const auto method :
           {RotationMethod::exact, RotationMethod::splitting_2, RotationMethod::splitting_4}) {
        const glm::dquat q = turned_by(top, radians * radian_of(top), method);
        const bool splits = method != RotationMethod::exact && std::abs(radians) < 2;
        ASSERT_LT(energy_change(top, q), splits ? 1e-3 : 1e-12)
            << "top " << round << ", " << radians << " radians";
        ASSERT_NEAR(glm::length(q), 1, 1e-15);
      }
  }
}

// By default: short steps as well as far ones, at any size of the spin, of boxes of any shape and
// of such that are nearly spheres or nearly square.
TEST(FreeRotation, AnyTopTurnsExactlyAtAnySpinAndStep) {
  Random random(14);
  for (int round = 0; round < 60; ++round) {
    Body<3> top = any_top(random);
    const double askew = std::exp(-random.between(0, 36));
    if (round % 3 == 1) top.inverse_inertia = Vec<3>{1, 1 + askew, 1 - random.between(0, askew)};
    if (round % 3 == 2) top.inverse_inertia = Vec<3>{1, 1 + askew, std::exp(random.between(-3, 3))};
    top.orientation = {};
    top.angular_momentum *= std::exp(random.between(-20, 20));
    // Of the whole turn, not only of what is left when the body turns about its momentum.
    const Vec<3> spin = top.inverse_inertia * top.angular_momentum;
    const double h = std::exp(random.between(-7, 1)) / glm::length(spin);
    const glm::dquat exact = reference(1.0 / top.inverse_inertia, spin, h, 4000);
    ASSERT_LT(angle_between(exact, freely_turned(top, h).q), 3e-15) << round;
    Body<3> fine = top;
    for (int i = 0; i < 50; ++i) turn_freely(fine, h / 50, WorldConfig<3>{}.rotation);
    ASSERT_LT(angle_between(exact, fine.orientation.q), 2e-14) << round;
  }
}

// A box of 1 x 0.4 x 0.2 at 20 radians a second, as a world moves it: at no step is anything lost.
TEST(FreeRotation, AWorldsStepMakesNoDifferenceToAFreeBody) {
  const auto spun = [](int steps) {
    World<3> world;
    Body<3> box;
    box.shape = OrientedBox<3>{{0.5, 0.2, 0.1}};
    const BodyId id = world.add(box, {20, 1, 2});
    const double energy = rotational(*world.find(id));
    for (int i = 0; i < steps; ++i) world.step(1.0 / steps);
    EXPECT_NEAR(rotational(*world.find(id)) / energy, 1, 1e-12) << steps;
    return world.find(id)->orientation.q;
  };
  const glm::dquat whole = spun(1);
  for (const int steps : {60, 120, 240, 1000, 3000})
    EXPECT_LT(angle_between(whole, spun(steps)), 1e-11) << steps;
}

TEST(FreeRotation, FarTurnsAreThoseOfManySmallOnes) {
  Random random(12);
  for (int round = 0; round < 25; ++round) {
    const Body<3> top = any_top(random);
    const double h = random.between(1.3, 4) * radian_of(top) * (round % 2 == 0 ? 1 : -1);
    Body<3> fine = top;
    for (int i = 0; i < 300; ++i) turn_freely(fine, h / 300, RotationMethod::splitting_4);
    ASSERT_LT(angle_between(freely_turned(top, h).q, fine.orientation.q), 1e-9) << round;
  }
}

// Near the middle axis a rounding grows with every turn: such tops are left out.
TEST(FreeRotation, TwoFarTurnsAreOne) {
  Random random(13);
  for (int round = 0; round < 200; ++round) {
    Body<3> top = any_top(random);
    top.inverse_inertia = {0.5, 1, 1.7};
    top.angular_momentum = top.orientation.q * Vec<3>(random.between(-1, 1), random.between(-1, 1),
                                                      random.between(3, 5));
    const double h = random.between(2, 1e4), part = random.between(-1, 2) * h;
    const glm::dquat whole = freely_turned(top, h).q;
    turn_freely(top, part, RotationMethod::splitting_2);
    turn_freely(top, h - part, RotationMethod::splitting_2);
    ASSERT_LT(angle_between(whole, top.orientation.q), 1e-10) << round;
  }
}

// A little below the angle at which a splitting gives way, and a little above.
TEST(FreeRotation, BothSidesOfTheLimitAgree) {
  Body<3> top = spinning({1, 1.001, 0.9}, {3, 1, 2});
  for (const auto method : {RotationMethod::splitting_2, RotationMethod::splitting_4}) {
    const double h = (method == RotationMethod::splitting_2 ? 0.6 : 1.6) /
                     ((1 / 0.9 - 1 / 1.0) * glm::length(top.angular_momentum));
    const glm::dquat below = turned_by(top, h * (1 - 1e-9), method);
    const glm::dquat above = turned_by(top, h * (1 + 1e-9), method);
    EXPECT_NE(below, above);
    EXPECT_LT(angle_between(below, above), 2e-4);
  }
}

// Exactly about an axis, the middle one too, it goes on so; exactly on the boundary it turns over
// once at most.
TEST(FreeRotation, AxesAndTheBoundaryBetweenThem) {
  const Vec<3> inertia{1, 2, 3};
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) {
      Vec<3> spin(0.0);
      spin[axis] = sign * 1e4;
      const Body<3> top = spinning(inertia, spin);
      EXPECT_LT(angle_between(freely_turned(top, 0.3).q, turned(Rotation<3>{}, spin * 0.3).q),
                1e-11);
    }
  // (1/I1 - 1/I2) L1^2 = (1/I2 - 1/I3) L3^2
  Body<3> top = spinning(inertia, {0, 0, 0});
  top.angular_momentum = {1, 0.5, std::sqrt(3.0)};
  for (const double h : {1.0, 1e3, 1e6, -1e6})
    EXPECT_LT(energy_change(top, freely_turned(top, h).q), 1e-14) << h;
}

// Almost a rod: no inertia about its axis to speak of.
TEST(FreeRotation, ExtremeInertiaStaysBounded) {
  Body<3> body = spinning({1, 1, 1e-4}, {0.3, 1, 20});
  const double energy = rotational(body);
  for (int i = 0; i < 10000; ++i) turn_freely(body, 1e-3, RotationMethod::splitting_2);
  EXPECT_NEAR(rotational(body) / energy, 1, 1e-12);
  EXPECT_NEAR(glm::length(body.orientation.q), 1, 1e-15);
}

TEST(FreeRotation, WhoTurnsAndWhoDoesNot) {
  Body<3> body = thrown_box();
  body.asleep = true;
  EXPECT_EQ(freely_turned(body, 1.0).q, body.orientation.q) << "a sleeper turns";
  body.asleep = false;
  body.kind = BodyKind::static_body;
  EXPECT_EQ(freely_turned(body, 1.0).q, body.orientation.q) << "a static body turns";
  body.kind = BodyKind::kinematic_body;
  body.kinematic_spin = {0, 0, 2};
  EXPECT_LT(angle_between(freely_turned(body, 0.5).q, turned(Rotation<3>{}, {0, 0, 1}).q), 1e-15);
  body.kind = BodyKind::dynamic_body;
  body.inverse_inertia = Vec<3>(0.0);
  turn_freely(body, 1.0, RotationMethod::explicit_gyroscopic);
  EXPECT_EQ(body.orientation.q, glm::dquat(1, 0, 0, 0)) << "infinite inertia turns";
}

}  // namespace
}  // namespace lantern::physics
