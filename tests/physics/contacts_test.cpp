// Friction, rolling and what a step tells of contacts, against closed forms.
#include "physics/contacts.hpp"

#include <algorithm>
#include <numbers>
#include <string_view>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "physics/forces.hpp"
#include "world_scene.hpp"

namespace lantern::physics {
namespace {

template <int D>
Vec<D> heading(int i) {
  const double angle = 2 * std::numbers::pi * i / 24;
  Vec<D> direction{0.0};
  direction.x = std::cos(angle);
  direction[D - 1] = std::sin(angle);
  return direction;
}

TEST(Contacts, SlidesAsFarInEveryHeading) {
  for (const bool turns : {false, true})
    for (int i = 0; i < 24; ++i) {
      World<3> world(falling<3>());
      world.add(floor_at<3>());
      Body<3> box = box_at<3>(up<3>(0.5));
      box.velocity = heading<3>(i) * 5.0;
      box.may_turn = turns;
      world.add(box);
      run(world, 1.5);
      const Vec<3> way = world.bodies()[1].position - box.position;
      EXPECT_NEAR(glm::length(way), 2.5, 1e-10) << "v^2 / (2 mu g), heading " << i;
      EXPECT_NEAR(glm::dot(way, heading<3>(i)), 2.5, 1e-10) << "left its heading " << i;
    }
}

TEST(Contacts, SlidingDoesNotDependOnTheStep) {
  for (const Integrator integrator : {Integrator::semi_implicit_euler, Integrator::velocity_verlet})
    for (const double h : {1.0 / 30, 1.0 / 60, 1.0 / 144}) {
      WorldConfig<2> config = falling<2>();
      config.integrator = integrator;
      World<2> world(config);
      world.add(floor_at<2>());
      Body<2> box = box_at<2>(up<2>(0.5));
      box.velocity = {3, 0};
      world.add(box);
      run(world, 2, h);
      EXPECT_NEAR(world.bodies()[1].position.x, 0.9, 1e-6) << to_string(integrator) << " " << h;
    }
}

TEST(Contacts, ABallSlipsThenRolls) {
  World<3> world(falling<3>());
  world.add(floor_at<3>());
  world.add(ball_at<3>(up<3>(0.5), along<3>(7)));
  run(world, 3);
  const Body<3>& ball = world.bodies()[1];
  EXPECT_NEAR(ball.velocity.x, 5, 1e-9) << "5/7 of its speed";
  EXPECT_NEAR(angular_velocity(ball).z, -10, 1e-9) << "rolls without slipping";
  EXPECT_NEAR(ball.position.y, 0.5, 1e-9);
}

// sticks if and only if tan(alpha) <= mu
TEST(Contacts, SticksOnASlopeUpToTheFrictionAngle) {
  for (const double mu : {0.3, 0.5, 1.0})
    for (const double off : {-1e-3, 1e-3})
      for (const Integrator integrator :
           {Integrator::semi_implicit_euler, Integrator::velocity_verlet}) {
        WorldConfig<2> config;
        const double alpha = std::atan(mu + off);
        config.gravity = {10 * std::sin(alpha), -10 * std::cos(alpha)};
        config.integrator = integrator;
        World<2> world(config);
        world.add(floor_at<2>(0, mu));
        Body<2> box = box_at<2>(up<2>(0.5));
        box.material.friction = mu;
        box.may_turn = false;
        world.add(box);
        run(world, 2);
        const double a = 10 * (std::sin(alpha) - mu * std::cos(alpha));
        EXPECT_NEAR(world.bodies()[1].velocity.x, off > 0 ? a * 2 : 0, 1e-9);
        if (off < 0) {
          EXPECT_NEAR(world.bodies()[1].position.x, 0, 1e-9) << "creeps";
        }
      }
}

constexpr ContactMethod kPressing[] = {ContactMethod::impulse, ContactMethod::soft,
                                       ContactMethod::direct};
constexpr Integrator kEveryIntegrator[] = {
    Integrator::explicit_euler, Integrator::semi_implicit_euler, Integrator::velocity_verlet,
    Integrator::runge_kutta_4,  Integrator::implicit_midpoint,   Integrator::implicit_euler};

// A box on a slope of so many radians, down which x points.
template <int D>
World<D> sloping(ContactMethod contacts, Integrator integrator, double angle, double mu,
                 double speed = 0) {
  WorldConfig<D> config;
  config.gravity = along<D>(10 * std::sin(angle), -10 * std::cos(angle));
  config.contacts = contacts;
  config.integrator = integrator;
  World<D> world(config);
  world.add(floor_at<D>(0, mu));
  Body<D> box = box_at<D>(up<D>(0.1));
  Vec<D> half(0.1);
  half.x = 0.5;
  box.shape = OrientedBox<D>{half};
  box.material.friction = mu;
  box.velocity = along<D>(speed);
  world.add(box);
  return world;
}

// Down a slope beyond its limit: the place is where the velocities lead, which each method sums in
// its own way, by those of the start of a step, of its end, or by both.
template <int D>
void expect_places_follow(ContactMethod contacts, Integrator integrator, Random& random) {
  const double angle = random.between(0.2, 0.8), h = random.between(0.005, 0.02);
  const double mu = std::tan(angle) / random.between(1.003, 2);
  World<D> world = sloping<D>(contacts, integrator, angle, mu);
  double mean_way = 0, last = 0;
  for (int i = 0; i < 150; ++i) {
    world.step(h);
    const double speed = world.bodies()[1].velocity.x;
    mean_way += h * (last + speed) / 2;
    last = speed;
  }
  const double off = world.bodies()[1].position.x - mean_way;
  const std::string_view name = to_string(integrator);
  const bool second = integration(integrator).order > 1;
  EXPECT_LT(std::abs(off), (second ? 0 : 1.001 * last * h / 2) + 2e-5)
      << D << "D " << to_string(contacts) << ' ' << name << " tan " << std::tan(angle) << " mu "
      << mu << " h " << h;
  const double g = 10 * (std::sin(angle) - mu * std::cos(angle));
  EXPECT_NEAR(last, g * 150 * h, contacts == ContactMethod::impulse ? 1e-2 : 1e-8) << name;
}

TEST(Contacts, PlacesFollowVelocitiesUnderFriction) {
  Random random(21);
  for (const ContactMethod contacts : kPressing)
    for (const Integrator integrator : kEveryIntegrator) {
      expect_places_follow<2>(contacts, integrator, random);
      expect_places_follow<3>(contacts, integrator, random);
    }
}

// Below its limit it stays, and what slides down comes to rest where the closed form says.
template <int D>
void expect_rests(ContactMethod contacts, Integrator integrator, Random& random) {
  const double angle = random.between(0.2, 0.8), h = random.between(0.005, 0.02);
  const double part = random.between(0.5, 0.99), mu = std::tan(angle) / part;
  World<D> stays = sloping<D>(contacts, integrator, angle, mu);
  World<D> slides = sloping<D>(contacts, integrator, angle, std::tan(angle) / 0.6, 2);
  for (int i = 0; i < 200; ++i) stays.step(h);
  EXPECT_NEAR(stays.bodies()[1].position.x, 0, 1e-4)
      << D << "D " << to_string(contacts) << ' ' << to_string(integrator) << ' ' << part;
  for (int i = 0; i < 200; ++i) slides.step(h);
  const double way = 2 * 2 / (2 * 10 * std::sin(angle) * (1 / 0.6 - 1));
  EXPECT_NEAR(slides.bodies()[1].position.x, way, 2e-3 * way)
      << D << "D " << to_string(contacts) << ' ' << to_string(integrator) << ' ' << h;
}

TEST(Contacts, FrictionStopsABoxOnASlope) {
  Random random(22);
  for (const ContactMethod contacts : kPressing)
    for (const Integrator integrator :
         {Integrator::semi_implicit_euler, Integrator::velocity_verlet,
          Integrator::implicit_midpoint, Integrator::implicit_euler}) {
      expect_rests<2>(contacts, integrator, random);
      expect_rests<3>(contacts, integrator, random);
    }
}

// A ball rolls down a slope: its place is as right as its speed.
template <int D>
void expect_rolls(ContactMethod contacts, Integrator integrator, Random& random) {
  const double angle = random.between(0.1, 0.6), h = random.between(0.005, 0.02);
  const double mu = std::tan(angle) * random.between(0.5, 2), radius = random.between(0.1, 2);
  WorldConfig<D> config;
  config.gravity = along<D>(10 * std::sin(angle), -10 * std::cos(angle));
  config.contacts = contacts;
  config.integrator = integrator;
  World<D> world(config);
  world.add(floor_at<D>(0, mu));
  Body<D> ball = ball_at<D>(up<D>(radius), Vec<D>(0.0), radius);
  ball.material.friction = mu;
  world.add(ball);
  for (int i = 0; i < 200; ++i) world.step(h);
  const double g = 10 * std::sin(angle) / (1 + (D == 2 ? 0.5 : 0.4)), time = 200 * h;
  const std::string_view name = to_string(integrator);
  EXPECT_NEAR(world.bodies()[1].velocity.x / (g * time), 1, 1e-11) << name;
  EXPECT_NEAR(world.bodies()[1].position.x / (g * time * time / 2), 1, 1e-11)
      << D << "D " << to_string(contacts) << ' ' << name;
}

TEST(Contacts, ABallRollsAsFarAsItsSpeedSays) {
  Random random(24);
  for (const ContactMethod contacts : kPressing)
    for (const Integrator integrator : kEveryIntegrator) {
      if (integrator == Integrator::explicit_euler) continue;
      expect_rolls<2>(contacts, integrator, random);
      expect_rolls<3>(contacts, integrator, random);
    }
}

TEST(Contacts, PressesWithItsWeight) {
  World<2> world(falling<2>());
  world.add(floor_at<2>());
  world.add(box_at<2>(up<2>(0.5)));
  run(world, 0.2);
  ASSERT_EQ(world.contacts().size(), 1u);
  const Contact<2>& contact = world.contacts()[0];
  EXPECT_EQ(contact.a, 0u);
  EXPECT_EQ(contact.b, 1u);
  EXPECT_EQ(contact.manifold.normal, (Vec<2>{0, 1}));
  EXPECT_NEAR(contact.normal_impulses[0] + contact.normal_impulses[1], 10 * kStep, 1e-9);
}

TEST(Contacts, EachPairBeginsStaysAndEndsOnce) {
  WorldConfig<2> config = falling<2>();
  config.may_sleep = false;
  World<2> world(config);
  world.add(floor_at<2>());
  world.add(box_at<2>(up<2>(0.6)));
  std::string story;
  for (int i = 0; i < 60; ++i) {
    if (i == 40) world.set_velocity(1, {0, 3});
    world.step(kStep);
    ASSERT_LE(world.events().size(), 1u);
    for (const ContactEvent& event : world.events()) {
      const char letter = "bse"[static_cast<int>(event.kind)];
      if (story.empty() || story.back() != letter) story += letter;
    }
  }
  EXPECT_EQ(story, "bse") << "begins, stays, ends";
}

// A kinematic wall pushes a box against one that stands, and on.
template <int D>
void expect_crush(bool pushed) {
  WorldConfig<D> config;
  World<D> world(config);
  for (const double side : {-1.0, 1.0}) {
    Body<D> wall = box_at<D>(along<D>(side * 2.0));
    wall.name = "wall";
    wall.kind = side < 0 ? BodyKind::kinematic_body : BodyKind::static_body;
    if (side < 0 && pushed) wall.velocity = along<D>(1.0);
    world.add(wall);
  }
  const BodyId box = world.add(box_at<D>(Vec<D>(0.0)));
  int first = 0;
  double fastest = 0;
  for (int i = 1; i <= 150; ++i) {  // they meet after one second, and lie in one after two
    world.step(kStep);
    fastest = std::max(fastest, glm::length(world.find(box)->velocity));
    for (const ContactEvent& event : world.events())
      if (event.crushes && first == 0) first = i;
  }
  EXPECT_EQ(first > 0, pushed);
  if (!pushed) return;
  EXPECT_NEAR(first * kStep, 2.25, 0.05) << "a quarter of a unit box";
  EXPECT_LE(fastest, 2) << "it is thrown";
}

TEST(Contacts, AWallThatCrushesSaysSo) {
  expect_crush<2>(true);
  expect_crush<3>(true);
  expect_crush<2>(false);
}

TEST(Contacts, AStackThatRestsCrushesNobody) {
  World<2> world(falling<2>());
  world.add(floor_at<2>());
  for (int i = 0; i < 5; ++i) world.add(box_at<2>(up<2>(0.5 + i)));
  for (int i = 0; i < 60; ++i) {
    world.step(kStep);
    for (const ContactEvent& event : world.events()) ASSERT_FALSE(event.crushes);
  }
}

// So many that their pairs are a crowd (quick_sweeps.hpp). They do not fall asleep in each other.
template <int D>
void expect_to_part(const Shape<D>& shape) {
  World<D> world(WorldConfig<D>{});
  for (int i = 0; i < 36; ++i) {
    Body<D> body;
    body.shape = shape;
    world.add(body);
  }
  double fastest = 0;
  std::size_t first = 0;
  for (int i = 0; i < 36; ++i) {  // longer than what rests takes to fall asleep
    world.step(kStep);
    if (i == 0) first = world.contacts().size();
    for (const Body<D>& body : world.bodies())
      fastest = std::max(fastest, glm::length(body.velocity));
  }
  EXPECT_EQ(first, 630u) << "all pairs";
  EXPECT_LT(world.contacts().size(), first / 2);
  EXPECT_EQ(world.work().asleep, 0u);
  EXPECT_LT(fastest, 1e-6) << "they are thrown";
}

TEST(Contacts, BodiesAtOnePointPart) {
  expect_to_part<2>(OrientedBox<2>{Vec<2>(0.5)});
  expect_to_part<3>(Sphere{0.5});
}

TEST(Contacts, FrictionRowsOnlyWhereThereIsFriction) {
  World<2> world(falling<2>());
  world.add(floor_at<2>(0, 0));
  Body<2> box = box_at<2>(up<2>(0.5));
  world.add(box);
  run(world, 0.5);
  EXPECT_GT(world.work().constraint_rows, 0u);
  EXPECT_EQ(world.work().friction_rows, 0u);
}

TEST(Contacts, DeepOverlapComesApartSlowly) {
  WorldConfig<2> config;
  World<2> world(config);
  world.add(box_at<2>({0, 0}));
  world.add(box_at<2>({0.1, 0}));
  double fastest = 0;
  for (int i = 0; i < 120; ++i) {
    world.step(kStep);
    for (const Body<2>& body : world.bodies())
      fastest = std::max(fastest, glm::length(body.velocity));
  }
  EXPECT_LE(deepest(world), 1e-3);
  EXPECT_LE(fastest, 1e-9) << "pushing apart must not become motion";
}

// A force F on a plate of mass M with a ball of mass m on it, which rolls: the plate is accelerated
// by (F - mu (M + m) g) / (M + 2 m / 7), the ball by 2/7 of that (Newton's and Euler's equations).
TEST(Contacts, RollsOnAPlateThatIsPulled) {
  for (const ContactMethod method :
       {ContactMethod::soft, ContactMethod::direct, ContactMethod::impulse}) {
    WorldConfig<3> config = falling<3>();
    config.contacts = method;
    config.integrator = Integrator::velocity_verlet;
    World<3> world(config);
    world.add(floor_at<3>(0, 0.4));
    Body<3> plate = box_at<3>({0, 0.5, 0});
    plate.shape = OrientedBox<3>{{10, 0.5, 10}};
    plate.mass = 10;
    plate.material.friction = 0.4;
    const BodyId pulled = world.add(plate);
    Body<3> ball = ball_at<3>({0, 1.5, 0});
    ball.mass = 1;
    ball.material.friction = 0.4;
    const BodyId rolls = world.add(ball);
    world.push(pulled, {60, 0, 0}, {0, 0.5, 0});
    run(world, 2);
    const double speed = 2 * (60 - 0.4 * 11 * 10) / (10 + 2.0 / 7),
                 within = method == ContactMethod::impulse ? 1e-5 : 1e-11;
    EXPECT_NEAR(world.find(pulled)->velocity.x, speed, within);
    EXPECT_NEAR(world.find(rolls)->velocity.x, speed * 2 / 7, within);
    EXPECT_NEAR(world.find(pulled)->position.x, speed, 2 * within);
    EXPECT_NEAR(world.find(rolls)->position.x, speed * 2 / 7, 2 * within);
  }
}

// Spin about its long axis is dear: whatever turns a needle without its angular momentum makes
// some.
TEST(Contacts, ANeedleOnTheGroundGainsNoEnergy) {
  for (const ContactMethod method :
       {ContactMethod::soft, ContactMethod::direct, ContactMethod::impulse}) {
    WorldConfig<3> config = falling<3>();
    config.contacts = method;
    World<3> world(config);
    world.add(floor_at<3>());
    Body<3> needle = box_at<3>({0, 1.5, 0});
    needle.shape = OrientedBox<3>{{1, 0.001, 0.001}};
    needle.mass = 1;
    const BodyId id = world.add(needle);
    world.set_angular_velocity(id, {0, 0.1, 10});
    const auto energy_of = [&] {
      const Energy sum = energy<3>(world.bodies(), world.forces());
      return sum.linear + sum.rotational + sum.gravity;
    };
    const double before = energy_of();
    for (int i = 0; i < 120; ++i) {
      world.step(kStep);
      EXPECT_LE(energy_of(), before * (1 + 1e-3));
    }
  }
}

// Of three, each as deep as half of what crushes, the first and the last push against each other.
TEST(Crushing, IsOfThoseThatPressFromOppositeSides) {
  std::vector<Body<2>> bodies(4);
  for (BodyId id = 0; id < 4; ++id) bodies[id].id = id;
  bodies[0].shape = Sphere{1};
  for (BodyId id = 1; id < 4; ++id) bodies[id].kind = BodyKind::static_body;
  const Vec<2> from_zero[] = {{1, 0}, {0, 1}, {-1, 0}};
  std::vector<Contact<2>> contacts;
  for (BodyId id = 1; id < 4; ++id) {
    Contact<2> contact{0, id, {}, {1}, {}};
    contact.manifold.normal = from_zero[id - 1];
    contact.manifold.add({Vec<2>(0.0), -0.6, 0});
    contacts.push_back(contact);
  }
  const auto body_of = [&](BodyId id) -> const Body<2>& { return bodies[id]; };
  EXPECT_EQ(crushing<2>(contacts, body_of), (Scratch<std::uint8_t>{1, 0, 1}));
  contacts.pop_back();
  EXPECT_TRUE(crushing<2>(contacts, body_of).empty()) << "from the side";
}

}  // namespace
}  // namespace lantern::physics
