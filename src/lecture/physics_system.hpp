// The lecture's PhysicsSystem: one update, phase after phase.
//
//   forces -> UpdateObjectAABBs -> BroadPhase -> NarrowPhase -> move -> UpdateCollisionList
#pragma once

#include <cstddef>
#include <functional>
#include <set>
#include <utility>
#include <vector>

#include "lecture/game_object.hpp"

namespace lantern::lecture {

// Ours: the text only asks it for its objects. They must outlive it.
class GameWorld {
 public:
  using Iterator = std::vector<GameObject*>::const_iterator;

  void AddGameObject(GameObject* object) { gameObjects.push_back(object); }
  void GetObjectIterators(Iterator& first, Iterator& last) const {
    first = gameObjects.begin();
    last = gameObjects.end();
  }

 protected:
  std::vector<GameObject*> gameObjects;
};

class PhysicsSystem {
 public:
  using CollisionInfo = CollisionDetection::CollisionInfo;
  using ContactPoint = CollisionDetection::ContactPoint;

  // Do the true volumes of info.a and info.b overlap? If so, fills in info.point.
  // Ours: the text calls CollisionDetection::ObjectIntersection, which an earlier tutorial made.
  // Here whoever makes the system hands in the one to use.
  using IntersectionFunc = std::function<bool(GameObject* a, GameObject* b, CollisionInfo& info)>;

  PhysicsSystem(GameWorld& world, IntersectionFunc objectIntersection)
      : gameWorld(world), ObjectIntersection(std::move(objectIntersection)) {}

  // One frame of `dt` seconds.
  void Update(double dt);

  void UpdateObjectAABBs();
  // Throws Refused when more than the largest allowed number of pairs share a leaf.
  void BroadPhase();
  void NarrowPhase();
  void UpdateCollisionList();

  // Parts two objects that overlap, and turns their approach into a bounce. Ours: the text calls
  // it and does not show it. Returns the impulse upon b along the normal, in N s; a got as much the
  // other way.
  static double ImpulseResolveCollision(GameObject& a, GameObject& b, const ContactPoint& p);

  // Added: a broad phase from outside may note its pairs, too. The same pair twice is noted once.
  void AddBroadphaseCollision(GameObject* a, GameObject* b);
  const std::set<CollisionInfo>& GetBroadphaseCollisions() const { return broadphaseCollisions; }
  const std::set<CollisionInfo>& GetAllCollisions() const { return allCollisions; }

  void SetGravity(const Vector3& g) { gravity = g; }
  void SetTree(const Vector2& position, const Vector2& size, int maxDepth, int maxSize) {
    tree = {position, size, maxDepth, maxSize};
  }
  void SetMostPairs(std::size_t most) { mostPairs = most; }

  static constexpr int numCollisionFrames = 5;  // that a collision is remembered after its last

 protected:
  struct TreeSettings {
    Vector2 position{0.0};
    Vector2 size{1024.0};
    int maxDepth = 7;
    int maxSize = 6;
  };

  void IntegrateAccel(double dt);
  void IntegrateVelocity(double dt);

  GameWorld& gameWorld;
  IntersectionFunc ObjectIntersection;
  Vector3 gravity{0.0};
  TreeSettings tree;  // the text's numbers
  std::size_t mostPairs = std::size_t{1} << 26;
  std::set<CollisionInfo> broadphaseCollisions;
  std::set<CollisionInfo> allCollisions;
};

}  // namespace lantern::lecture
