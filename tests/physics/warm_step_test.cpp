// What a step asks for, counted where memory is really asked for: once warm, nothing.
#include <gtest/gtest.h>

#include "counted_memory.hpp"
#include "physics/integrate/integrator.hpp"
#include "physics/world_scene.hpp"

namespace lantern::physics {
namespace {

constexpr std::string_view kLongName = "a name that is too long to lie in a string without memory";

template <int D>
void add(World<D>& world, Body<D> body) {
  body.name = std::string(kLongName);
  world.add(std::move(body));
}

// Boxes that lie on each other, with a ball that bounces beside them.
template <int D>
World<D> pile(WorldConfig<D> config) {
  World<D> world(config);
  add(world, floor_at<D>());
  for (int i = 0; i < 12; ++i) add(world, box_at<D>(along<D>(i % 4 * 1.01, 0.5 + i / 4)));
  Body<D> ball = ball_at<D>(along<D>(-3, 2));
  ball.material.restitution = 1;
  add(world, ball);
  return world;
}

// Links on pins, tied by a spring, pushed, braked; the last one may meet the floor.
template <int D>
World<D> chain(WorldConfig<D> config) {
  World<D> world(config);
  add(world, floor_at<D>(-3));
  for (int i = 0; i < 5; ++i) {
    Body<D> link = box_at<D>(along<D>(i, 0), 0.4);
    if (i == 0) link.kind = BodyKind::static_body;
    link.linear_drag = 0.1;
    add(world, link);
  }
  for (BodyId i = 1; i < 5; ++i)
    world.add_joint({.kind = JointKind::pin,
                     .a = i,
                     .b = i + 1,
                     .at_a = along<D>(0.5),
                     .at_b = along<D>(-0.5)});
  world.add_spring({.a = 1, .b = 5, .rest_length = 3, .stiffness = 20, .damping = 1});
  world.push(5, along<D>(1, 2), along<D>(4));
  return world;
}

// Of so many steps, how many asked for memory.
template <int D>
int cold_steps(World<D>& world, int steps) {
  int cold = 0;
  for (int i = 0; i < steps; ++i) {
    const std::uint64_t before = counted_memory::calls;
    world.step(kStep);
    cold += counted_memory::calls != before;
  }
  return cold;
}

template <int D>
void expect_warm_steps(World<D> world, const std::string& what) {
  SCOPED_TRACE(what + (D == 2 ? " in 2D" : " in 3D"));
  cold_steps(world, 400);  // by then the end of a chain has met the floor
  EXPECT_EQ(cold_steps(world, 100), 0);
}

template <int D>
void expect_all_warm() {
  WorldConfig<D> config = falling<D>();
  config.may_sleep = false;
  for (const std::string_view name : contact_method_names()) {
    config.contacts = *contact_method_named(name);
    if (config.contacts == ContactMethod::lecture) continue;  // its containers are the lecture's
    expect_warm_steps(pile<D>(config), std::string(name) + ", a pile");
    expect_warm_steps(chain<D>(config), std::string(name) + ", a chain");
  }
  config.contacts = ContactMethod::soft;
  config.wanted_error = 0.01;
  expect_warm_steps(pile<D>(config), "quick sweeps, a pile");
  config.wanted_error = 0;
  for (const std::string_view name : integrator_names()) {
    config.integrator = *integrator_named(name);
    if (integration(config.integrator).of_places) continue;  // no joints
    expect_warm_steps(chain<D>(config), std::string(name) + ", a chain");
  }
}

TEST(WarmStep, AsksForNoMemory) {
  expect_all_warm<2>();
  expect_all_warm<3>();
}

// What all that sleeps costs a step: nothing, but that time goes on.
template <int D>
void expect_rest() {
  World<D> world = pile<D>(falling<D>());
  world.remove(13);  // the ball, which would bounce for ever
  for (int i = 0; i < 200; ++i) world.step(kStep);
  ASSERT_EQ(world.work().asleep, 12u);
  const WorldWork before = world.work();
  const std::uint64_t hash = world.hash();
  const std::size_t touching = world.contacts().size();
  const double begun = world.time();
  const Contact<D>* const told = world.contacts().data();
  world.step(kStep);
  EXPECT_EQ(world.contacts().data(), told) << "what it tells is not even written anew";
  EXPECT_EQ(cold_steps(world, 99), 0);
  for (const WorldCounter& counter : kWorldCounters)
    EXPECT_EQ(world.work().*counter.count - before.*counter.count,
              counter.name == "steps" ? 100u : 0u)
        << counter.name;
  EXPECT_NEAR(world.time() - begun, 100 * kStep, 1e-9);
  EXPECT_EQ(world.contacts().size(), touching);
  EXPECT_GT(touching, 11u);
  EXPECT_TRUE(std::ranges::all_of(world.events(), [](const ContactEvent& event) {
    return event.kind == ContactEvent::Kind::stay;
  }));
  EXPECT_EQ(world.islands()[1], 1u) << "it hangs together as when it fell asleep";
  EXPECT_EQ(world.islands()[9], 1u);
  world.apply_impulse(12, up<D>(3), world.bodies()[12].position);
  world.step(kStep);
  EXPECT_GT(world.bodies()[12].velocity.y, 1);
  EXPECT_NE(world.hash(), hash);
}

TEST(WarmStep, OfWhatRestsDoesNothing) {
  expect_rest<2>();
  expect_rest<3>();
}

// Who sleeps beside one that moves is neither looked at nor solved.
TEST(WarmStep, LeavesOutWhatSleeps) {
  WorldConfig<2> config = falling<2>();
  World<2> alone(config), beside(config);
  for (World<2>* world : {&alone, &beside}) {
    world->add(floor_at<2>());
    Body<2> ball = ball_at<2>({-20, 2});
    ball.material.restitution = 1;
    world->add(ball);
  }
  for (int i = 0; i < 100; ++i) {
    Body<2> box = box_at<2>({i * 1.5, 0.5});
    box.asleep = true;
    beside.add(box);
  }
  for (int i = 0; i < 60; ++i) alone.step(kStep), beside.step(kStep);
  for (const WorldCounter& counter : kWorldCounters) {
    if (counter.name == "pair_tests") continue;  // of the broad phase, which holds them all
    EXPECT_EQ(alone.work().*counter.count, beside.work().*counter.count) << counter.name;
  }
  EXPECT_EQ(beside.work().asleep, 100u);
  EXPECT_EQ(alone.bodies()[1].position, beside.bodies()[1].position);
}

TEST(WarmStep, IsCountedColdAtFirst) {
  World<2> world = pile<2>(falling<2>());
  EXPECT_GT(cold_steps(world, 1), 0) << "nothing is counted";
}

}  // namespace
}  // namespace lantern::physics
