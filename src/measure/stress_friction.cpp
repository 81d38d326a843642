// Friction at its limits: how far a body slides, and whether it sticks.
#include <cmath>
#include <numbers>

#include "measure/stress_scene.hpp"

namespace lantern {
namespace {

using namespace stress;

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

std::vector<StressCase> friction_cases() {
  constexpr const char* kGroup = "extreme input";
  return {
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

}  // namespace lantern
