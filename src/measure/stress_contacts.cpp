// Impacts and friction against closed forms that no scenario's `expect` can say.
#include <cmath>
#include <numbers>

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

}  // namespace

std::vector<StressCase> contact_cases() {
  constexpr const char* kGroup = "extreme input";
  return {
      {"elastic_bounce", "bars", "A ball that loses nothing keeps its energy at any step.",
       none_above(1e-12, "relative", "20 s, 2D and 3D, steps from 1 ms to 3 s", elastic_bounce<2>,
                  elastic_bounce<3>)},
      {"pi_by_blocks", kGroup, "Two blocks of mass ratio 1e6 and a wall count the digits of pi.",
       none_above(0, "impacts", "off floor(pi 10^k), k = 0 ... 3: 3, 31, 314, 3141", pi_by_blocks)},
      {"sliding", "bars", "A box thrown along the floor stops after v^2/(2 mu g).",
       none_above(1e-6, "m", "5 m/s, friction 0.1, 0.5, 1, 10; 2D and 3D", sliding<2>, sliding<3>)},
      {"headings", "bars", "A box slides equally far in every direction.",
       none_above(1e-6, "m", "24 headings, 3 m/s, friction 0.5", headings)}};
}

}  // namespace lantern::measure
