// Impacts against closed forms: extreme mass ratios, restitution and speeds.
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "measure/stress_scene.hpp"

namespace lantern {
namespace {

using namespace stress;

template <int D>
WorldConfig<D> flight_rules(double gravity) {
  return {.gravity = at<D>(0, -gravity), .integrator = Integrator::velocity_verlet};
}

// A ball that loses nothing, 20 s at several steps: the largest relative change of its energy.
template <int D>
double bounce_drift(double h) {
  Body<D> ball = make_ball<D>(at<D>(0, 2));
  ball.material.restitution = 1;
  World<D> world = world_of<D>(flight_rules<D>(kGravity), {make_floor<D>(), ball});
  const auto energy = [&] {
    const Body<D>& b = world.bodies()[1];
    return kGravity * (b.position.y - 0.5) + glm::dot(b.velocity, b.velocity) / 2;
  };
  const double before = energy();
  return worst_after_steps(world, static_cast<int>(std::lround(20 / h)), h,
                           [&] { return std::abs(energy() / before - 1); });
}

template <int D>
double elastic_bounce() {
  return worst_over({1e-3, 0.01, 1.0 / 60, 0.1, 0.3, 1.0, 3.0}, bounce_drift<D>);
}

// A ball that falls from s comes to rest after sqrt(2 s/g) (1 + e)/(1 - e), after infinitely many
// bounces, of which only finitely many may be made.
StressResult zeno() {
  double worst = 0;
  std::uint64_t most = 0;
  for (const double e : {0.0, 0.3, 0.8, 0.99}) {
    Body<2> ball = make_ball<2>({0, 0.5 + 0.8});
    ball.material.restitution = e;
    World<2> world = world_of<2>(flight_rules<2>(kGravity), {make_floor<2>(), ball});
    run(world, std::sqrt(2 * 0.8 / kGravity) * (1 + e) / (1 - e) + 0.1);
    worst = largest({worst, std::abs(world.bodies()[1].position.y - 0.5),
                     std::abs(world.bodies()[1].velocity.y)});
    most = std::max(most, world.work().impacts_located);
  }
  return at_most(1e-6, worst, "m or m/s",
                 fmt::format("restitution 0, 0.3, 0.8, 0.99; at most {} impacts", most));
}

// Galperin, "Playing pool with pi" (2003): two blocks of mass ratio 100^k and a wall meet
// floor(pi 10^k) times.
double pi_by_blocks() {
  double worst = 0, ratio = 1, expected = std::numbers::pi;
  for (int k = 0; k <= 3; ++k, ratio *= 100, expected *= 10) {
    World<2> world(flight_rules<2>(0));
    Body<2> wall = make_floor<2>();
    wall.shape = HalfSpace<2>{{1, 0}};
    world.add(wall);
    const Shape<2> block = AxisBox<2>{{0.5, 0.5}};
    world.add({.name = "light", .shape = block, .position = {2, 0}, .mass = 1, .material = {1, 0}});
    world.add({.name = "heavy",
               .shape = block,
               .position = {4, 0},
               .velocity = {-1, 0},
               .mass = ratio,
               .material = {1, 0}});
    run(world, 12);
    worst = largest(
        worst, std::abs(static_cast<double>(world.work().impacts_located) - std::floor(expected)));
  }
  return worst;
}

// Central impacts with mass ratios up to 1e9: v' of both, in parts of the approach.
template <int D>
double superball() {
  double worst = 0;
  for (const double e : {0.0, 0.4, 1.0})
    for (const double ratio : {1.0, 1e3, 1e6, 1e9}) {
      World<D> world((WorldConfig<D>()));
      Body<D> ball = make_ball<D>(at<D>(-2));
      ball.velocity = at<D>(3);
      ball.material = {e, 0};
      ball.mass = ratio;
      world.add(ball);
      ball.position = at<D>(0.3);
      ball.velocity = at<D>(-1);
      ball.mass = 1;
      world.add(ball);
      run(world, 1);
      const double common = (3 * ratio - 1) / (ratio + 1);
      const double heavy = common - e * 4 / (ratio + 1);
      const double light = common + e * 4 * ratio / (ratio + 1);
      worst = largest({worst, std::abs(world.bodies()[0].velocity.x - heavy) / 4,
                       std::abs(world.bodies()[1].velocity.x - light) / 4});
    }
  return worst;
}

double cradle() {
  double worst = 0;
  for (int moving = 1; moving <= 4; ++moving) {
    World<2> world(flight_rules<2>(0));
    for (int i = 0; i < 5; ++i) {
      Body<2> ball = make_ball<2>({i < moving ? i - 1.7 : i, 0});
      ball.velocity = {i < moving ? 2.0 : 0.0, 0};
      ball.material = {1, 0};
      world.add(ball);
    }
    run(world, 1.5);
    for (int i = 0; i < 5; ++i)
      worst = largest(worst, std::abs(world.bodies()[static_cast<std::size_t>(i)].velocity.x -
                                      (i < 5 - moving ? 0 : 2)));
  }
  return worst;
}

// Balls of mass ratio 1e3 in a box, losing nothing.
StressResult billiards() {
  World<2> world((WorldConfig<2>()));
  for (int i = 0; i < 4; ++i) {
    Body<2> wall = make_floor<2>();
    const Vec<2> normal = i < 2 ? Vec<2>(i == 0 ? 1 : -1, 0) : Vec<2>(0, i == 2 ? 1 : -1);
    wall.shape = HalfSpace<2>{normal};
    wall.position = normal * -5.0;
    world.add(wall);
  }
  for (int i = 0; i < 16; ++i) {
    Body<2> ball = make_ball<2>({i % 4 * 2.0 - 3, i / 4 * 2.0 - 3}, 0.3);
    ball.velocity = {i * 0.7 - 5, 3 - i * 0.5};
    ball.material = {1, 0};
    ball.mass = i % 3 == 0 ? 1000 : 1;
    world.add(ball);
  }
  const auto energy = [&] {
    double sum = 0;
    for (const Body<2>& body : world.bodies())
      sum += body.mass * glm::dot(body.velocity, body.velocity);
    return sum;
  };
  const double before = energy();
  run(world, 20);
  return at_most(1e-11, std::abs(energy() / before - 1), "relative",
                 fmt::format("energy after {} impacts", world.work().impacts_located));
}

// A ball of 0.1 m shot at a wall of 0.02 m, at up to 1e5 m/s: 1667 m a step.
StressResult bullets() {
  int through = 0, shots = 0;
  for (const double e : {0.0, 0.5, 1.0})
    for (const double speed : {50.0, 500.0, 5e3, 1e5}) {
      Body<2> wall = make_body<2>(AxisBox<2>{{0.01, 5}}, {5, 0}, "wall");
      wall.kind = BodyKind::static_body;
      Body<2> bullet = make_ball<2>({0, 0}, 0.05);
      bullet.velocity = {speed, 0};
      bullet.material.restitution = e;
      World<2> world = world_of<2>({}, {wall, bullet});
      run(world, 0.5);
      ++shots;
      through += world.bodies()[1].position.x > 5;
    }
  return at_most(0, through, "bullets", fmt::format("through the wall, of {}", shots));
}

}  // namespace

std::vector<StressCase> impact_cases() {
  constexpr const char* kGroup = "extreme input";
  return {
      {"elastic_bounce", "bars", "A ball that loses nothing keeps its energy at any step.",
       none_above(1e-12, "relative", "20 s, 2D and 3D, steps from 1 ms to 3 s", elastic_bounce<2>,
                  elastic_bounce<3>)},
      {"zeno", kGroup, "A bouncing ball comes to rest when it should, after finitely many impacts.",
       zeno},
      {"pi_by_blocks", kGroup, "Two blocks of mass ratio 1e6 and a wall count the digits of pi.",
       none_above(0, "impacts", "off floor(pi 10^k), k = 0 ... 3: 3, 31, 314, 3141", pi_by_blocks)},
      {"superball", kGroup, "Central impacts of mass ratios up to 1e9 follow the closed form.",
       none_above(1e-12, "relative", "2D and 3D, mass ratios 1 to 1e9, restitution 0, 0.4, 1",
                  superball<2>, superball<3>)},
      {"cradle", kGroup, "Newton's cradle passes each blow on.",
       none_above(1e-12, "m/s", "five balls, one to four of them moving", cradle)},
      {"billiards", kGroup, "Elastic balls of mass ratio 1e3 keep their energy.", billiards},
      {"bullets", kGroup, "No bullet goes through a thin wall.", bullets}};
}

}  // namespace lantern
