// Bodies that springs and drag turn while they tumble: every method keeps its order, in velocities
// and places both, against many small steps of another way.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "physics/integrate/smooth_system.hpp"
#include "physics/world.hpp"
#include "smooth_scene.hpp"

namespace lantern::physics {
namespace {

template <int D>
Vec<D> any_way(Random& random, double most) {
  Vec<D> v(0.0);
  for (int i = 0; i < D; ++i) v[i] = random.between(-most, most);
  return v;
}

// Two bodies of unequal inertia tied to each other and to an anchor, with drag and gravity, of
// which one is pushed and both attract each other. They turn by about `spin` radians a second.
template <int D>
SmoothScene<D> tumbling_pair(Random& random, double spin) {
  SmoothScene<D> scene;
  scene.add(any_way<D>(random, 0.3), Vec<D>(0.0), 0);
  for (int i = 1; i <= 2; ++i) {
    Vec<D> place = any_way<D>(random, 0.3);
    place.x += 3.0 * i;
    const double mass = random.between(0.5, 2);
    scene.add(place, any_way<D>(random, 1), mass, 1);
    Body<D>& body = scene.bodies.back();
    for (int axis = 0; axis < (D == 2 ? 1 : 3); ++axis) {
      spin_component(body.inverse_inertia, axis) = random.between(0.5, 3);
      spin_component(body.angular_momentum, axis) = spin * random.between(-1, 1);
    }
    body.orientation = turned(body.orientation, body.angular_momentum);
    body.linear_drag = random.between(0, 0.3);
    body.angular_drag = random.between(0, 0.3);
  }
  for (BodyId i = 0; i <= 1; ++i)
    scene.forces.springs.push_back({i, i + 1, any_way<D>(random, 0.5), any_way<D>(random, 0.5),
                                    random.between(1, 3), random.between(2, 8),
                                    random.between(0, 0.5)});
  scene.forces.gravity = any_way<D>(random, 3);
  scene.forces.gravitation = 0.5;
  scene.forces.pushes.push_back({2, any_way<D>(random, 0.5), any_way<D>(random, 1)});
  return scene;
}

// --- the other way: Kutta's sums over places, velocities, momenta and rotation vectors
// (Munthe-Kaas, BIT 38, 1998), in steps too short for anything to be lost ---

double rate_of(double, double spin) { return spin; }
Vec<3> rate_of(const Vec<3>& turn, const Vec<3>& spin) {
  const Vec<3> once = glm::cross(turn, spin);
  return spin - once / 2.0 + glm::cross(turn, once) / 12.0;
}

template <int D>
class SmallSteps {
 public:
  explicit SmallSteps(const SmoothScene<D>& scene) : end_(scene), start_(scene) {}

  SmoothScene<D> end(double time, int steps) {
    const double h = time / steps;
    for (int step = 0; step < steps; ++step) {
      const Change none, a = slopes(none), b = slopes(sum(none, a, h / 2)),
                         c = slopes(sum(none, b, h / 2)), d = slopes(sum(none, c, h));
      now_ = at(sum(sum(sum(sum(none, a, h / 6), b, h / 3), c, h / 3), d, h / 6));
    }
    for (std::size_t i = 1; i < 3; ++i) {
      end_.bodies[i].position += now_.shift[i];
      end_.bodies[i].velocity += now_.kick[i];
      end_.bodies[i].angular_momentum += now_.twist[i];
      end_.bodies[i].orientation = now_.orientation[i];
    }
    return end_;
  }

 private:
  // Since the step began, of each body; or what of it a second.
  struct Change {
    std::array<Vec<D>, 3> way{}, kick{};
    std::array<Spin<D>, 3> twist{}, turn{};
  };

  static Change sum(Change change, const Change& slope, double time) {
    for (std::size_t i = 1; i < 3; ++i) {
      change.way[i] += slope.way[i] * time;
      change.kick[i] += slope.kick[i] * time;
      change.twist[i] += slope.twist[i] * time;
      change.turn[i] += slope.turn[i] * time;
    }
    return change;
  }

  SmoothState<D> at(const Change& change) const {
    SmoothState<D> state = now_;
    for (std::size_t i = 1; i < 3; ++i) {
      state.shift[i] += change.way[i];
      state.kick[i] += change.kick[i];
      state.twist[i] += change.twist[i];
      state.orientation[i] = turned(state.orientation[i], change.turn[i]);
    }
    return state;
  }

  Change slopes(const Change& change) {
    const SmoothState<D> state = at(change);
    const Pull<D> pull = system_.evaluate(state);
    Change all;
    for (std::size_t i = 1; i < 3; ++i) {
      all.way[i] = system_.velocity(state, i);
      all.kick[i] = pull.acceleration[i];
      all.twist[i] = pull.torque[i];
      all.turn[i] = rate_of(change.turn[i], system_.angular_velocity(state, i));
    }
    return all;
  }

  SmoothScene<D> end_;
  const SmoothScene<D>& start_;
  SmoothSystem<D> system_{start_.bodies, start_.forces, end_.evaluations};
  SmoothState<D> now_ = system_.start();
};

// --- how far apart two ends are ---

double turned_apart(const Rotation<2>& a, const Rotation<2>& b) {
  return std::abs(a.angle - b.angle);
}
double turned_apart(const Rotation<3>& a, const Rotation<3>& b) {
  const glm::dquat d = a.q * glm::conjugate(b.q);
  return 2 * glm::length(Vec<3>(d.x, d.y, d.z));
}

struct Apart {
  double places = 0, turns = 0, velocities = 0, momenta = 0;
  std::array<double, 4> all() const { return {places, turns, velocities, momenta}; }
};

constexpr std::array<const char*, 4> kWhat{"places", "turns", "velocities", "momenta"};

template <int D>
void add_apart(Apart& sum, const SmoothScene<D>& a, const SmoothScene<D>& b) {
  for (std::size_t i = 1; i < 3; ++i) {
    sum.places += glm::length(a.bodies[i].position - b.bodies[i].position);
    sum.turns += turned_apart(a.bodies[i].orientation, b.bodies[i].orientation);
    sum.velocities += glm::length(a.bodies[i].velocity - b.bodies[i].velocity);
    sum.momenta += size_of(a.bodies[i].angular_momentum - b.bodies[i].angular_momentum);
  }
}

template <int D>
void expect_turning_orders(double spin, double time, int steps, int finer) {
  constexpr int rounds = 3;
  std::array<std::array<Apart, 2>, std::size(kAllIntegrators)> errors{};
  Random random(71);
  for (int round = 0; round < rounds; ++round) {
    const SmoothScene<D> start = tumbling_pair<D>(random, spin);
    const SmoothScene<D> exact = SmallSteps<D>(start).end(time, finer * steps);
    for (std::size_t m = 0; m < errors.size(); ++m)
      for (int halving = 0; halving < 2; ++halving) {
        SmoothScene<D> scene = start;
        scene.run(kAllIntegrators[m], time / (steps << halving), steps << halving);
        add_apart(errors[m][halving], scene, exact);
      }
  }
  for (std::size_t m = 0; m < errors.size(); ++m) {
    const Integration& method = integration(kAllIntegrators[m]);
    const auto coarse = errors[m][0].all(), fine = errors[m][1].all();
    for (std::size_t k = 0; k < coarse.size(); ++k)
      EXPECT_GE(std::log2(coarse[k] / fine[k]), method.order == 1 ? 0.85 : 0.95 * method.order)
          << method.name << " in " << D << "D, about " << spin << " radians a second, " << kWhat[k];
  }
}

TEST(TurningOrders, InThePlaneEveryMethodKeepsItsOrder) { expect_turning_orders<2>(1, 1, 40, 20); }
TEST(TurningOrders, SlowTopsUnderTorquesKeepTheOrderOfTheMethod) {
  expect_turning_orders<3>(0.1, 1, 40, 20);
  expect_turning_orders<3>(1, 1, 40, 20);
}
TEST(TurningOrders, FastTopsUnderTorquesKeepTheOrderOfTheMethod) {
  expect_turning_orders<3>(10, 0.1, 40, 20);
  expect_turning_orders<3>(1000, 0.002, 40, 60);
}

// A world as a whole, whatever would part its bodies if they met.
World<3> hung_box(ContactMethod contacts, std::uint64_t seed) {
  Random random(seed);
  WorldConfig<3> config;
  config.contacts = contacts;
  config.integrator = Integrator::runge_kutta_4;
  config.gravity = {0, -5, 0};
  World<3> world(config);
  Body<3> nail, box;
  nail.shape = Sphere{0.1};
  nail.kind = BodyKind::static_body;
  const BodyId from = world.add(nail);
  box.shape = OrientedBox<3>{{0.3, 0.2, 0.5}};
  box.mass = 1;
  box.angular_drag = 0.05;
  box.position = {3, 0, 0};
  box.velocity = any_way<3>(random, 1);
  const BodyId to = world.add(box, any_way<3>(random, 5));
  world.add_spring({from, to, Vec<3>(0.0), {0.2, 0.1, -0.3}, 2.5, 25, 0.1});
  return world;
}

TEST(TurningOrders, AWorldKeepsTheOrderByEveryContactMethod) {
  for (const auto contacts : {ContactMethod::none, ContactMethod::impulse, ContactMethod::soft,
                              ContactMethod::direct, ContactMethod::lecture}) {
    const auto end = [&](int steps) {
      World<3> world = hung_box(contacts, 74);
      for (int step = 0; step < steps; ++step) world.step(0.5 / steps);
      return world.bodies().back();
    };
    const Body<3> exact = end(800);
    const auto error = [&](int steps) {
      const Body<3> body = end(steps);
      return glm::length(body.position - exact.position) +
             turned_apart(body.orientation, exact.orientation);
    };
    const double coarse = error(40);
    EXPECT_LT(coarse, 1e-4) << to_string(contacts);
    EXPECT_GE(std::log2(coarse / error(80)), 3.8) << to_string(contacts);
  }
}

// The drag alone brakes each component by its own inertia, and so turns the momentum.
TEST(TurningOrders, ABrakedTopLosesItsSpinByTheOrderOfTheMethod) {
  Random random(72);
  for (int round = 0; round < 5; ++round) {
    SmoothScene<3> start = tumbling_pair<3>(random, 3);
    start.forces = {};
    for (int i = 1; i <= 2; ++i) start.bodies[i].angular_drag = random.between(0.1, 1);
    const SmoothScene<3> exact = SmallSteps<3>(start).end(1, 1000);
    const auto error = [&](int steps) {
      SmoothScene<3> scene = start;
      scene.run(Integrator::runge_kutta_4, 1.0 / steps, steps);
      Apart apart;
      add_apart(apart, scene, exact);
      return apart.turns + apart.momenta;
    };
    EXPECT_GE(std::log2(error(50) / error(100)), 3.8) << round;
  }
}

// Where no torque acts, nothing but the exact turn is left, by every method, to the last bit.
TEST(TurningOrders, WithoutATorqueTheTopTurnsFreely) {
  Random random(73);
  for (const Integrator method : kAllIntegrators) {
    SmoothScene<3> scene = tumbling_pair<3>(random, 5);
    scene.forces.springs.clear();
    scene.forces.pushes[0].force = Vec<3>(0.0);
    for (Body<3>& body : scene.bodies) body.angular_drag = 0;
    for (int step = 0; step < 20; ++step) {
      const Rotation<3> exact = freely_turned(scene.bodies[2], 0.05);
      const Vec<3> momentum = scene.bodies[2].angular_momentum;
      scene.step(method, 0.05);
      ASSERT_EQ(scene.bodies[2].orientation.q, exact.q) << to_string(method);
      ASSERT_EQ(scene.bodies[2].angular_momentum, momentum) << to_string(method);
    }
  }
}

}  // namespace
}  // namespace lantern::physics
