// The lecture's GameObject: what collides, its box for the broad phase, and its motion.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "geometry/rotation.hpp"
#include "geometry/shape.hpp"
#include "lecture/collision_detection.hpp"

namespace lantern::lecture {

using Matrix3 = Mat<3>;
using Quaternion = glm::dquat;

// Ours, from the tutorials before this one: where an object is.
class Transform {
 public:
  const Vector3& GetWorldPosition() const { return position; }
  const Quaternion& GetWorldOrientation() const { return orientation; }
  void SetWorldPosition(const Vector3& to) { position = to; }
  void SetWorldOrientation(const Quaternion& to) { orientation = to; }

 protected:
  Vector3 position{0.0};
  Quaternion orientation{1, 0, 0, 0};  // w, x, y, z
};

// Ours, from the tutorials before this one: how an object moves. Inverses are 0 for what cannot be
// moved or turned.
class PhysicsObject {
 public:
  const Vector3& GetLinearVelocity() const { return linearVelocity; }
  const Vector3& GetAngularVelocity() const { return angularVelocity; }
  double GetInverseMass() const { return inverseMass; }
  const Matrix3& GetInertiaTensor() const { return inverseInertia; }
  double GetElasticity() const { return elasticity; }

  void SetLinearVelocity(const Vector3& v) { linearVelocity = v; }
  void SetAngularVelocity(const Vector3& v) { angularVelocity = v; }
  void SetInverseMass(double m) { inverseMass = m; }
  void SetInertiaTensor(const Matrix3& i) { inverseInertia = i; }  // inverse, in the world's axes
  void SetElasticity(double e) { elasticity = e; }

  void ApplyLinearImpulse(const Vector3& impulse) { linearVelocity += impulse * inverseMass; }
  void ApplyAngularImpulse(const Vector3& impulse) { angularVelocity += inverseInertia * impulse; }

 protected:
  Vector3 linearVelocity{0.0};
  Vector3 angularVelocity{0.0};  // radians a second
  double inverseMass = 0;
  Matrix3 inverseInertia{0.0};
  double elasticity = 0;  // of a pair, the larger one counts
};

class GameObject {
 public:
  // Added: `id`, unique within a world, as the text itself recommends. Without a volume the object
  // never collides.
  explicit GameObject(std::uint32_t id, std::optional<Shape<3>> volume = std::nullopt)
      : worldID(id), boundingVolume(std::move(volume)) {}
  virtual ~GameObject() = default;

  bool GetBroadphaseAABB(Vector3& outSize) const;
  void UpdateBroadphaseAABB();

  std::uint32_t GetWorldID() const { return worldID; }
  const std::optional<Shape<3>>& GetBoundingVolume() const { return boundingVolume; }
  Transform& GetTransform() { return transform; }
  const Transform& GetConstTransform() const { return transform; }
  PhysicsObject& GetPhysicsObject() { return physicsObject; }

  // Ours: the text only says that the narrow phase will "update any of our function callbacks".
  virtual void OnCollisionBegin(GameObject* /*otherObject*/) {}
  virtual void OnCollisionEnd(GameObject* /*otherObject*/) {}

 protected:
  std::uint32_t worldID;
  std::optional<Shape<3>> boundingVolume;
  Transform transform;
  PhysicsObject physicsObject;
  Vector3 broadphaseAABB{0.0};
};

}  // namespace lantern::lecture
