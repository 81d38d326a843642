// Bodies with methods of their own, and a world that goes on with another contact method.
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "physics/body.hpp"
#include "physics/forces.hpp"
#include "physics/world_scene.hpp"

namespace lantern::physics {
namespace {

constexpr std::array kIntegrators = {Integrator::explicit_euler,    Integrator::semi_implicit_euler,
                                     Integrator::velocity_verlet,   Integrator::runge_kutta_4,
                                     Integrator::implicit_midpoint, Integrator::implicit_euler};
constexpr std::array kRotations = {RotationMethod::exact, RotationMethod::splitting_2,
                                   RotationMethod::splitting_4,
                                   RotationMethod::explicit_gyroscopic};

template <int D>
WorldConfig<D> without_contacts() {
  WorldConfig<D> config;
  config.contacts = ContactMethod::none;
  config.gravity = up<D>(-3);
  return config;
}

// A bob that hangs on a spring from a nail of its own, a little off its centre so that it turns.
template <int D>
BodyId add_bob(World<D>& world, int place, std::optional<Integrator> integrator) {
  Body<D> nail = ball_at<D>(along<D>(10.0 * place, 5), Vec<D>(0.0), 0.1);
  nail.kind = BodyKind::static_body;
  const BodyId held = world.add(nail);
  Body<D> bob = box_at<D>(along<D>(10.0 * place + 1, 2));
  bob.mass = 1.5;
  bob.linear_drag = 0.1;
  bob.integrator = integrator;
  const BodyId id = world.add(bob);
  world.add_spring({held, id, Vec<D>(0.0), up<D>(0.25), 2, 30, 0.2});
  return id;
}

template <int D>
void expect_each_by_its_own() {
  World<D> together(without_contacts<D>());
  std::vector<BodyId> bobs;
  for (std::size_t i = 0; i < kIntegrators.size(); ++i)
    bobs.push_back(add_bob(together, static_cast<int>(i), kIntegrators[i]));
  for (int i = 0; i < 100; ++i) together.step(kStep);
  for (std::size_t i = 0; i < kIntegrators.size(); ++i) {
    WorldConfig<D> config = without_contacts<D>();
    config.integrator = kIntegrators[i];
    World<D> alone(config);
    const BodyId id = add_bob<D>(alone, static_cast<int>(i), std::nullopt);
    for (int k = 0; k < 100; ++k) alone.step(kStep);
    const Body<D>&one = *together.find(bobs[i]), &other = *alone.find(id);
    EXPECT_EQ(one.position, other.position) << to_string(kIntegrators[i]);
    EXPECT_EQ(one.velocity, other.velocity) << to_string(kIntegrators[i]);
    EXPECT_EQ(one.angular_momentum, other.angular_momentum) << to_string(kIntegrators[i]);
  }
}

TEST(Methods, BodiesOfDifferentIntegratorsMoveAsEachWouldAlone) {
  expect_each_by_its_own<2>();
  expect_each_by_its_own<3>();
}

TEST(Methods, ToNameTheWorldsOwnMethodChangesNoBitAndNoWork) {
  const auto run = [](bool named) {
    World<2> world(falling<2>());
    world.add(floor_at<2>());
    for (int i = 0; i < 4; ++i) {
      Body<2> box = box_at<2>({0.1 * i, 0.5 + 1.01 * i});
      if (named) box.integrator = Integrator::semi_implicit_euler;
      if (named) box.rotation = RotationMethod::exact;
      world.add(box);
    }
    for (int i = 0; i < 90; ++i) world.step(kStep);
    return std::tuple{world.hash(), world.work().force_evaluations, world.work().constraint_rows};
  };
  EXPECT_EQ(run(true), run(false));
}

TEST(Methods, BodiesOfDifferentIntegratorsRestOnEachOther) {
  World<2> world(falling<2>());
  world.add(floor_at<2>());
  for (std::size_t i = 0; i < kIntegrators.size(); ++i) {
    Body<2> box = box_at<2>({0, 0.5 + double(i)});
    box.integrator = kIntegrators[i];
    world.add(box);
  }
  for (int i = 0; i < 120; ++i) world.step(kStep);
  for (std::size_t i = 0; i < kIntegrators.size(); ++i)
    EXPECT_NEAR(world.bodies()[i + 1].position.y, 0.5 + double(i), 0.01)
        << to_string(kIntegrators[i]) << " does not stand in the stack";
}

TEST(Methods, SpringBetweenTwoMethodsIsRefusedByName) {
  World<2> world(without_contacts<2>());
  Body<2> one = ball_at<2>({0, 0}), two = ball_at<2>({3, 0}), nail = ball_at<2>({6, 0});
  one.name = "one";
  two.name = "two";
  two.integrator = Integrator::runge_kutta_4;
  nail.kind = BodyKind::static_body;
  const BodyId a = world.add(one), b = world.add(two), c = world.add(nail);
  const std::uint64_t before = world.hash();
  try {
    world.add_spring({a, b, {}, {}, 3, 10, 0});
    FAIL() << "two methods cannot share a spring";
  } catch (const Refused& refused) {
    const std::string text = refused.what();
    for (const char* part : {"'one'", "'two'", "semi_implicit_euler", "runge_kutta_4"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
  EXPECT_EQ(world.hash(), before) << "a refusal left the world changed";
  world.add_spring({b, c, {}, {}, 3, 10, 0});
  two.position = {0, 5};
  world.add_spring({b, world.add(two), {}, {}, 3, 10, 0});
}

Body<3> tennis_racket() {
  Body<3> box = box_at<3>({0, 0, 0});
  box.shape = OrientedBox<3>{{0.5, 2, 4.5}};
  return box;
}

TEST(Methods, BodyTurnsByItsOwnRotationOrTheWorlds) {
  for (const RotationMethod method : kRotations)
    for (const bool own : {true, false}) {
      WorldConfig<3> config = without_contacts<3>();
      config.gravity = {};
      if (!own) config.rotation = method;
      World<3> world(config);
      Body<3> box = tennis_racket();
      if (own) box.rotation = method;
      const BodyId id = world.add(box);
      world.set_angular_velocity(id, {0.1, 5, 0.1});
      Body<3> alone = *world.find(id);
      for (int i = 0; i < 200; ++i) {
        world.step(0.01);
        turn_freely(alone, 0.01, method);
      }
      EXPECT_EQ(world.find(id)->orientation.q, alone.orientation.q) << to_string(method);
      EXPECT_EQ(world.find(id)->angular_momentum, alone.angular_momentum) << to_string(method);
    }
}

TEST(Methods, OnlyTheTextbookUpdateLosesAngularMomentum) {
  for (const RotationMethod method : kRotations) {
    WorldConfig<3> config = without_contacts<3>();
    config.gravity = {};
    config.rotation = method;
    World<3> world(config);
    const BodyId id = world.add(tennis_racket());
    world.set_angular_velocity(id, {0.1, 5, 0.1});
    const Vec<3> before = world.find(id)->angular_momentum;
    for (int i = 0; i < 400; ++i) world.step(0.01);
    const double drift = glm::length(world.find(id)->angular_momentum - before);
    if (method == RotationMethod::explicit_gyroscopic)
      EXPECT_GT(drift, 0.01 * glm::length(before)) << "it is there to be seen failing";
    else
      EXPECT_EQ(drift, 0) << to_string(method) << ": nothing acts on the body";
  }
}

World<2> pile(ContactMethod contacts) {
  WorldConfig<2> config = falling<2>();
  config.contacts = contacts;
  config.may_sleep = false;
  World<2> world(config);
  world.add(floor_at<2>());
  for (int i = 0; i < 4; ++i) world.add(box_at<2>({0, 0.5 + i}));
  return world;
}

TEST(SwitchContacts, BeforeTheFirstStepItIsAsIfMadeSo) {
  for (const auto& [from, to] : {std::pair{ContactMethod::impulse, ContactMethod::soft},
                                 std::pair{ContactMethod::soft, ContactMethod::impulse}}) {
    World<2> switched = pile(from), made = pile(to);
    switched.switch_contacts(to, made.config().sub_steps, made.config().iterations);
    for (int i = 0; i < 60; ++i) {
      switched.step(kStep);
      made.step(kStep);
    }
    EXPECT_EQ(switched.hash(), made.hash()) << to_string(to);
    EXPECT_EQ(switched.work().constraint_rows, made.work().constraint_rows) << to_string(to);
  }
}

TEST(SwitchContacts, APileStandsOnThroughEverySwitch) {
  World<2> world = pile(ContactMethod::impulse);
  for (int i = 0; i < 600; ++i) {
    if (i % 100 == 50) world.switch_contacts(ContactMethod::soft, 8, 10);
    if (i > 0 && i % 100 == 0) world.switch_contacts(ContactMethod::impulse, 8, 20);
    world.step(kStep);
    for (std::size_t k = 1; k < world.bodies().size(); ++k) {
      ASSERT_NEAR(world.bodies()[k].position.y, double(k) - 0.5, 0.03) << "step " << i;
      ASSERT_LT(glm::length(world.bodies()[k].velocity), 0.3)
          << "a switch must not throw what rests, step " << i;
    }
  }
}

TEST(SwitchContacts, RefusesToBeginOrEndContactsAndBadNumbers) {
  World<2> none(without_contacts<2>());
  EXPECT_THROW(none.switch_contacts(ContactMethod::soft, 8, 10), Refused);
  World<2> world = pile(ContactMethod::soft);
  world.step(kStep);
  const std::uint64_t before = world.hash();
  EXPECT_THROW(world.switch_contacts(ContactMethod::none, 8, 10), Refused);
  EXPECT_THROW(world.switch_contacts(ContactMethod::soft, 0, 10), Refused);
  EXPECT_THROW(world.switch_contacts(ContactMethod::impulse, 8, 0), Refused);
  EXPECT_EQ(world.hash(), before);
  EXPECT_EQ(world.config().contacts, ContactMethod::soft);
  EXPECT_EQ(world.config().sub_steps, 8) << "a refusal must change nothing";
}

template <int D>
void expect_shares_add_up() {
  Random random(7);
  World<D> world(without_contacts<D>());
  for (int i = 0; i < 8; ++i) {
    Body<D> body = box_at<D>(along<D>(random.between(-5, 5), random.between(-5, 5)));
    body.velocity = up<D>(random.between(-1, 1));
    if (i >= 6) body.kind = BodyKind::static_body;
    if (i >= 6) body.velocity = Vec<D>(0.0);
    world.add(body);
  }
  for (BodyId a = 0; a < 6; ++a)
    for (BodyId b = a + 1; b < 8; ++b)
      world.add_spring({a, b, Vec<D>(0.1), Vec<D>(0.0), 1, random.between(1, 9), 0});
  double sum = 0;
  for (const Body<D>& body : world.bodies())
    sum += energy_of<D>(body, world.bodies(), world.forces()).total();
  EXPECT_NEAR(sum, energy<D>(world.bodies(), world.forces()).total(), 1e-9 * std::abs(sum));
}

TEST(Energy, SharesOfAllBodiesAddUpToTheWhole) {
  expect_shares_add_up<2>();
  expect_shares_add_up<3>();
}

}  // namespace
}  // namespace lantern::physics
