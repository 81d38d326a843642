// Sleep, and what wakes.
#include <gtest/gtest.h>

#include "world_scene.hpp"

namespace lantern::physics {
namespace {

// Three boxes in a pile, one apart, all asleep.
World<2> sleeping() {
  World<2> world(falling<2>());
  world.add(floor_at<2>());
  for (int i = 0; i < 3; ++i) world.add(box_at<2>(up<2>(0.5 + i)));
  world.add(box_at<2>({10, 0.5}));
  run(world, 1);
  return world;
}

void expect_awake(const World<2>& world, std::vector<bool> awake, const char* why) {
  for (std::size_t i = 0; i < awake.size(); ++i)
    EXPECT_EQ(!world.bodies()[i + 1].asleep, awake[i]) << why << ": box " << i + 1;
}

TEST(Islands, FallAsleepWhenTheyRest) {
  World<2> world(falling<2>());
  world.add(floor_at<2>());
  world.add(box_at<2>(up<2>(0.5)));
  run(world, 0.4);
  EXPECT_FALSE(world.bodies()[1].asleep) << "too early";
  run(world, 0.4);
  EXPECT_TRUE(world.bodies()[1].asleep);
  EXPECT_EQ(world.bodies()[1].velocity, (Vec<2>{0, 0}));
  const std::uint64_t rows = world.work().constraint_rows, tests = world.work().narrow_tests;
  const Vec<2> place = world.bodies()[1].position;
  run(world, 1);
  EXPECT_EQ(world.work().constraint_rows, rows) << "sleeping bodies are solved";
  EXPECT_EQ(world.work().narrow_tests, tests);
  EXPECT_EQ(world.bodies()[1].position, place);
  ASSERT_EQ(world.events().size(), 1u);
  EXPECT_EQ(world.events()[0].kind, ContactEvent::Kind::stay) << "they still touch";
}

TEST(Islands, AnImpulseWakesThePileButNotTheOther) {
  World<2> world = sleeping();
  expect_awake(world, {false, false, false, false}, "before");
  EXPECT_EQ(world.work().asleep, 4u);
  world.apply_impulse(2, {0.1, 0}, {0, 1.5});
  expect_awake(world, {true, true, true, false}, "impulse");
}

TEST(Islands, ScriptsWake) {
  const auto woken_by = [](auto&& action, const char* why) {
    World<2> world = sleeping();
    action(world);
    expect_awake(world, {true, true, true, false}, why);
  };
  woken_by([](World<2>& w) { w.wake(3); }, "wake");
  woken_by([](World<2>& w) { w.push(1, {1, 0}, {0, 0.5}); }, "push");
  woken_by([](World<2>& w) { w.set_velocity(1, {0, 0}); }, "velocity");
  woken_by([](World<2>& w) { w.set_angular_velocity(1, 0.1); }, "spin");
  woken_by([](World<2>& w) { w.place(1, {0, 0.5}, {0, 0}); }, "place");
}

TEST(Islands, WithoutItsSupportAPileFalls) {
  World<2> world = sleeping();
  world.remove(1);
  run(world, 1);
  EXPECT_NEAR(world.find(2)->position.y, 0.5, 1e-3);
  EXPECT_NEAR(world.find(3)->position.y, 1.5, 1e-3);
}

TEST(Islands, ATouchWakes) {
  World<2> world = sleeping();
  world.add(ball_at<2>({0, 4.5}, {0, -1}));
  int steps = 0;
  while (world.bodies()[1].asleep && steps < 200) {
    world.step(kStep);
    ++steps;
  }
  EXPECT_GT(steps, 10) << "woke before it was touched";
  EXPECT_LT(steps, 60) << "was never woken";
  EXPECT_TRUE(world.bodies()[4].asleep) << "the other one sleeps on";
}

TEST(Islands, AMovingKinematicBodyWakesAndKeepsAwake) {
  World<2> world = sleeping();
  Body<2> pusher = box_at<2>({-2, 0.5});
  pusher.kind = BodyKind::kinematic_body;
  pusher.velocity = {0.5, 0};
  const BodyId id = world.add(pusher);
  run(world, 4);
  EXPECT_NEAR(world.find(id)->position.x, 0, 1e-9) << "it goes its way";
  EXPECT_NEAR(world.find(1)->position.x, 1, 1e-2) << "and pushes";
  EXPECT_FALSE(world.find(1)->asleep);
}

TEST(Islands, AFreeBodyThatMovesSlowlyDoesNotSleep) {
  World<2> world((WorldConfig<2>()));
  world.add(ball_at<2>({0, 0}, {1e-4, 0}));
  run(world, 10);
  EXPECT_NEAR(world.bodies()[0].position.x, 1e-3, 1e-12);
}

// Drag brakes its way, but nothing its spin.
TEST(Islands, AFreeBodyThatTurnsSlowlyDoesNotSleepUnlessDragBrakesThat) {
  for (const double angular_drag : {0.0, 1e-6}) {
    World<2> world((WorldConfig<2>()));
    Body<2> ball = ball_at<2>({0, 0});
    ball.linear_drag = 1;
    ball.angular_drag = angular_drag;
    const BodyId id = world.add(ball);
    world.set_angular_velocity(id, 1e-3);
    run(world, 10);
    EXPECT_EQ(world.bodies()[0].asleep, angular_drag > 0) << angular_drag;
    if (angular_drag > 0) continue;
    EXPECT_NEAR(world.bodies()[0].orientation.angle, 1e-2, 1e-12);
  }
}

TEST(Islands, AreAsManyAsThereArePiles) {
  World<2> world(falling<2>());
  world.add(floor_at<2>());
  for (int i = 0; i < 6; ++i) world.add(box_at<2>({i / 2 * 5.0, 0.5 + i % 2}));
  world.step(kStep);
  EXPECT_EQ(world.work().islands, 3u) << "the floor must not join them";
}

using Members = std::vector<BodyId>;

// Two piles on one floor, and a beam across them.
World<2> bridged() {
  World<2> world(falling<2>());
  world.add(floor_at<2>());
  for (int i = 0; i < 4; ++i) world.add(box_at<2>({i % 2 * 3.0, 0.5 + i / 2}));
  Body<2> beam = box_at<2>({1.5, 2.1});
  beam.shape = OrientedBox<2>{{2.2, 0.1}};
  world.add(beam);
  return world;
}

TEST(Islands, AreNamedByTheirLowestBodyAsleepOrAwake) {
  World<2> world = bridged();
  const Members unseen(6, kNoIsland), one{kNoIsland, 1, 1, 1, 1, 1}, two{kNoIsland, 1, 2, 1, 2};
  EXPECT_EQ(world.islands(), unseen) << "no step has looked yet";
  world.step(kStep);
  EXPECT_EQ(world.islands(), one);
  run(world, 2);
  EXPECT_EQ(world.work().asleep, 5u);
  EXPECT_EQ(world.islands(), one) << "those that sleep hang together still";
  world.remove(5);
  EXPECT_EQ(world.islands(), two) << "what held them together has left";
  run(world, 2);
  EXPECT_EQ(world.work().asleep, 4u);
  EXPECT_EQ(world.islands(), two);
  world.apply_impulse(4, {0.1, 0}, {3, 1.5});
  expect_awake(world, {false, true, false, true}, "an island wakes as a whole");
  world.place(3, {9, 0.5}, {0, 0});
  EXPECT_EQ(world.islands(), (Members{kNoIsland, 1, 2, 3, 2}));
}

TEST(Islands, PartWhenAJointOrASpringLetsGo) {
  World<2> world(falling<2>());
  for (int i = 0; i < 3; ++i) world.add(ball_at<2>({4.0 * i, 50}));
  const JointId joint = world.add_joint({JointKind::distance, 0, 1, {}, {}, 4});
  const SpringId spring = world.add_spring({1, 2, {}, {}, 4, 1});
  world.step(kStep);
  EXPECT_EQ(world.islands(), (Members{0, 0, 0}));
  world.remove_spring(spring);
  EXPECT_EQ(world.islands(), (Members{0, 0, 2}));
  world.remove_joint(joint);
  EXPECT_EQ(world.islands(), (Members{0, 1, 2}));
}

// Whatever has been placed is met where it lies now, awake or not, by what comes along.
TEST(Islands, WhatIsPlacedInItsSleepIsMetThere) {
  for (const BodyKind kind :
       {BodyKind::dynamic_body, BodyKind::static_body, BodyKind::kinematic_body}) {
    WorldConfig<2> config;
    World<2> world(config);
    for (int i = 0; i < 200; ++i) {  // so many that few of them move
      Body<2> box = box_at<2>({3.0 * i, 0});
      box.asleep = true;
      if (i == 7) box.kind = kind;
      world.add(box);
    }
    const BodyId id = world.add(ball_at<2>({-20, 50}, {5, 0}));
    run(world, 0.5);
    world.place(7, {-10, 50}, {0, 0});
    world.sleep(7);
    run(world, 3);
    EXPECT_LT(world.find(id)->position.x, -5) << static_cast<int>(kind);
    EXPECT_EQ(world.find(7)->position.x > -9.99, kind == BodyKind::dynamic_body);
    EXPECT_GE(world.work().asleep, 199u);
  }
}

// What is told of those that sleep is written down when somebody asks: what he hears does not
// depend on when others asked, nor does how many touch.
TEST(Islands, TellTheSameWhoeverAsksWhen) {
  World<2> asked = sleeping();
  World<2> silent(asked, asked.config());
  for (World<2>* world : {&asked, &silent}) {
    world->add(ball_at<2>({0, 6}, {0, -1}));
    world->add(ball_at<2>({-9, 0.5}, {1, 0}));
  }
  std::uint64_t touches = 0;
  for (int i = 0; i < 240; ++i) {
    asked.step(kStep);
    silent.step(kStep);
    touches += asked.contacts().size();
    ASSERT_EQ(asked.touches(), asked.contacts().size());
    ASSERT_EQ(silent.touches(), asked.contacts().size()) << i;
    ASSERT_LE(silent.fresh_contacts().size(), silent.touches());
    if (i % 37 != 0) continue;
    ASSERT_EQ(silent.hash(), asked.hash());
    ASSERT_EQ(silent.events(), asked.events()) << i;
    ASSERT_EQ(silent.told().size(), asked.told().size()) << i;
    ASSERT_EQ(silent.contacts().size(), asked.contacts().size()) << i;
    ASSERT_EQ(silent.islands(), asked.islands()) << i;
  }
  EXPECT_GT(touches, 600u);
  EXPECT_EQ(silent.hash(), asked.hash());
}

// A script may put to sleep one body of several that hang together.
TEST(Islands, WhatHangsOnASleeperSwingsAboutIt) {
  WorldConfig<2> config = falling<2>();
  config.contacts = ContactMethod::none;
  config.may_sleep = false;
  for (const bool sleeper_first : {true, false}) {
    World<2> world(config);
    const Body<2> nail = ball_at<2>({0, 0}), bob = ball_at<2>({2, 0});
    const BodyId first = world.add(sleeper_first ? nail : bob);
    const BodyId second = world.add(sleeper_first ? bob : nail);
    world.add_joint({JointKind::distance, first, second, {}, {}, 2});
    world.sleep(sleeper_first ? first : second);
    run(world, 0.5);
    const Body<2>& swings = world.bodies()[sleeper_first ? 1 : 0];
    EXPECT_LT(swings.position.y, -0.5) << "time stands still for it";
    EXPECT_NEAR(glm::length(swings.position), 2, 1e-3);
  }
}

// What a stack that came asleep stands on was never looked at: it is when that goes.
template <int D>
void expect_put_asleep_falls(ContactMethod method, bool is_moved) {
  WorldConfig<D> config = falling<D>();
  config.contacts = method;
  World<D> world(config);
  world.add(floor_at<D>());
  for (int i = 0; i < 4; ++i) {
    Body<D> box = box_at<D>(up<D>(i + 0.5));
    box.asleep = true;
    world.add(box);
  }
  run(world, 0.5);
  EXPECT_EQ(world.work().asleep, 4u);
  if (is_moved)
    world.place(1, along<D>(5, 0.5), Vec<D>(0.0));
  else
    world.remove(1);
  run(world, 2);
  for (BodyId id = 2; id <= 4; ++id) {
    const double wanted = static_cast<double>(id) - 1.5;
    EXPECT_NEAR(world.find(id)->position.y, wanted, 0.05) << to_string(method) << ", " << id;
  }
}

TEST(Islands, WhatCameAsleepFallsWhenItsFootGoes) {
  for (const ContactMethod method :
       {ContactMethod::impulse, ContactMethod::soft, ContactMethod::direct})
    for (const bool is_moved : {false, true}) {
      expect_put_asleep_falls<2>(method, is_moved);
      expect_put_asleep_falls<3>(method, is_moved);
    }
}

}  // namespace
}  // namespace lantern::physics
