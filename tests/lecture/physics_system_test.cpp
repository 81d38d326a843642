// The lecture's phases: what they find, what an impulse keeps, how long a collision is remembered.
#include "lecture/physics_system.hpp"

#include <memory>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/random.hpp"
#include "geometry/random_vec.hpp"

namespace lantern::lecture {
namespace {

class Ghost : public GameObject {
 public:
  using GameObject::GameObject;
  void OnCollisionBegin(GameObject* other) override { began.push_back(other->GetWorldID()); }
  void OnCollisionEnd(GameObject* other) override { ended.push_back(other->GetWorldID()); }
  std::vector<std::uint32_t> began, ended;
};

bool spheres_intersect(GameObject* a, GameObject* b, CollisionDetection::CollisionInfo& info) {
  const double ra = std::get<Sphere>(*a->GetBoundingVolume()).radius;
  const double rb = std::get<Sphere>(*b->GetBoundingVolume()).radius;
  const Vector3 way =
      b->GetConstTransform().GetWorldPosition() - a->GetConstTransform().GetWorldPosition();
  const double distance = glm::length(way);
  if (distance > ra + rb) return false;
  info.point.normal = distance > 0 ? way / distance : Vector3(0, 1, 0);
  info.point.localA = info.point.normal * ra;
  info.point.localB = -info.point.normal * rb;
  info.point.penetration = ra + rb - distance;
  return true;
}

struct Scene {
  GameWorld world;
  PhysicsSystem system{world, spheres_intersect};
  std::vector<std::unique_ptr<Ghost>> ghosts;

  Ghost& add(std::uint32_t id, const Vector3& at, const Vector3& velocity, double radius = 1,
             double inverse_mass = 1) {
    ghosts.push_back(std::make_unique<Ghost>(id, Sphere{radius}));
    Ghost& ghost = *ghosts.back();
    ghost.GetTransform().SetWorldPosition(at);
    PhysicsObject& object = ghost.GetPhysicsObject();
    object.SetLinearVelocity(velocity);
    object.SetInverseMass(inverse_mass);
    object.SetInertiaTensor(Matrix3(inverse_mass * 2.5 / (radius * radius)));
    object.SetElasticity(1);
    world.AddGameObject(&ghost);
    return ghost;
  }
  Vector3 momentum() const {
    Vector3 sum(0.0);
    for (const auto& ghost : ghosts)
      if (const double m = ghost->GetPhysicsObject().GetInverseMass(); m > 0)
        sum += ghost->GetPhysicsObject().GetLinearVelocity() / m;
    return sum;
  }
  double energy() const {
    double sum = 0;
    for (const auto& ghost : ghosts) {
      const Vector3 v = ghost->GetPhysicsObject().GetLinearVelocity();
      sum += 0.5 * glm::dot(v, v) / ghost->GetPhysicsObject().GetInverseMass();
    }
    return sum;
  }
};

const Vector3& velocity_of(Ghost& ghost) { return ghost.GetPhysicsObject().GetLinearVelocity(); }

using ContactPoint = CollisionDetection::ContactPoint;

TEST(LecturePhysics, EqualSpheresSwapTheirVelocities) {
  Scene scene;
  Ghost& a = scene.add(0, {-1, 0, 0}, {3, 0, 0});
  Ghost& b = scene.add(1, {1, 0, 0}, {-1, 0, 0});
  PhysicsSystem::ImpulseResolveCollision(a, b, {{1, 0, 0}, {-1, 0, 0}, {1, 0, 0}, 0});
  EXPECT_EQ(velocity_of(a), Vector3(-1, 0, 0));
  EXPECT_EQ(velocity_of(b), Vector3(3, 0, 0));
}

TEST(LecturePhysics, WithoutElasticityTheyGoOnTogether) {
  Scene scene;
  Ghost& a = scene.add(0, {-1, 0, 0}, {3, 0, 0});
  Ghost& b = scene.add(1, {1, 0, 0}, {-1, 0, 0});
  for (Ghost* ghost : {&a, &b}) ghost->GetPhysicsObject().SetElasticity(0);
  PhysicsSystem::ImpulseResolveCollision(a, b, {{1, 0, 0}, {-1, 0, 0}, {1, 0, 0}, 0});
  EXPECT_EQ(velocity_of(a), Vector3(1, 0, 0));
  EXPECT_EQ(velocity_of(b), Vector3(1, 0, 0));
}

TEST(LecturePhysics, ProjectionPartsThemExactlyTheLighterOneFurther) {
  Scene scene;
  Ghost& a = scene.add(0, {-1, 0, 0}, {0, 0, 0}, 1, 0.25);  // of mass 4
  Ghost& b = scene.add(1, {0.5, 0, 0}, {0, 0, 0}, 1, 0.75);
  PhysicsSystem::ImpulseResolveCollision(a, b, {{1, 0, 0}, {-1, 0, 0}, {1, 0, 0}, 0.5});
  EXPECT_EQ(a.GetTransform().GetWorldPosition(), Vector3(-1.125, 0, 0));
  EXPECT_EQ(b.GetTransform().GetWorldPosition(), Vector3(0.875, 0, 0));
}

TEST(LecturePhysics, WhatPartsAlreadyIsNotPulledBackAndWallsStay) {
  Scene scene;
  Ghost& a = scene.add(0, {-1, 0, 0}, {-1, 0, 0});
  Ghost& b = scene.add(1, {1, 0, 0}, {1, 0, 0});
  const ContactPoint point{{1, 0, 0}, {-1, 0, 0}, {1, 0, 0}, 0};
  PhysicsSystem::ImpulseResolveCollision(a, b, point);
  EXPECT_EQ(velocity_of(a), Vector3(-1, 0, 0));
  for (Ghost* ghost : {&a, &b}) {
    ghost->GetPhysicsObject().SetInverseMass(0);
    ghost->GetPhysicsObject().SetInertiaTensor(Matrix3(0.0));
    ghost->GetPhysicsObject().SetLinearVelocity(Vector3(0.0));
  }
  PhysicsSystem::ImpulseResolveCollision(a, b, {{1, 0, 0}, {-1, 0, 0}, {1, 0, 0}, 0.5});
  EXPECT_EQ(velocity_of(a), Vector3(0.0));
  EXPECT_EQ(a.GetTransform().GetWorldPosition(), Vector3(-1, 0, 0));
}

// Blows off the centre turn, and keep linear and angular momentum and, at elasticity 1, energy.
TEST(LecturePhysics, AnyBlowKeepsMomentumAndTurnsApproachAround) {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    Scene scene;
    Ghost& a = scene.add(0, random_point<3>(random, -1, 1), random_point<3>(random, -5, 5), 1,
                         random.between(0.1, 3));
    Ghost& b = scene.add(1, random_point<3>(random, 2, 4), random_point<3>(random, -5, 5), 1,
                         random.between(0.1, 3));
    const Vector3 at = random_point<3>(random, -1, 4);
    ContactPoint p;
    p.localA = at - a.GetTransform().GetWorldPosition();
    p.localB = at - b.GetTransform().GetWorldPosition();
    p.normal = random_direction<3>(random);
    const auto spin = [](Ghost& g) { return g.GetPhysicsObject().GetAngularVelocity(); };
    const auto inertia = [](Ghost& g) { return 1 / g.GetPhysicsObject().GetInertiaTensor()[0][0]; };
    const auto approach = [&] {
      return glm::dot(
          velocity_of(b) + cross(spin(b), p.localB) - velocity_of(a) - cross(spin(a), p.localA),
          p.normal);
    };
    const auto energy = [&] {
      return scene.energy() + 0.5 * inertia(a) * glm::dot(spin(a), spin(a)) +
             0.5 * inertia(b) * glm::dot(spin(b), spin(b));
    };
    const auto angular = [&] {
      Vector3 sum = inertia(a) * spin(a) + inertia(b) * spin(b);
      for (Ghost* g : {&a, &b})
        sum += cross(g->GetTransform().GetWorldPosition(),
                     velocity_of(*g) / g->GetPhysicsObject().GetInverseMass());
      return sum;
    };
    const double before = approach(), energy_before = energy();
    const Vector3 momentum = scene.momentum(), angular_before = angular();
    PhysicsSystem::ImpulseResolveCollision(a, b, p);
    EXPECT_NEAR(glm::length(scene.momentum() - momentum), 0, 1e-11);
    EXPECT_NEAR(glm::length(angular() - angular_before), 0, 1e-11);
    EXPECT_NEAR(energy(), energy_before, 1e-10 * energy_before);
    EXPECT_NEAR(approach(), before < 0 ? -before : before, 1e-11);
  }
}

// The sums of addresses by which the text orders pairs are equal for these two, so that its set
// would hold one of them only.
TEST(LecturePhysics, MendedTwoPairsAreNeverTakenForOne) {
  std::vector<GameObject> objects;
  for (std::uint32_t i = 0; i < 300; ++i) objects.emplace_back(i, Sphere{1});
  const auto sum = [&](int a, int b) {
    return reinterpret_cast<std::uintptr_t>(&objects[a]) +
           (reinterpret_cast<std::uintptr_t>(&objects[b]) << 8);
  };
  ASSERT_EQ(sum(256, 270), sum(0, 271));
  GameWorld world;
  PhysicsSystem system(world, spheres_intersect);
  system.AddBroadphaseCollision(&objects[256], &objects[270]);
  system.AddBroadphaseCollision(&objects[271], &objects[0]);
  system.AddBroadphaseCollision(&objects[0], &objects[271]);
  ASSERT_EQ(system.GetBroadphaseCollisions().size(), 2u);
  EXPECT_EQ(system.GetBroadphaseCollisions().begin()->a, &objects[0]) << "ordered by ids";
  EXPECT_EQ(system.GetBroadphaseCollisions().begin()->b, &objects[271]);
}

TEST(LecturePhysics, MendedTooManyPairsAreRefused) {
  Scene scene;
  for (std::uint32_t i = 0; i < 10; ++i) scene.add(i, {0, 0, 0}, {0, 0, 0});
  scene.system.SetMostPairs(44);
  scene.system.UpdateObjectAABBs();
  EXPECT_THROW(scene.system.BroadPhase(), Refused) << "45 pairs";
  scene.system.SetMostPairs(45);
  scene.system.BroadPhase();
  EXPECT_EQ(scene.system.GetBroadphaseCollisions().size(), 45u);
}

TEST(LecturePhysics, BoxesOfAllVolumesHoldThem) {
  const Rotation<3> turn = turned(Rotation<3>{}, {0.3, 1.1, -0.4});
  const auto half_sizes = [&](const Shape<3>& shape) {
    GameObject object(0, shape);
    object.GetTransform().SetWorldPosition({5, 6, 7});
    object.GetTransform().SetWorldOrientation(turn.q);
    object.UpdateBroadphaseAABB();
    Vector3 size(0.0);
    EXPECT_TRUE(object.GetBroadphaseAABB(size));
    return size;
  };
  for (const Shape<3>& shape : {Shape<3>(Sphere{2}), Shape<3>(AxisBox<3>{{1, 2, 3}}),
                                Shape<3>(OrientedBox<3>{{1, 2, 3}}), Shape<3>(Capsule{1, 2})})
    EXPECT_NEAR(
        glm::length(half_sizes(shape) - bounding_box<3>(shape, {5, 6, 7}, turn).size() / 2.0), 0,
        1e-14);
  EXPECT_GE(half_sizes(HalfSpace<3>{{0, 1, 0}}).y, kEndless / 2)
      << "Mended: the text has no branch";
  Vector3 size(0.0);
  EXPECT_FALSE(GameObject(1).GetBroadphaseAABB(size)) << "no volume, no box";
}

// Two that touch for three frames and then part.
TEST(LecturePhysics, CallbacksAreCalledOnceAtTheBeginningAndOnceAfterTheLastFrame) {
  Scene scene;
  Ghost& a = scene.add(7, {0, 0, 0}, {0, 0, 0}, 1, 0);
  Ghost& b = scene.add(3, {2, 0, 0}, {0, 0, 0}, 1, 0);
  const auto frame = [&] { scene.system.Update(0.01); };
  for (int i = 0; i < 12; ++i) {
    frame();
    EXPECT_EQ(a.began, (std::vector<std::uint32_t>{3})) << "frame " << i;
    EXPECT_TRUE(a.ended.empty()) << "frame " << i
                                 << ": they still touch; mended, the text says end";
  }
  b.GetTransform().SetWorldPosition({3, 0, 0});
  for (int i = 1; i < PhysicsSystem::numCollisionFrames; ++i) frame();
  EXPECT_EQ(scene.system.GetAllCollisions().size(), 1u);
  EXPECT_TRUE(b.ended.empty());
  frame();
  EXPECT_EQ(b.ended, (std::vector<std::uint32_t>{7}));
  EXPECT_EQ(a.ended, (std::vector<std::uint32_t>{3}));
  EXPECT_TRUE(scene.system.GetAllCollisions().empty());
}

// The whole update, in trees of every depth: the same motion, bit for bit, since the pairs that
// really collide are the same and come in the same order.
TEST(LecturePhysics, TheTreeDoesNotChangeTheMotion) {
  std::vector<Vector3> expected;
  for (const int depth : {0, 1, 3, 7}) {
    Scene scene;
    scene.system.SetTree(Vector2(0.3), Vector2(10.0), depth, 2);
    Random random(8);
    for (std::uint32_t i = 0; i < 60; ++i)
      scene.add(100 - i, random_point<3>(random, -9, 9), random_point<3>(random, -5, 5), 1.2);
    const Vector3 momentum = scene.momentum();
    const double energy = scene.energy();
    std::size_t touched = 0, candidates = 0;
    for (int step = 0; step < 60; ++step) {
      scene.system.Update(0.02);
      touched += scene.system.GetAllCollisions().size();
      candidates += scene.system.GetBroadphaseCollisions().size();
    }
    EXPECT_GT(touched, 100u);
    EXPECT_NEAR(glm::length(scene.momentum() - momentum), 0, 1e-10);
    EXPECT_NEAR(scene.energy(), energy, 1e-10 * energy);
    std::vector<Vector3> places;
    for (const auto& ghost : scene.ghosts)
      places.push_back(ghost->GetTransform().GetWorldPosition());
    if (depth == 0) {
      expected = places;
      EXPECT_EQ(candidates, 60u * 60u * 59u / 2) << "a root that is never split is brute force";
    } else {
      EXPECT_LT(candidates, 60u * 60u * 59u / 2);
    }
    EXPECT_EQ(places, expected) << "depth " << depth;
  }
}

TEST(LecturePhysics, GravityIsAddedBeforeTheMove) {
  Scene scene;
  Ghost& a = scene.add(0, {0, 0, 0}, {1, 0, 0});
  Ghost& wall = scene.add(1, {50, 0, 0}, {0, 0, 0}, 1, 0);
  scene.system.SetGravity({0, -10, 0});
  for (int i = 0; i < 3; ++i) scene.system.Update(0.5);
  EXPECT_EQ(velocity_of(a), Vector3(1, -15, 0));
  EXPECT_EQ(a.GetTransform().GetWorldPosition(), Vector3(1.5, -15, 0));
  EXPECT_EQ(wall.GetTransform().GetWorldPosition(), Vector3(50, 0, 0));
}

}  // namespace
}  // namespace lantern::lecture
