// The lecture's PhysicsSystem: one update, phase after phase.
//
//   forces -> UpdateObjectAABBs -> BroadPhase -> NarrowPhase -> move -> UpdateCollisionList
//
// It is complete in itself. With contacts = "lecture" the engine's world uses its NarrowPhase
// (physics/lecture_impulses.cpp), and moves exactly as this does.
#pragma once

#include <cstddef>
#include <functional>
#include <set>
#include <utility>
#include <vector>

#include "lecture/game_object.hpp"

namespace lantern::lecture {

// Ours: the text only asks it for its objects, which must outlive it.
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
  // Ours: the text calls CollisionDetection::ObjectIntersection, from an earlier tutorial. Here it
  // is supplied by whoever creates the system.
  using IntersectionFunc = std::function<bool(GameObject* a, GameObject* b, CollisionInfo& info)>;

  PhysicsSystem(GameWorld& world, IntersectionFunc objectIntersection)
      : gameWorld(world), ObjectIntersection(std::move(objectIntersection)) {}

  // One frame of `dt` seconds.
  void Update(double dt);

  void UpdateObjectAABBs();
  // Throws Refused for more pairs than SetMostPairs allows.
  void BroadPhase();
  void NarrowPhase();
  void UpdateCollisionList();

  // Separates two overlapping objects and makes them bounce. Ours: the text calls it but does not
  // show it. Returns the impulse on b along the normal, in N s; a receives its opposite.
  static double ImpulseResolveCollision(GameObject& a, GameObject& b, const ContactPoint& p);

  // Added: so that another broad phase can supply its pairs. A pair given twice counts once.
  void AddBroadphaseCollision(GameObject* a, GameObject* b);
  const std::set<CollisionInfo>& GetBroadphaseCollisions() const { return broadphaseCollisions; }
  const std::set<CollisionInfo>& GetAllCollisions() const { return allCollisions; }

  void SetGravity(const Vector3& g) { gravity = g; }
  void SetTree(const Vector2& position, const Vector2& size, int maxDepth, int maxSize) {
    tree = {position, size, maxDepth, maxSize};
  }
  void SetMostPairs(std::size_t most) { mostPairs = most; }

  static constexpr int numCollisionFrames = 5;  // from the last touch to OnCollisionEnd

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
