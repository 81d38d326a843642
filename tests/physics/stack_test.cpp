// Piles: what stands must stand.
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "world_scene.hpp"

namespace lantern::physics {
namespace {

template <int D>
void expect_stands(int count, int sub_steps, double seconds) {
  WorldConfig<D> config = falling<D>();
  config.sub_steps = sub_steps;
  config.may_sleep = false;
  World<D> world(config);
  world.add(floor_at<D>());
  for (int i = 0; i < count; ++i) world.add(box_at<D>(up<D>(0.5 + i)));
  double depth = 0;
  for (int i = 0; i < seconds * 60; ++i) {
    world.step(kStep);
    depth = std::max(depth, deepest(world));
  }
  for (int i = 0; i < count; ++i) {
    const Body<D>& box = world.bodies()[static_cast<std::size_t>(i + 1)];
    ASSERT_LE(glm::length(box.position - up<D>(0.5 + i)), 1e-4) << D << "D: box " << i << " moved";
  }
  EXPECT_LE(depth, 1e-4) << D << "D, " << count << " boxes";
}

TEST(Stack, OfTenStands) {
  expect_stands<2>(10, 8, 10);
  expect_stands<3>(10, 8, 4);
}

TEST(Stack, OfSixtyStands) { expect_stands<2>(60, 16, 10); }

TEST(Stack, OfBoxesInAnyOrderStands) {
  World<2> world(falling<2>());
  world.add(floor_at<2>());
  for (int i = 0; i < 10; ++i) world.add(box_at<2>(up<2>(0.5 + (i * 7) % 10)));
  run(world, 5);
  EXPECT_LE(deepest(world), 1e-4);
  for (int i = 0; i < 10; ++i)
    EXPECT_NEAR(world.bodies()[static_cast<std::size_t>(i + 1)].position.y, 0.5 + (i * 7) % 10,
                1e-4);
}

template <int D>
void expect_heavy_rests_on_light(double ratio) {
  WorldConfig<D> config = falling<D>();
  config.sub_steps = 16;
  World<D> world(config);
  world.add(floor_at<D>());
  world.add(box_at<D>(up<D>(0.5)));
  Body<D> heavy = box_at<D>(up<D>(1.5));
  heavy.density = ratio;
  world.add(heavy);
  double depth = 0;
  for (int i = 0; i < 300; ++i) {
    world.step(kStep);
    depth = std::max(depth, deepest(world));
  }
  EXPECT_LE(depth, 1e-4) << D << "D, " << ratio;
  EXPECT_NEAR(world.bodies()[2].position.y, 1.5, 1e-4);
}

TEST(Stack, HeavyRestsOnLight) {
  for (const double ratio : {100.0, 1e4, 1e6}) expect_heavy_rests_on_light<2>(ratio);
  for (const double ratio : {100.0, 1e4}) expect_heavy_rests_on_light<3>(ratio);
}

TEST(Stack, TheImpulseMethodHoldsALowOne) {
  WorldConfig<2> config = falling<2>();
  config.contacts = ContactMethod::impulse;
  config.iterations = 30;
  World<2> world(config);
  world.add(floor_at<2>());
  for (int i = 0; i < 3; ++i) world.add(box_at<2>(up<2>(0.5 + i)));
  run(world, 5);
  EXPECT_LE(deepest(world), 0.02);
  EXPECT_NEAR(world.bodies()[3].position.y, 2.5, 0.05);
}

// A little out of line, so that corners end other faces from step to step.
template <int D>
void expect_sweeps_hold(int count, double rate, std::uint64_t seed, Integrator integrator) {
  WorldConfig<D> config = falling<D>();
  config.contacts = ContactMethod::impulse;
  config.integrator = integrator;
  config.may_sleep = false;
  World<D> world(config);
  world.add(floor_at<D>());
  Random random(seed);
  for (int i = 0; i < count; ++i)
    world.add(box_at<D>(along<D>(random.between(-0.02, 0.02), 0.5 + i)));
  const std::vector<Body<D>> start = world.bodies();
  for (int i = 0; i < 10 * rate; ++i) world.step(1 / rate);
  for (int i = 1; i <= count; ++i) {
    const std::size_t at = static_cast<std::size_t>(i);
    ASSERT_LE(glm::length(world.bodies()[at].position - start[at].position), 0.2)
        << D << "D: box " << i << " of " << count << " at " << rate << ", seed " << seed;
  }
}

TEST(Stack, TenSweepsHoldTen) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    expect_sweeps_hold<2>(8, 60, seed, Integrator::velocity_verlet);
    expect_sweeps_hold<2>(10, 60, seed, Integrator::semi_implicit_euler);
    expect_sweeps_hold<3>(10, 100, seed, Integrator::semi_implicit_euler);
  }
  expect_sweeps_hold<2>(20, 120, 7, Integrator::semi_implicit_euler);
}

// It is the solve of all rows at once that holds it, not the sub-steps.
TEST(Stack, WithoutSubStepsTheDirectMethodHoldsHeavyOnLight) {
  const auto sinks = [](ContactMethod method) {
    WorldConfig<2> config = falling<2>();
    config.contacts = method;
    World<2> world(config);
    world.add(floor_at<2>());
    world.add(box_at<2>(up<2>(0.5)));
    Body<2> heavy = box_at<2>(up<2>(1.5));
    heavy.density = 1e4;
    world.add(heavy);
    run(world, 3);
    EXPECT_EQ(world.work().direct_solves > 0, method == ContactMethod::direct);
    return 1.5 - world.bodies()[2].position.y;
  };
  EXPECT_LE(sinks(ContactMethod::direct), 1e-4);
  EXPECT_GT(sinks(ContactMethod::impulse), 0.1);
}

TEST(Stack, APyramidStands) {
  World<2> world(falling<2>());
  world.add(floor_at<2>());
  std::vector<Vec<2>> places;
  for (int row = 0; row < 8; ++row)
    for (int i = 0; i < 8 - row; ++i) places.push_back({i * 1.1 + row * 0.55, 0.5 + row});
  for (const Vec<2>& place : places) world.add(box_at<2>(place));
  run(world, 5);
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_LE(glm::length(world.bodies()[i + 1].position - places[i]), 1e-3) << "box " << i;
}

}  // namespace
}  // namespace lantern::physics
