// Impacts and friction against closed forms: extreme mass ratios, restitution and speeds; how far a
// body slides, and whether it sticks.
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "measure/stress_scene.hpp"

namespace lantern::measure {
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

// --- friction ---

// How far from v^2/(2 mu g) a box stops that is thrown along the floor in direction `heading`.
template <int D>
double sliding_error(double mu, double speed, double heading) {
  Body<D> box = make_box<D>(at<D>(0, 0.5));
  box.material.friction = mu;
  box.may_turn = false;
  Vec<D> way = at<D>(1);
  if constexpr (D == 3) way = {std::cos(heading), 0, std::sin(heading)};
  box.velocity = way * speed;
  World<D> world = world_of<D>(with_gravity<D>(), {make_floor<D>(0, mu), box});
  run(world, speed / (mu * kGravity) + 0.5);
  const Vec<D> end = world.bodies()[1].position - at<D>(0, 0.5);
  return glm::length(end - way * (speed * speed / (2 * mu * kGravity)));
}

template <int D>
double sliding() {
  return worst_over({0.1, 0.5, 1.0, 10.0}, [](double mu) { return sliding_error<D>(mu, 5, 0); });
}

// The friction is a cone, not a pyramid: no heading is better than another.
double headings() {
  double worst = 0;
  for (int i = 0; i < 24; ++i)
    worst = largest(worst, sliding_error<3>(0.5, 3, 2 * std::numbers::pi * i / 24));
  return worst;
}

// Sleep is off: what is at the edge of sliding starts as slowly as what comes to rest.
template <int D>
World<D> on_slope(double alpha, double friction, Body<D> body) {
  body.material.friction = friction;
  return world_of<D>({.gravity = at<D>(kGravity * std::sin(alpha), -kGravity * std::cos(alpha)),
                      .may_sleep = false},
                     {make_floor<D>(0, friction), body});
}

// On a slope a body sticks if and only if tan(alpha) <= mu; beyond, it slides at
// g (sin(alpha) - mu cos(alpha)).
template <int D>
double incline_error(double mu, double off) {
  if (mu + off < 0) return 0;
  const double alpha = std::atan(mu + off);
  Body<D> box = make_box<D>(at<D>(0, 0.5));
  box.may_turn = false;
  World<D> world = on_slope<D>(alpha, mu, box);
  run(world, 2);
  const double slides = largest(0.0, kGravity * (std::sin(alpha) - mu * std::cos(alpha)));
  return std::abs(world.bodies()[1].velocity.x - 2 * slides);
}

template <int D>
double incline() {
  return worst_over({0.0, 0.5, 10.0}, [](double mu) {
    return largest(incline_error<D>(mu, -1e-4), incline_error<D>(mu, 1e-4));
  });
}

// A tower of w : h = 1 : 4 topples where the slope is steeper than 1/4.
double topple() {
  int wrong = 0;
  for (const double off : {-0.01, -0.001, 0.001, 0.01}) {
    const double alpha = std::atan(0.25 * (1 + off));
    World<2> world = on_slope<2>(alpha, 2, make_body<2>(OrientedBox<2>{{0.5, 2}}, {0, 2}, "tower"));
    run(world, 20);
    wrong += (std::abs(world.bodies()[1].orientation.angle) > 1) != (off > 0);
  }
  return wrong;
}

// A ball that does not slip rolls at 5/7 g sin(alpha).
double rolling() {
  return worst_over({0.01, 0.3, 1.0}, [](double alpha) {
    World<3> world = on_slope<3>(alpha, 2, make_ball<3>({0, 0.5, 0}));
    run(world, 2);
    const double expected = 5.0 / 7 * kGravity * std::sin(alpha) * 2;
    return std::abs(world.bodies()[1].velocity.x / expected - 1);
  });
}

}  // namespace

std::vector<StressCase> contact_cases() {
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
      {"bullets", kGroup, "No bullet goes through a thin wall.", bullets},
      {"sliding", "bars", "A box thrown along the floor stops after v^2/(2 mu g).",
       none_above(1e-6, "m", "5 m/s, friction 0.1, 0.5, 1, 10; 2D and 3D", sliding<2>, sliding<3>)},
      {"headings", "bars", "A box slides equally far in every direction.",
       none_above(1e-6, "m", "24 headings, 3 m/s, friction 0.5", headings)},
      {"incline", kGroup, "A box sticks on a slope exactly if tan(alpha) is at most its friction.",
       none_above(5e-5, "m/s", "after 2 s, tan = friction ± 1e-4; friction 0, 0.5, 10", incline<2>,
                  incline<3>)},
      {"topple", kGroup, "A tower topples exactly where its weight passes its edge.",
       none_above(0, "towers", "of 4, slopes within 1e-3 of the edge", topple)},
      {"rolling", kGroup, "A ball rolls down at 5/7 of what it would slide.",
       none_above(1e-6, "relative", "speed after 2 s, slopes 0.01, 0.3, 1 rad", rolling)}};
}

}  // namespace lantern::measure
