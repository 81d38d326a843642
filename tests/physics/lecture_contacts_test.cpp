// Contacts solved as the lecture does it, in the engine's world.
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "lecture/physics_system.hpp"
#include "physics/world_scene.hpp"

namespace lantern::physics {
namespace {

template <int D>
WorldConfig<D> by_the_lecture() {
  WorldConfig<D> config;
  config.contacts = ContactMethod::lecture;
  config.may_sleep = false;
  return config;
}

template <int D>
Vec<D> any_point(Random& random, double lo, double hi) {
  Vec<D> point;
  for (int i = 0; i < D; ++i) point[i] = random.between(lo, hi);
  return point;
}

template <int D>
Vec<D> momentum(const World<D>& world) {
  Vec<D> sum(0.0);
  for (const Body<D>& body : world.bodies())
    if (body.inverse_mass > 0) sum += body.velocity / body.inverse_mass;
  return sum;
}

template <int D>
void expect_swapped() {
  World<D> world(by_the_lecture<D>());
  Body<D> one = ball_at<D>(along<D>(-1), along<D>(3)),
          other = ball_at<D>(along<D>(1), along<D>(-1));
  one.material.restitution = other.material.restitution = 1;
  const BodyId a = world.add(one), b = world.add(other);
  bool touched = false;
  for (int i = 0; i < 40; ++i) {
    world.step(kStep);
    for (const Contact<D>& contact : world.contacts()) {
      touched = true;
      EXPECT_EQ(contact.manifold.count, 1) << "one point a pair";
      EXPECT_NEAR(contact.normal_impulses[0], 4 / world.find(a)->inverse_mass, 1e-12);
    }
  }
  EXPECT_TRUE(touched);
  EXPECT_NEAR(glm::length(world.find(a)->velocity - along<D>(-1)), 0, 1e-14);
  EXPECT_NEAR(glm::length(world.find(b)->velocity - along<D>(3)), 0, 1e-14);
}

TEST(LectureContacts, EqualBallsSwapTheirVelocities) {
  expect_swapped<2>();
  expect_swapped<3>();
}

template <int D>
World<D> mixed_crowd(const WorldConfig<D>& config) {
  World<D> world(config);
  Random random(21);
  for (int i = 0; i < 40; ++i) {
    const Vec<D> at = any_point<D>(random, -4, 4), velocity = any_point<D>(random, -5, 5);
    Body<D> body = i % 2 == 0 ? ball_at<D>(at, velocity) : box_at<D>(at);
    body.velocity = velocity;
    body.material.restitution = 0.5;
    world.add(body);
  }
  return world;
}

template <int D>
void expect_momentum_kept() {
  World<D> world = mixed_crowd(by_the_lecture<D>());
  const Vec<D> before = momentum(world);
  std::uint64_t touches = 0;
  for (int i = 0; i < 60; ++i) {
    world.step(kStep);
    touches += world.contacts().size();
  }
  EXPECT_GT(touches, 15u);
  EXPECT_NEAR(glm::length(momentum(world) - before), 0, 1e-10);
  EXPECT_EQ(world.work().narrow_tests >= touches, true);
  EXPECT_EQ(world.work().normal_rows, world.work().constraint_rows) << "no friction";
}

TEST(LectureContacts, MomentumIsKept) {
  expect_momentum_kept<2>();
  expect_momentum_kept<3>();
}

TEST(LectureContacts, EveryBroadPhaseGivesTheSameMotion) {
  std::optional<std::uint64_t> hash;
  for (const StructureKind kind : kStructureKinds) {
    WorldConfig<3> config = by_the_lecture<3>();
    config.broad_phase.kind = kind;
    World<3> world = mixed_crowd(config);
    run(world, 1);
    EXPECT_EQ(world.hash(), hash.value_or(world.hash())) << to_string(kind);
    hash = world.hash();
  }
}

// The lecture's own PhysicsSystem, whole, with its tree and its set of pairs; and the engine's
// world, of which only the narrow phase is the lecture's. Not crowded: where a projection pushes a
// body into one that its box did not reach, the world meets the two a step later than the lecture,
// whose leaves are coarser.
TEST(LectureContacts, TheWorldMovesAsTheLecturesPhysicsSystemDoes) {
  WorldConfig<3> config = by_the_lecture<3>();
  config.gravity = {0, -2, 0};
  World<3> world(config);
  lecture::GameWorld game;
  lecture::PhysicsSystem system(game, [](lecture::GameObject* a, lecture::GameObject* b,
                                         lecture::CollisionDetection::CollisionInfo& info) {
    const Vec<3> pa = a->GetConstTransform().GetWorldPosition(),
                 pb = b->GetConstTransform().GetWorldPosition();
    const auto manifold =
        collide<3>({*a->GetBoundingVolume(), pa, {}}, {*b->GetBoundingVolume(), pb, {}}, 0);
    if (!manifold) return false;
    info.point = {manifold->room[0].position - pa, manifold->room[0].position - pb,
                  manifold->normal, -manifold->room[0].separation};
    return true;
  });
  system.SetGravity({0, -2, 0});
  system.SetTree(lecture::Vector2(0.0), lecture::Vector2(8.0), 4, 2);
  Random random(22);
  std::vector<lecture::GameObject> objects;
  objects.reserve(30);
  for (int i = 0; i < 30; ++i) {
    Body<3> ball = ball_at<3>(any_point<3>(random, -3, 3), any_point<3>(random, -3, 3));
    ball.material.restitution = 0.8;
    ball.may_turn = false;
    const BodyId id = world.add(ball);
    lecture::GameObject& object = objects.emplace_back(id, ball.shape);
    object.GetTransform().SetWorldPosition(ball.position);
    object.GetPhysicsObject().SetLinearVelocity(ball.velocity);
    object.GetPhysicsObject().SetInverseMass(world.find(id)->inverse_mass);
    object.GetPhysicsObject().SetElasticity(0.8);
    game.AddGameObject(&object);
  }
  std::size_t touches = 0;
  for (int step = 0; step < 40; ++step) {
    world.step(kStep);
    system.Update(kStep);
    touches += world.contacts().size();
    for (int i = 0; i < 30; ++i)
      ASSERT_EQ(world.bodies()[i].position, objects[i].GetConstTransform().GetWorldPosition())
          << "body " << i << " after step " << step;
  }
  EXPECT_GT(touches, 15u);
}

TEST(LectureContacts, ABoxRestsOnTheFloorThoughItTrembles) {
  WorldConfig<2> config = by_the_lecture<2>();
  config.gravity = {0, -10};
  World<2> world(config);
  world.add(floor_at<2>());
  world.add(box_at<2>({0, 0.6}));
  run(world, 3);
  EXPECT_NEAR(world.bodies()[1].position.y, 0.5, 2 * 10 * kStep * kStep);
  EXPECT_NEAR(world.bodies()[1].orientation.angle, 0, 1e-9);
}

// A ball bounces lower and lower. Its short flights are hidden: the lecture's framesLeft tells of
// the end of a collision five frames after the last touch, and of no beginning before.
TEST(LectureContacts, CollisionsAreRememberedForSomeFrames) {
  constexpr int kFrames = lecture::PhysicsSystem::numCollisionFrames;
  WorldConfig<2> config = by_the_lecture<2>();
  config.gravity = {0, -10};
  World<2> world(config);
  world.add(floor_at<2>());
  Body<2> ball = ball_at<2>({0, 2});
  ball.material.restitution = 0.3;
  world.add(ball);
  bool together = false;
  int without = 0, hidden = 0, ends = 0;
  for (int i = 0; i < 300; ++i) {
    world.step(kStep);
    using Kind = ContactEvent::Kind;
    std::vector<ContactEvent> expected;
    if (!world.contacts().empty()) {
      expected.push_back({together ? Kind::stay : Kind::begin, 0, 1});
      hidden += together && without > 0;
      together = true;
      without = 0;
    } else if (together && ++without == kFrames) {
      expected.push_back({Kind::end, 0, 1});
      together = false;
      ++ends;
    }
    EXPECT_EQ(world.events(), expected) << "step " << i;
  }
  EXPECT_GT(hidden, 0);
  EXPECT_GT(ends, 1);
}

TEST(LectureContacts, JointsAreRefusedAndTheWorldStaysAsItWas) {
  World<2> world(by_the_lecture<2>());
  const BodyId a = world.add(ball_at<2>({0, 0}, {1, 0})), b = world.add(ball_at<2>({3, 0}));
  world.add_joint({JointKind::pin, a, b, {1.5, 0}, {-1.5, 0}});
  const std::uint64_t before = world.hash();
  EXPECT_THROW(world.step(kStep), Refused);
  EXPECT_EQ(world.hash(), before);
}

// The corners of the boxes around them overlap.
TEST(LectureContacts, BallsThatPassEachOtherAreLeftAlone) {
  World<2> world(by_the_lecture<2>());
  Body<2> one = ball_at<2>({0, 0}, {0, 0}), other = ball_at<2>({0, 0}, {0, 0});
  const double radius = std::get<Sphere>(one.shape).radius;
  other.position = Vec<2>(1.8 * radius, 1.8 * radius);
  one.velocity = {0.5, -0.5};
  other.velocity = {-0.5, 0.5};
  const BodyId a = world.add(one), b = world.add(other);
  for (int i = 0; i < 5; ++i) world.step(0.001);
  EXPECT_EQ(world.find(a)->velocity, Vec<2>(0.5, -0.5));
  EXPECT_EQ(world.find(b)->velocity, Vec<2>(-0.5, 0.5));
  EXPECT_TRUE(world.contacts().empty());
  EXPECT_GT(world.work().narrow_tests, 0u) << "they were looked at";
}

}  // namespace
}  // namespace lantern::physics
