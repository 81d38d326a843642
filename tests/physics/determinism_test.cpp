// The same input gives the same bits, whatever finds the pairs; and nothing is done that a scene
// does not need.
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "world_scene.hpp"

namespace lantern::physics {
namespace {

template <int D>
World<D> crowd(WorldConfig<D> config) {
  World<D> world(config);
  Random random(7);
  world.add(floor_at<D>());
  for (int i = 0; i < 40; ++i) {
    Vec<D> place = up<D>(1 + i / 4 * 1.2);
    place.x = i % 4 * 1.1 + random.between(0, 0.2);
    Body<D> body = i % 3 == 0 ? ball_at<D>(place) : box_at<D>(place, 0.4);
    body.material.restitution = i % 5 == 0 ? 0.4 : 0;
    body.velocity.x = random.between(-2, 2);
    world.add(body);
  }
  return world;
}

template <int D>
void expect_same_over_broad_phases() {
  std::optional<std::uint64_t> expected;
  for (const StructureKind kind : kStructureKinds) {
    if (!is_possible(kind, D)) continue;
    WorldConfig<D> config = falling<D>();
    config.broad_phase.kind = kind;
    World<D> world = crowd(config);
    run(world, 0.4);
    if (!expected) expected = world.hash();
    EXPECT_EQ(world.hash(), *expected)
        << D << "D: " << to_string(kind) << " changes the trajectory";
  }
}

TEST(Determinism, EveryBroadPhaseGivesTheSameBits) {
  expect_same_over_broad_phases<2>();
  expect_same_over_broad_phases<3>();
}

// Pinned: the same over compilers and build types. To be renewed when the method changes.
TEST(Determinism, IsTheSameOnEveryBuild) {
  World<2> flat = crowd(falling<2>());
  World<3> deep = crowd(falling<3>());
  run(flat, 1);
  run(deep, 1);
  EXPECT_EQ(flat.hash(), 2802709891087260123u);
  EXPECT_EQ(deep.hash(), 7794140939752423960u);
}

TEST(Determinism, SwitchingTheBroadPhaseMidRunChangesNothing) {
  World<2> one = crowd(falling<2>()), other = crowd(falling<2>());
  run(one, 1);
  run(other, 0.5);
  BroadPhaseConfig<2> config;
  config.kind = StructureKind::sort_and_sweep;
  other.switch_broad_phase(config);
  run(other, 0.5);
  EXPECT_EQ(one.hash(), other.hash());
}

TEST(Determinism, RepeatsItself) {
  World<3> one = crowd(falling<3>()), other = crowd(falling<3>());
  run(one, 0.5);
  run(other, 0.5);
  EXPECT_EQ(one.hash(), other.hash());
}

// A stage that is forced on but has nothing to do gives the same bits.
// Whether a picture was made between two steps must not be seen, neither in the motion nor in what
// was counted for it.
TEST(Determinism, LookingAheadChangesNoBitAndNoCounter) {
  World<2> looked = crowd(falling<2>()), blind = crowd(falling<2>());
  for (World<2>* world : {&looked, &blind}) {  // struck, they fly farther than was looked for
    Body<2> shot = ball_at<2>({-30, 2}, {400, 0}, 0.4);
    shot.material.restitution = 1;
    world->add(shot);
  }
  for (int i = 0; i < 60; ++i) {
    looked.look_ahead(kStep);
    looked.step(kStep);
    blind.step(kStep);
  }
  EXPECT_GT(blind.work().retries, 0u) << "no step was made anew: no test";
  EXPECT_EQ(looked.hash(), blind.hash());
  for (const WorldCounter& counter : kWorldCounters)
    EXPECT_EQ(looked.work().*counter.count, blind.work().*counter.count) << counter.name;
}

TEST(Determinism, StagesThatAreNotNeededChangeNothing) {
  const auto hash_with = [](ContactMethod method) {
    WorldConfig<3> config = falling<3>();
    config.contacts = method;
    World<3> world(config);
    for (int i = 0; i < 10; ++i) {
      Body<3> body = box_at<3>(along<3>(5.0 * i));
      body.velocity = Vec<3>(0.1 * i, 1, -1);
      body.angular_momentum = {0.3, 0.1 * i, 0.2};
      world.add(body);
    }
    run(world, 1);
    return world.hash();
  };
  EXPECT_EQ(hash_with(ContactMethod::soft), hash_with(ContactMethod::none));
  EXPECT_EQ(hash_with(ContactMethod::impulse), hash_with(ContactMethod::none));
}

TEST(Determinism, StagesThatAreNotNeededAreLeftOut) {
  WorldConfig<2> config;
  config.contacts = ContactMethod::none;
  config.may_sleep = false;
  World<2> free_flight(config);
  free_flight.add(ball_at<2>({0, 0}, {1, 0}));
  free_flight.add(ball_at<2>({0, 0}, {-1, 0}));
  run(free_flight, 1);
  for (const WorldCounter& counter : kWorldCounters)
    EXPECT_EQ(free_flight.work().*counter.count, counter.name == "steps" ? 60u : 0u)
        << counter.name;
  EXPECT_EQ(free_flight.broad_phase(), nullptr);

  World<2> still(falling<2>());  // nothing can move
  still.add(floor_at<2>());
  run(still, 1);
  EXPECT_EQ(still.broad_phase(), nullptr);
  EXPECT_EQ(still.work().force_evaluations, 0u) << "gravity finds nothing to pull at";
}

TEST(Determinism, EachCounterIsOfWhatWasDone) {
  const auto ran = [](ContactMethod method, double friction, bool pinned, double ratio = 1000) {
    WorldConfig<2> config = falling<2>();
    config.contacts = method;
    config.may_sleep = false;
    World<2> world(config);
    world.add(floor_at<2>(0, friction));
    Body<2> box = box_at<2>(up<2>(0.5)), heavy = box_at<2>(up<2>(1.5));
    heavy.density = ratio;
    const BodyId low = world.add(box), high = world.add(heavy);
    if (pinned) world.add_joint({JointKind::pin, low, high, {0.5, 0.5}, {0.5, -0.5}});
    run(world, 0.5);
    const WorldWork half = world.work();
    run(world, 0.5);
    return work_between(half, world.work());
  };
  const WorldWork soft = ran(ContactMethod::soft, 0.5, false);
  EXPECT_EQ(soft.steps, 30u);
  EXPECT_EQ(soft.broad_phases, 30u);
  EXPECT_EQ(soft.islands_solved, 30u);
  EXPECT_EQ(soft.sub_steps, 30u * 8u);
  EXPECT_EQ(soft.force_evaluations, 30u * 9u) << "once to know how far all may come";
  EXPECT_EQ(soft.narrow_pairs, 60u) << "each pair once a step";
  EXPECT_EQ(soft.narrow_tests, 60u) << "and its contact is solved as it was found";
  EXPECT_GT(soft.friction_rows, 0u);
  EXPECT_EQ(soft.joint_rows, 0u);
  EXPECT_EQ(soft.impacts_located, 0u);
  EXPECT_EQ(ran(ContactMethod::soft, 0, false).friction_rows > 0, true) << "between the boxes";
  EXPECT_GT(ran(ContactMethod::impulse, 0.5, true, 1).direct_rows, 0u)
      << "joints are solved at once";
  const WorldWork direct = ran(ContactMethod::direct, 0.5, false);
  EXPECT_EQ(direct.sub_steps, 0u) << "it has none";
  EXPECT_EQ(direct.islands_solved, 30u);
  const WorldWork impulse = ran(ContactMethod::impulse, 0.5, false, 1);
  EXPECT_EQ(impulse.sub_steps, 0u);
  EXPECT_EQ(impulse.direct_solves + impulse.direct_rows, 0u);
  EXPECT_EQ(impulse.constraint_rows, impulse.normal_rows + impulse.friction_rows);
}

TEST(Determinism, FarFromTheOriginItIsTheSame) {
  const auto height = [](double x) {
    World<2> world(falling<2>());
    world.add(floor_at<2>());
    world.add(box_at<2>({x, 0.5}));
    world.add(box_at<2>({x, 1.5}));
    run(world, 2);
    return glm::length(world.bodies()[2].position - Vec<2>(x, 1.5));
  };
  EXPECT_LE(height(0), 1e-6);
  EXPECT_LE(height(1e7), 1e-6);
}

}  // namespace
}  // namespace lantern::physics
