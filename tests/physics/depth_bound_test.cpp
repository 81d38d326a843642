// An error that is wanted is kept: no two bodies come to lie deeper in each other by a step.
#include <map>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "physics/world.hpp"
#include "world_scene.hpp"

namespace lantern::physics {
namespace {

constexpr double kStrictest = 1e-6;  // what 0 asks for

using Depths = std::map<std::pair<BodyId, BodyId>, double>;

// Of all pairs of bodies where they stand now, but for those that joints let overlap.
template <int D>
Depths depths(const World<D>& world) {
  Depths found;
  const auto joined = [&](const Body<D>& a, const Body<D>& b) {
    return std::ranges::any_of(world.joints(), [&](const auto& entry) {
      return std::minmax(entry.second.a, entry.second.b) == std::minmax(a.id, b.id);
    });
  };
  for (const Body<D>& a : world.bodies())
    for (const Body<D>& b : world.bodies()) {
      if (b.id <= a.id || (!a.is_dynamic() && !b.is_dynamic()) || !overlap(a.box(), b.box()))
        continue;
      const auto seen = collide(placed(a), placed(b), 0);
      if (!seen || joined(a, b)) continue;
      for (const ManifoldPoint<D>& p : seen->points())
        found[{a.id, b.id}] = std::max(found[{a.id, b.id}], -p.separation);
    }
  return found;
}

// How much deeper than `wanted`, and than before, any pair lies after one of the steps.
template <int D>
double beyond(World<D>& world, double wanted, double seconds) {
  double worst = 0;
  Depths before = depths(world);
  for (int i = 0; i < seconds / kStep; ++i) {
    world.step(kStep);
    Depths now = depths(world);
    for (const auto& [pair, depth] : now)
      worst = std::max(worst, depth - std::max(wanted, before[pair]));
    before = std::move(now);
  }
  return worst;
}

class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}
  double operator()(double from, double to) {
    return from + (to - from) * static_cast<double>(random_()) * 0x1p-32;
  }
  template <int D>
  Spin<D> spin(double most) {
    if constexpr (D == 2)
      return (*this)(-most, most);
    else
      return {(*this)(-most, most), (*this)(-most, most), (*this)(-most, most)};
  }
  template <int D>
  Shape<D> shape() {
    const double kind = (*this)(0, 4);
    if (kind < 1) return Sphere{(*this)(0.2, 0.4)};
    if (kind < 2) return Capsule{(*this)(0.1, 0.2), (*this)(0.1, 0.4)};
    Vec<D> half(0.04);  // of a needle
    half.x = 0.5;
    for (int i = 0; kind < 3 && i < D; ++i) half[i] = (*this)(0.2, 0.4);
    return OrientedBox<D>{half};
  }

 private:
  std::mt19937 random_;
};

// A room into which all kinds of bodies fall, and spin.
template <int D>
World<D> room(const WorldConfig<D>& config, int count, unsigned seed, double bounce = 0) {
  World<D> world(config);
  world.add(floor_at<D>());
  for (int axis = 0; axis < D; ++axis)
    for (const double side : {-1.0, 1.0}) {
      if (axis == 1) continue;
      Body<D> wall = floor_at<D>();
      Vec<D> normal(0.0);
      normal[axis] = -side;
      wall.shape = HalfSpace<D>{normal};
      wall.position = normal * -2.0;
      world.add(wall);
    }
  Dice dice(seed);
  for (int i = 0; i < count; ++i) {
    Body<D> body;
    body.shape = dice.shape<D>();
    body.position = along<D>(-1.2 + 1.2 * (i % 3) + dice(-0.05, 0.05), 0.8 + 1.2 * (i / 3));
    if constexpr (D == 3) body.position.z = dice(-1, 1);
    body.orientation = turned(body.orientation, dice.spin<D>(3));
    body.material = {.restitution = bounce * dice(0, 1), .friction = dice(0, 1)};
    world.add(body, dice.spin<D>(12));
  }
  return world;
}

template <int D>
WorldConfig<D> wanting(std::optional<double> error, ContactMethod method = ContactMethod::soft) {
  WorldConfig<D> config = falling<D>();
  config.contacts = method;
  config.wanted_error = error;
  config.may_sleep = false;
  return config;
}

template <int D>
void keeps_every_error() {
  unsigned seed = 30;
  for (const double error : {0.0, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1}) {
    World<D> world = room<D>(wanting<D>(error), D == 2 ? 9 : 7, ++seed);
    EXPECT_LE(beyond(world, std::max(error, kStrictest), 1.2), 1e-9) << error;
    EXPECT_EQ(world.work().errors_missed, 0u) << error;
  }
}
TEST(DepthBound, IsKeptWhateverIsWantedIn2D) { keeps_every_error<2>(); }
TEST(DepthBound, IsKeptWhateverIsWantedIn3D) { keeps_every_error<3>(); }

template <int D>
void keeps_it_by_every_method() {
  unsigned seed = 50;
  for (const ContactMethod method :
       {ContactMethod::soft, ContactMethod::impulse, ContactMethod::direct})
    for (const double bounce : {0.0, 0.6}) {
      World<D> world = room<D>(wanting<D>(1e-3, method), 8, ++seed, bounce);
      EXPECT_LE(beyond(world, 1e-3, 1), 1e-9) << to_string(method) << bounce;
      EXPECT_EQ(world.work().errors_missed, 0u) << to_string(method) << bounce;
    }
}
TEST(DepthBound, IsKeptByEveryMethodIn2D) { keeps_it_by_every_method<2>(); }
TEST(DepthBound, IsKeptByEveryMethodIn3D) { keeps_it_by_every_method<3>(); }

TEST(DepthBound, WithoutOneBodiesLieDeeper) {
  World<2> world = room<2>(wanting<2>(std::nullopt), 12, 34);
  EXPECT_GT(beyond(world, 1e-3, 1.5), 0.0);
}

// What was put into each other may lie so until it is out, and no deeper.
template <int D>
void parts_what_overlaps() {
  World<D> world(wanting<D>(1e-4));
  world.add(floor_at<D>());
  for (int i = 0; i < 5; ++i) world.add(box_at<D>(along<D>(0.1 * i, 0.4 + 0.7 * i)));
  EXPECT_LE(beyond(world, 1e-4, 2), 1e-9);
  const Depths left = depths(world);
  for (const auto& [pair, depth] : left) EXPECT_LE(depth, 1e-4);
}
TEST(DepthBound, LetsPartWhatOverlapsIn2D) { parts_what_overlaps<2>(); }
TEST(DepthBound, LetsPartWhatOverlapsIn3D) { parts_what_overlaps<3>(); }

// Rods of a chain, pinned to each other, fall upon a heap.
template <int D>
void pins_hold_beside_it() {
  World<D> world = room<D>(wanting<D>(1e-4), 6, 71);
  std::optional<BodyId> last;
  for (int i = 0; i < 4; ++i) {
    Body<D> rod = box_at<D>(along<D>(-1.2 + 0.6 * i, 4), 0.1);
    Vec<D> half(0.1);
    half.x = 0.28;
    rod.shape = OrientedBox<D>{half};
    const BodyId id = world.add(rod);
    if (last) world.add_joint({.a = *last, .b = id, .at_a = along<D>(0.3), .at_b = along<D>(-0.3)});
    last = id;
  }
  EXPECT_LE(beyond(world, 1e-4, 1.5), 1e-9);
  EXPECT_EQ(world.work().errors_missed, 0u);
  for (const auto& [id, joint] : world.joints()) {
    const Body<D>&a = *world.find(joint.a), &b = *world.find(joint.b);
    EXPECT_LE(glm::length(a.position + matrix(a.orientation) * joint.at_a - b.position -
                          matrix(b.orientation) * joint.at_b),
              1e-6);
  }
}
TEST(DepthBound, PartsNoPinsIn2D) { pins_hold_beside_it<2>(); }
TEST(DepthBound, PartsNoPinsIn3D) { pins_hold_beside_it<3>(); }

// Between walls that close nothing can keep it: that is counted, and the run goes on.
template <int D>
void counts_what_it_misses() {
  World<D> world(wanting<D>(1e-3));
  world.add(floor_at<D>());
  Body<D> press = floor_at<D>(1.5);
  press.shape = HalfSpace<D>{up<D>(-1)};
  press.kind = BodyKind::kinematic_body;
  press.velocity = up<D>(-1);
  world.add(press);
  world.add(box_at<D>(up<D>(0.5)));
  run(world, 0.45);
  EXPECT_EQ(world.work().errors_missed, 0u);
  run(world, 0.25);
  EXPECT_GT(world.work().errors_missed, 0u);
}
TEST(DepthBound, CountsWhatItMissesIn2D) { counts_what_it_misses<2>(); }
TEST(DepthBound, CountsWhatItMissesIn3D) { counts_what_it_misses<3>(); }

TEST(DepthBound, IsNoMatterWhereThingsOverflow) {
  for (const double speed : {1e150, 1e300, 1e308}) {
    World<2> world = room<2>(wanting<2>(0), 3, 5);
    world.set_velocity(world.bodies().back().id, up<2>(-speed));
    try {
      for (int i = 0; i < 3; ++i) world.step(kStep);
    } catch (const Refused&) {
    }
    for (const Body<2>& body : world.bodies())
      EXPECT_TRUE(std::isfinite(body.position.x + body.position.y)) << speed;
  }
}

// Where bodies rest, next to nothing is measured.
TEST(DepthBound, CostsNothingAtRest) {
  World<2> world(wanting<2>(1e-2));
  world.add(floor_at<2>());
  for (int i = 0; i < 12; ++i) world.add(box_at<2>(along<2>(1.2 * (i % 3), 0.5 + i / 3)));
  run(world, 2);
  const WorldWork before = world.work();
  run(world, 1);
  const WorldWork work = work_between(before, world.work());
  EXPECT_LE(100 * work.narrow_tests, 101 * work.narrow_pairs);
}

}  // namespace
}  // namespace lantern::physics
