// An error that is wanted of contacts: what it costs, and what it gives.
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "physics/forces.hpp"
#include "physics/world.hpp"
#include "world_scene.hpp"

namespace lantern::physics {
namespace {

template <int D>
WorldConfig<D> quick(double wanted_error) {
  WorldConfig<D> config = falling<D>();
  config.wanted_error = wanted_error;
  config.may_sleep = false;
  return config;
}

// Boxes that fall askew between walls six units apart.
template <int D>
World<D> heap(const WorldConfig<D>& config, int count) {
  World<D> world(config);
  world.add(floor_at<D>());
  for (int axis = 0; axis < D; ++axis)
    for (const double side : {-1.0, 1.0}) {
      if (axis == 1) continue;
      Body<D> wall = floor_at<D>();
      Vec<D> normal(0.0), place(0.0);
      normal[axis] = -side;
      place[axis] = side * 3;
      wall.shape = HalfSpace<D>{normal};
      wall.position = place;
      world.add(wall);
    }
  std::mt19937 random(7);
  for (int i = 0; i < count; ++i) {
    Body<D> box = box_at<D>(along<D>(-2.2 + 1.3 * (i % 4) + 0.6 * (i / 4 % 2), 1 + 1.5 * (i / 4)));
    box.orientation = turned(box.orientation,
                             1e-10 * static_cast<double>(random()) * unit_spin<D>(D == 2 ? 0 : 2));
    world.add(box);
  }
  return world;
}

template <int D>
double mean_depth(const World<D>& world) {
  double sum = 0;
  int points = 0;
  for (const Contact<D>& contact : world.contacts())
    for (const ManifoldPoint<D>& point : contact.manifold.points()) {
      sum += std::max(0.0, -point.separation);
      ++points;
    }
  return sum / points;
}

template <int D>
double fastest(const World<D>& world) {
  double speed = 0;
  for (const Body<D>& body : world.bodies()) speed = std::max(speed, glm::length(body.velocity));
  return speed;
}

// Over the whole run.
template <int D>
double worst_mean_depth(World<D>& world, double seconds) {
  double depth = 0;
  for (int i = 0; i < seconds / kStep; ++i) {
    world.step(kStep);
    if (!world.contacts().empty()) depth = std::max(depth, mean_depth(world));
  }
  return depth;
}

template <int D>
void from_quick_to_exact(int count, double seconds) {
  double depth = 1;
  std::uint64_t rows = 0;
  for (const double error : {1e-1, 1e-2, 1e-3}) {
    World<D> world = heap<D>(quick<D>(error), count);
    const double found = worst_mean_depth(world, seconds);
    EXPECT_LT(found, depth) << error;
    EXPECT_LT(found, error) << error;
    const WorldWork& work = world.work();
    EXPECT_GT(work.constraint_rows, rows) << error;
    // Each sweep looks at a point's normal, and then at D - 1 tangents, if anything presses.
    EXPECT_GT(work.friction_rows, 0u) << error;
    EXPECT_LE(work.friction_rows, (D - 1) * work.normal_rows) << error;
    depth = found;
    rows = world.work().constraint_rows;
  }
}

TEST(WantedError, GoesFromQuickToExactIn2D) { from_quick_to_exact<2>(40, 1.5); }
TEST(WantedError, GoesFromQuickToExactIn3D) { from_quick_to_exact<3>(24, 0.8); }

TEST(WantedError, WhatIsExactComesToRest) {
  World<2> world = heap<2>(quick<2>(1e-6), 12);
  run(world, 6);
  EXPECT_LT(fastest(world), 1e-6);
}

TEST(WantedError, MakesNoEnergy) {
  for (const double error : {0.3, 1e-2}) {
    World<2> world = heap<2>(quick<2>(error), 28);
    const auto energy_of = [&] {
      const Energy sum = energy<2>(world.bodies(), world.forces());
      return sum.linear + sum.rotational + sum.gravity;
    };
    const double before = energy_of();
    for (int i = 0; i < 120; ++i) {
      world.step(kStep);
      EXPECT_LT(energy_of(), before * (1 + 1e-9));
    }
  }
}

TEST(WantedError, IsTheSameWhateverTheBroadPhase) {
  std::optional<std::uint64_t> hash;
  for (const StructureKind kind :
       {StructureKind::brute_force, StructureKind::quadtree, StructureKind::sort_and_sweep}) {
    WorldConfig<2> config = quick<2>(1e-2);
    config.broad_phase.kind = kind;
    World<2> world = heap<2>(config, 20);
    run(world, 2);
    EXPECT_EQ(world.hash(), hash.value_or(world.hash()));
    hash = world.hash();
  }
}

TEST(WantedError, LeavesSmallIslandsToTheExactSolve) {
  const auto run_of = [](double error) {
    World<2> world(quick<2>(error));
    world.add(floor_at<2>());
    for (int i = 0; i < 4; ++i) world.add(box_at<2>(along<2>(0, 0.5 + i)));
    run(world, 1);
    return world.hash();
  };
  EXPECT_EQ(run_of(1e-2), run_of(0));
}

TEST(WantedError, IsRefusedIfItIsNone) {
  for (const double error :
       {-1e-3, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(World<2>(quick<2>(error)), Refused);
}

}  // namespace
}  // namespace lantern::physics
