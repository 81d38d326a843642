// Far from the origin: the same motion, but for the digits that the place itself takes away.
#include <cmath>

#include <fmt/format.h>

#include "base/random.hpp"
#include "measure/stress_scene.hpp"
#include "physics/manifold.hpp"

namespace lantern::measure {
namespace {

using namespace stress;

// Places relative to the origin after `steps` steps: a pile, a ball that rolls into it, a pendulum
// on a spring and one on a rod, around a point that is `offset` away on every axis but the height.
template <int D>
std::vector<Vec<D>> relative_places(double offset, int steps) {
  World<D> world(with_gravity<D>());
  Vec<D> origin(offset);
  origin.y = 0;
  world.add(make_floor<D>());
  world.add(make_box<D>(origin + at<D>(0, 0.5)));
  world.add(make_box<D>(origin + at<D>(0.25, 1.5)));
  Body<D> ball = make_ball<D>(origin + at<D>(4, 0.5));
  ball.velocity = at<D>(-3);
  world.add(ball);
  Body<D> hook = make_anchor<D>();
  hook.position = origin + at<D>(-8, 6);
  const BodyId anchor = world.add(hook);
  const BodyId sprung = world.add(make_ball<D>(origin + at<D>(-7, 4), 0.2));
  world.add_spring({.a = anchor, .b = sprung, .rest_length = 2, .stiffness = 10});
  const BodyId hung = world.add(make_ball<D>(origin + at<D>(-10, 6), 0.2));
  world.add_joint({.kind = JointKind::distance, .a = anchor, .b = hung, .length = 2});
  for (int i = 0; i < steps; ++i) world.step(kStep);
  std::vector<Vec<D>> places;
  for (const Body<D>& body : world.bodies())
    if (body.kind == BodyKind::dynamic_body) places.push_back(body.position - origin);
  return places;
}

template <int D>
double worst_deviation(double offset, int steps) {
  const auto near = relative_places<D>(0, steps), far = relative_places<D>(offset, steps);
  double worst = 0;
  for (std::size_t i = 0; i < near.size(); ++i)
    worst = largest(worst, glm::length(far[i] - near[i]));
  return worst;
}

StressResult moved_by(double offset) {
  const int steps = 60;
  const double ulp = std::nextafter(offset, 2 * offset) - offset;
  const double worst =
      largest(worst_deviation<2>(offset, steps), worst_deviation<3>(offset, steps));
  return at_most(8, worst / ulp / steps, "ulp a step",
                 fmt::format("{:.1e} m after {} steps, 2D and 3D", worst, steps));
}

template <int D>
double settling_error() {
  const double offset = 1e7;
  World<D> world =
      world_of<D>(with_gravity<D>(), {make_floor<D>(), make_box<D>(at<D>(offset, 0.6))});
  run(world, 10);
  return glm::length(world.bodies()[1].position - at<D>(offset, 0.5));
}

// Boxes of all sizes that touch or overlap by the least, far away. The narrow phase subtracts
// positions first and finds them; rounded as they are, their enveloping boxes must let it look.
template <int D>
int contacts_unseen(double offset, int& touching) {
  Random random(11);
  int unseen = 0;
  for (int round = 0; round < 1000; ++round) {
    Vec<D> place, way(0.0);
    for (int i = 0; i < D; ++i) place[i] = offset + random.between(-1, 1);
    way[static_cast<int>(random.whole(0, D - 1))] = 1;
    const double size = round % 2 == 0 ? 1 : 1e-3;
    const double a = size * random.between(0.1, 1), b = size * random.between(0.1, 1);
    World<D> world((WorldConfig<D>()));
    world.add(make_body<D>(AxisBox<D>{Vec<D>(a)}, place, "first"));
    world.add(make_body<D>(AxisBox<D>{Vec<D>(b)}, place + way * (a + b), "second"));
    const Body<D>&first = world.bodies()[0], &second = world.bodies()[1];
    if (!collide<D>({first.shape, first.position, {}}, {second.shape, second.position, {}}, 0))
      continue;
    ++touching;
    world.step(1e-9);
    unseen += world.pairs().empty();
  }
  return unseen;
}

StressResult boxes_round_outward() {
  int touching = 0, unseen = 0;
  for (const double offset : {0.0, 1e6, 1e9})
    unseen += contacts_unseen<2>(offset, touching) + contacts_unseen<3>(offset, touching);
  return at_most(0, unseen, "contacts",
                 fmt::format("that the broad phase does not see, of {}", touching));
}

}  // namespace

std::vector<StressCase> origin_cases() {
  constexpr const char* kGroup = "extreme input";
  return {
      {"origin_moved_by_1e6", kGroup, "A million metres away the relative motion is the same.",
       [] { return moved_by(1e6); }},
      {"origin_moved_by_1e9", kGroup, "A billion metres away the relative motion is the same.",
       [] { return moved_by(1e9); }},
      {"far_from_origin", "bars", "A box settles in its place, 1e7 m from the origin.",
       none_above(1e-6, "m", "a box that settles 1e7 m away, 2D and 3D", settling_error<2>,
                  settling_error<3>)},
      {"boxes_round_outward", kGroup,
       "Shapes that touch have boxes that do, however far from the origin.", boxes_round_outward}};
}

}  // namespace lantern::measure
