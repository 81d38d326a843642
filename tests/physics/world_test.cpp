#include "physics/world.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "geometry/not_finite.hpp"
#include "physics/world_scene.hpp"

namespace lantern::physics {
namespace {

constexpr double kHuge = std::numeric_limits<double>::max();

Body<2> ball(const std::string& name, const Vec<2>& position, const Vec<2>& velocity) {
  Body<2> body;
  body.name = name;
  body.shape = Sphere{1};
  body.position = position;
  body.velocity = velocity;
  return body;
}

std::string text_of(const World<2>& world) {
  std::string text;
  for (const Body<2>& b : world.bodies())
    text += fmt::format("{} {} {:a} {:a} {:a} {:a}\n", b.id, b.name, b.position.x, b.position.y,
                        b.velocity.x, b.velocity.y);
  return text;
}

// The action must be refused, with this in the message, and must leave the world as it was.
template <class Action>
void expect_refused(World<2>& world, const char* part, Action&& action) {
  const std::string before = text_of(world);
  try {
    action();
    FAIL() << "not refused: " << part;
  } catch (const Refused& refused) {
    EXPECT_NE(std::string(refused.what()).find(part), std::string::npos) << refused.what();
  }
  EXPECT_EQ(text_of(world), before) << "a refusal left the world changed";
}

TEST(World, FreeFlightIsExactlyPositionPlusVelocityTimesStep) {
  Random random(1);
  World<2> world;
  std::vector<Vec<2>> expected;
  for (int i = 0; i < 20; ++i) {
    const Vec<2> position(random.between(-9, 9), random.between(-9, 9));
    expected.push_back(position);
    world.add(ball("b", position, {random.between(-9, 9), random.between(-9, 9)}));
  }
  const double h = 1.0 / 60;
  for (int step = 0; step < 100; ++step) {
    world.step(h);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const Vec<2>& v = world.bodies()[i].velocity;
      expected[i] = {expected[i].x + v.x * h, expected[i].y + v.y * h};
      ASSERT_EQ(world.bodies()[i].position, expected[i]) << "not the same bits";
    }
  }
}

TEST(World, DyadicStepsAreExact) {
  World<2> world;
  world.add(ball("ball", {52, 24}, {-20, -5}));
  for (int step = 0; step < 64; ++step) world.step(0.03125);
  EXPECT_EQ(world.bodies()[0].position, (Vec<2>{12, 14}));
}

TEST(World, AStepOfNoTimeDoesNothing) {
  World<2> world;
  world.add(ball("ball", {-0.0, 1}, {3, -4}));
  const std::string before = text_of(world);
  world.step(0);
  EXPECT_EQ(text_of(world), before) << "not even the sign of a zero may change";
}

TEST(World, StaticBodiesStay) {
  World<2> world;
  Body<2> wall = ball("wall", {1, 2}, {5, 5});
  wall.kind = BodyKind::static_body;
  world.add(wall);
  world.step(1);
  EXPECT_EQ(world.bodies()[0].position, (Vec<2>{1, 2}));
}

TEST(World, IdsAreNeverUsedAgain) {
  World<2> world;
  EXPECT_EQ(world.add(ball("a", {0, 0}, {0, 0})), 0u);
  EXPECT_EQ(world.add(ball("b", {0, 0}, {0, 0})), 1u);
  world.remove(1);
  world.remove(17);  // not there: nothing happens
  EXPECT_EQ(world.add(ball("c", {0, 0}, {0, 0})), 2u);
  ASSERT_EQ(world.bodies().size(), 2u);
  EXPECT_EQ(world.bodies()[1].name, "c");
}

TEST(World, PlacesABody) {
  World<2> world;
  world.add(ball("a", {0, 0}, {0, 0}));
  world.place(0, {3, 4}, {5, 6});
  EXPECT_EQ(world.bodies()[0].position, (Vec<2>{3, 4}));
  EXPECT_EQ(world.bodies()[0].velocity, (Vec<2>{5, 6}));
  EXPECT_EQ(world.bodies()[0].box(), (Box<2>{{2, 3}, {4, 5}}));
}

TEST(World, RefusesWhatIsNoBody) {
  World<2> world;
  world.add(ball("first", {1, 2}, {3, 4}));
  const auto add = [&](Body<2> body, const char* part) {
    expect_refused(world, part, [&] { world.add(body); });
  };
  add(ball("ghost", {kNan, 0}, {0, 0}), "'ghost': position");
  add(ball("ghost", {0, 0}, {0, kInfinity}), "'ghost': velocity");
}

TEST(World, RefusesBadSizes) {
  World<2> world;
  world.add(ball("first", {1, 2}, {3, 4}));
  for (const double bad : {-1.0, kNan, kInfinity}) {
    Body<2> body = ball("ghost", {0, 0}, {0, 0});
    body.shape = Sphere{bad};
    expect_refused(world, "'ghost': radius", [&] { world.add(body); });
    body.shape = AxisBox<2>{{1, bad}};
    expect_refused(world, "'ghost': half_size", [&] { world.add(body); });
  }
  Body<2> body = ball("ghost", {kHuge, 0}, {0, 0});
  body.shape = Sphere{kHuge};
  expect_refused(world, "'ghost'", [&] { world.add(body); });
  EXPECT_EQ(world.add(ball("next", {0, 0}, {0, 0})), 1u) << "a refused body used up an id";
}

TEST(World, RefusesBadPlacesAndSteps) {
  World<2> world;
  world.add(ball("slow", {1, 2}, {3, 4}));
  world.add(ball("fast", {0, 0}, {kHuge, 0}));
  expect_refused(world, "no body 9", [&] { world.place(9, {0, 0}, {0, 0}); });
  expect_refused(world, "'slow': position", [&] { world.place(0, {0, kNan}, {0, 0}); });
  expect_refused(world, "'slow': velocity", [&] { world.place(0, {5, 5}, {kInfinity, 0}); });
  for (const double bad : {-1.0, kNan, kInfinity})
    expect_refused(world, "time step", [&] { world.step(bad); });
  expect_refused(world, "'fast'", [&] { world.step(10); });
}

TEST(World, HasThreeDimensionsToo) {
  World<3> world;
  Body<3> body;
  body.shape = AxisBox<3>{{1, 2, 3}};
  body.velocity = {1, 2, 3};
  world.add(body);
  world.step(2);
  EXPECT_EQ(world.bodies()[0].box(), (Box<3>{{1, 2, 3}, {3, 6, 9}}));
}

// By p / m, and by the arm times p about the centre.
TEST(World, AnImpulseChangesVelocityAndSpin) {
  World<2> world;
  Body<2> struck = ball("struck", {1, 2}, {0.5, 0});
  struck.mass = 4;
  const BodyId id = world.add(struck);
  world.apply_impulse(id, {2, -6}, {4, 2});
  const Body<2>& body = *world.find(id);
  EXPECT_EQ(body.velocity, Vec<2>(1, -1.5));
  EXPECT_EQ(body.angular_momentum, -18);
  world.apply_impulse(id, {-4, 6}, {1, 2});
  EXPECT_EQ(body.velocity, Vec<2>(0.0)) << "through the centre: it stops";
  EXPECT_EQ(body.angular_momentum, -18) << "and turns on";
}

TEST(World, RemovingASpringThatIsNotThereDoesNothing) {
  World<2> world;
  world.remove_spring(0);
  const BodyId a = world.add(ball("a", {0, 0}, {0, 0})), b = world.add(ball("b", {9, 0}, {0, 0}));
  const SpringId spring = world.add_spring({a, b, {}, {}, 9, 1, 0});
  world.remove_spring(spring + 1);
  EXPECT_EQ(world.forces().springs.size(), 1u);
  world.remove_spring(spring);
  EXPECT_TRUE(world.forces().springs.empty());
  world.remove_spring(spring);
}

TEST(World, KeepsTheBroadPhaseThatItWasSwitchedTo) {
  WorldConfig<2> config;
  config.contacts = ContactMethod::soft;
  World<2> world(config);
  BroadPhaseConfig<2> other = config.broad_phase;
  other.kind = StructureKind::sort_and_sweep;
  world.switch_broad_phase(other);
  EXPECT_EQ(world.config().broad_phase.kind, StructureKind::sort_and_sweep);
}

TEST(World, ContactMethodsHaveNames) {
  for (const ContactMethod method :
       {ContactMethod::none, ContactMethod::impulse, ContactMethod::soft, ContactMethod::direct,
        ContactMethod::lecture})
    EXPECT_EQ(contact_method_named(to_string(method)), method);
  EXPECT_EQ(contact_method_named("hard"), std::nullopt);
}

TEST(World, WhoIsAddedAsleepIsAtRest) {
  WorldConfig<2> config;
  config.may_sleep = true;
  World<2> world(config);
  Body<2> body = ball_at<2>({0, 0}, {1, 2});
  body.asleep = true;
  body.angular_momentum = 3;
  const Body<2>& added = *world.find(world.add(body));
  EXPECT_TRUE(added.asleep);
  EXPECT_EQ(added.velocity, Vec<2>(0.0));
  EXPECT_EQ(added.angular_momentum, Spin<2>(0.0));
}

}  // namespace
}  // namespace lantern::physics
