// A rod that slides or lands on one end: friction turns it, and so changes how hard it presses.
#include <numbers>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "geometry/elementary.hpp"
#include "physics/world_scene.hpp"

namespace lantern::physics {
namespace {

// Leans on the floor in the plane of x and y, its lower end trailing if it moves to the right.
template <int D>
struct LeaningRod {
  LeaningRod(Random& random, ContactMethod method, double restitution, double pull)
      : angle(random.between(0.6, 1.4)), friction(random.between(0.3, 4)), world(config(method)) {
    world.add(floor_at<D>(0, friction));
    const Vec<D> way = along<D>(geometry::cos(angle), geometry::sin(angle));
    Body<D> rod = ball_at<D>(way);
    rod.position.y += kRadius + (restitution > 0 ? 1e-9 : 0);
    rod.shape = Capsule{kRadius, 1};
    Spin<D> turn(0.0);
    spin_component(turn, D == 2 ? 0 : 2) = angle - std::numbers::pi / 2;
    rod.orientation = turned(rod.orientation, turn);
    rod.mass = random.between(0.1, 10);
    rod.material = {restitution, friction};
    rod.velocity = along<D>(random.between(1, 10) * (random.unit() < 0.5 ? 1 : -1),
                            restitution > 0 ? -random.between(0.1, 3) : 0);
    arm = -way - up<D>(kRadius);
    start = rod.velocity;
    world.add(rod);
    world.set_gravity(up<D>(-pull));
  }

  static WorldConfig<D> config(ContactMethod method) {
    WorldConfig<D> config;
    config.contacts = method;
    config.integrator = Integrator::semi_implicit_euler;
    config.iterations = 200;  // where friction presses the end down, each adds to the last
    return config;
  }

  static constexpr double kRadius = 0.02;
  double angle, friction;
  World<D> world;
  Vec<D> arm{0.0}, start{0.0};
};

// How the velocity of its lower end answers to an impulse there; and what such an impulse does.
template <int D>
struct RodEnd {
  explicit RodEnd(const LeaningRod<D>& rod) : arm(rod.arm) {
    const Body<D>& body = rod.world.bodies()[1];
    inverse_mass = body.inverse_mass;
    inverse_inertia = spin_component(body.inverse_inertia, D == 2 ? 0 : 2);
  }
  double nn() const { return inverse_mass + arm.x * arm.x * inverse_inertia; }
  double tt() const { return inverse_mass + arm.y * arm.y * inverse_inertia; }
  double nt() const { return -arm.x * arm.y * inverse_inertia; }
  Vec<D> velocity(const Vec<D>& start, double n, double t) const {
    return start + along<D>(t, n) * inverse_mass;
  }
  double spin(double n, double t) const { return (arm.x * n - arm.y * t) * inverse_inertia; }

  Vec<D> arm;
  double inverse_mass, inverse_inertia;
};

template <int D>
double turning(const Body<D>& body) {
  return spin_component(angular_velocity(body), D == 2 ? 0 : 2);
}

// It parts with its restitution; friction stops the end, or slips all through the blow. Left out is
// where it would turn the slip round, where no slip could be (Painleve), and where the law gives
// energy.
template <int D>
bool expect_blow(Random& random, ContactMethod method) {
  const double restitution = random.between(0.1, 1);
  LeaningRod<D> rod(random, method, restitution, 0);
  const RodEnd<D> end(rod);
  const double along_floor = rod.start.x, side = along_floor > 0 ? 1 : -1, down = rod.start.y;
  double n = -(1 + restitution) * down / (end.nn() - side * rod.friction * end.nt());
  double t = -side * rod.friction * n;
  const double slip = along_floor + end.nt() * n + end.tt() * t;
  if (slip * side < 0) {
    const double wanted_n = -(1 + restitution) * down, wanted_t = -along_floor,
                 area = end.nn() * end.tt() - end.nt() * end.nt();
    n = (wanted_n * end.tt() - wanted_t * end.nt()) / area;
    t = (wanted_t * end.nn() - wanted_n * end.nt()) / area;
  }
  if (!(n > 0) || std::abs(t) > rod.friction * n * (1 + 1e-9)) return false;
  const Vec<D> velocity = end.velocity(rod.start, n, t);
  const double spin = end.spin(n, t);
  const double gained =
      (glm::dot(velocity, velocity) - glm::dot(rod.start, rod.start)) / end.inverse_mass +
      spin * spin / end.inverse_inertia;
  if (gained > 0) return false;
  rod.world.step(1e-4);
  const Body<D>& body = rod.world.bodies()[1];
  EXPECT_NEAR(glm::length(body.velocity - velocity), 0, 1e-6 * glm::length(rod.start));
  EXPECT_NEAR(turning(body), spin, 1e-6 * glm::length(rod.start));
  return true;
}

// It slides; the floor presses so much that its lower end stays on it.
template <int D>
bool expect_slide(Random& random, ContactMethod method) {
  LeaningRod<D> rod(random, method, 0, 10);
  const RodEnd<D> end(rod);
  const double side = rod.start.x > 0 ? 1 : -1, h = 1e-5;
  const double answer = end.nn() - side * rod.friction * end.nt();
  if (answer < 0.05 * end.nn()) return false;
  const double n = 10 * h / answer;
  rod.world.step(h);
  const Body<D>& body = rod.world.bodies()[1];
  const Vec<D> velocity = end.velocity(rod.start - up<D>(10 * h), n, -side * rod.friction * n);
  const double wanted = end.spin(n, -side * rod.friction * n);
  EXPECT_NEAR(glm::length(body.velocity - velocity), 0, 0.01 * h * (10 + n / h));
  EXPECT_NEAR(turning(body), wanted, 0.01 * std::abs(wanted) + 1e-9);
  return true;
}

class CoupledFriction : public testing::TestWithParam<ContactMethod> {
 protected:
  template <class F>
  void expect_often(F&& holds) {
    Random random(11);
    int seen = 0;
    for (int i = 0; i < 100; ++i) {
      SCOPED_TRACE(i);
      seen += holds(random);
    }
    EXPECT_GE(seen, 40);
  }
};

TEST_P(CoupledFriction, ABlowOnOneEnd) {
  expect_often([](Random& random) { return expect_blow<2>(random, GetParam()); });
  expect_often([](Random& random) { return expect_blow<3>(random, GetParam()); });
}
TEST_P(CoupledFriction, SlidingOnOneEnd) {
  expect_often([](Random& random) { return expect_slide<2>(random, GetParam()); });
  expect_often([](Random& random) { return expect_slide<3>(random, GetParam()); });
}

INSTANTIATE_TEST_SUITE_P(Methods, CoupledFriction,
                         testing::Values(ContactMethod::impulse, ContactMethod::soft,
                                         ContactMethod::direct),
                         [](const auto& method) { return std::string(to_string(method.param)); });

}  // namespace
}  // namespace lantern::physics
