#include "lecture/physics_system.hpp"

#include <algorithm>
#include <iterator>
#include <list>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/stop.hpp"
#include "lecture/quad_tree.hpp"

namespace lantern::lecture {

// Ours: the text only says that UpdateObjectAABBs is called every frame. The order is that of
// semi-implicit Euler: objects move with the velocities that the collisions have left them.
void PhysicsSystem::Update(double dt) {
  IntegrateAccel(dt);
  UpdateObjectAABBs();
  BroadPhase();
  NarrowPhase();
  IntegrateVelocity(dt);
  UpdateCollisionList();
}

void PhysicsSystem::UpdateObjectAABBs() {
  GameWorld::Iterator first, last;
  gameWorld.GetObjectIterators(first, last);
  for (auto i = first; i != last; ++i) (*i)->UpdateBroadphaseAABB();
}

void PhysicsSystem::BroadPhase() {
  broadphaseCollisions.clear();
  QuadTree<GameObject*> quadTree(tree.size, tree.maxDepth, tree.maxSize, tree.position);

  GameWorld::Iterator first, last;
  gameWorld.GetObjectIterators(first, last);
  for (auto i = first; i != last; ++i) {
    Vector3 halfSizes;
    if (!(*i)->GetBroadphaseAABB(halfSizes)) continue;
    const Vector3 pos = (*i)->GetConstTransform().GetWorldPosition();
    quadTree.Insert(*i, pos, halfSizes);
  }
  quadTree.OperateOnContents([&](std::list<QuadTreeEntry<GameObject*>>& data) {
    for (auto i = data.begin(); i != data.end(); ++i) {
      // is this pair of items already in the collision set - if the same pair is in another
      // quadtree node together etc
      for (auto j = std::next(i); j != data.end(); ++j)
        AddBroadphaseCollision(i->object, j->object);
    }
  });
}

void PhysicsSystem::AddBroadphaseCollision(GameObject* a, GameObject* b) {
  stop_if_asked();
  CollisionInfo info;
  // Mended: the text takes the lower and the higher address, see CollisionInfo.
  const auto byID = [](const GameObject* x, const GameObject* y) {
    return x->GetWorldID() < y->GetWorldID();
  };
  info.a = std::min(a, b, byID);
  info.b = std::max(a, b, byID);
  broadphaseCollisions.insert(info);
  // Mended: a leaf at the depth limit may hold any number of objects, and the text inserts all
  // n(n-1)/2 of their pairs until memory runs out.
  if (broadphaseCollisions.size() > mostPairs)
    throw Refused(fmt::format("broad phase: more than {} pairs; take fewer objects, or part them",
                              mostPairs));
}

// The text's prose walks `allCollisions` here; its code, like this, walks `broadphaseCollisions`.
void PhysicsSystem::NarrowPhase() {
  for (auto i = broadphaseCollisions.begin(); i != broadphaseCollisions.end(); ++i) {
    stop_if_asked();
    CollisionInfo info = *i;
    if (ObjectIntersection(info.a, info.b, info)) {
      info.framesLeft = numCollisionFrames;
      info.impulse = ImpulseResolveCollision(*info.a, *info.b, info.point);
      const auto [known, isNew] = allCollisions.insert(info);  // insert into our main set
      // Mended: inserting into a std::set what it already holds changes nothing, so in the text the
      // frames of a known pair are never renewed, and two objects at rest on each other are
      // reported to part again and again.
      if (!isNew) {
        known->framesLeft = info.framesLeft;
        known->point = info.point;
        known->impulse = info.impulse;
      }
    }
  }
}

// Both are moved apart along the normal, the lighter one further. Then an impulse j along the
// normal reverses the speed v at which the contact points approach, scaled by the elasticity e:
//
//   j = -(1 + e) v / K,   K = 1/ma + 1/mb + n . ((Ia^-1 (ra x n)) x ra + (Ib^-1 (rb x n)) x rb)
//
// where r leads from the centre to the contact point. As in the series, there is no friction.
double PhysicsSystem::ImpulseResolveCollision(GameObject& a, GameObject& b, const ContactPoint& p) {
  PhysicsObject& physA = a.GetPhysicsObject();
  PhysicsObject& physB = b.GetPhysicsObject();
  const double totalMass = physA.GetInverseMass() + physB.GetInverseMass();
  if (totalMass == 0) return 0;  // two walls

  Transform& transformA = a.GetTransform();
  Transform& transformB = b.GetTransform();
  const Vector3 projection = p.normal * (p.penetration / totalMass);
  transformA.SetWorldPosition(transformA.GetWorldPosition() - projection * physA.GetInverseMass());
  transformB.SetWorldPosition(transformB.GetWorldPosition() + projection * physB.GetInverseMass());

  const Vector3 velocityA = physA.GetLinearVelocity() + cross(physA.GetAngularVelocity(), p.localA);
  const Vector3 velocityB = physB.GetLinearVelocity() + cross(physB.GetAngularVelocity(), p.localB);
  const double approach = glm::dot(velocityB - velocityA, p.normal);
  if (approach >= 0) return 0;  // already separating; an impulse would pull them back

  const Vector3 inertiaA = cross(physA.GetInertiaTensor() * cross(p.localA, p.normal), p.localA);
  const Vector3 inertiaB = cross(physB.GetInertiaTensor() * cross(p.localB, p.normal), p.localB);
  const double angularEffect = glm::dot(inertiaA + inertiaB, p.normal);

  const double elasticity = std::max(physA.GetElasticity(), physB.GetElasticity());
  const double j = -(1 + elasticity) * approach / (totalMass + angularEffect);
  const Vector3 fullImpulse = p.normal * j;

  physA.ApplyLinearImpulse(-fullImpulse);
  physB.ApplyLinearImpulse(fullImpulse);
  physA.ApplyAngularImpulse(cross(p.localA, -fullImpulse));
  physB.ApplyAngularImpulse(cross(p.localB, fullImpulse));
  return j;
}

// Ours: the text has `framesLeft` and `allCollisions`, and mentions the callbacks.
void PhysicsSystem::UpdateCollisionList() {
  for (auto i = allCollisions.begin(); i != allCollisions.end();) {
    if (!i->begun) {
      i->begun = true;
      i->a->OnCollisionBegin(i->b);
      i->b->OnCollisionBegin(i->a);
    }
    if (--i->framesLeft < 0) {
      i->a->OnCollisionEnd(i->b);
      i->b->OnCollisionEnd(i->a);
      i = allCollisions.erase(i);
    } else {
      ++i;
    }
  }
}

void PhysicsSystem::IntegrateAccel(double dt) {
  GameWorld::Iterator first, last;
  gameWorld.GetObjectIterators(first, last);
  for (auto i = first; i != last; ++i) {
    PhysicsObject& object = (*i)->GetPhysicsObject();
    if (object.GetInverseMass() > 0)
      object.SetLinearVelocity(object.GetLinearVelocity() + gravity * dt);
  }
}

void PhysicsSystem::IntegrateVelocity(double dt) {
  GameWorld::Iterator first, last;
  gameWorld.GetObjectIterators(first, last);
  for (auto i = first; i != last; ++i) {
    const PhysicsObject& object = (*i)->GetPhysicsObject();
    Transform& transform = (*i)->GetTransform();
    transform.SetWorldPosition(transform.GetWorldPosition() + object.GetLinearVelocity() * dt);
    const Rotation<3> before{transform.GetWorldOrientation()};
    transform.SetWorldOrientation(turned(before, object.GetAngularVelocity() * dt).q);
  }
}

}  // namespace lantern::lecture
