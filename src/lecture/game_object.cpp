#include "lecture/game_object.hpp"

#include <glm/common.hpp>

namespace lantern::lecture {

// The text's names of them.
using AABBVolume = AxisBox<3>;
using SphereVolume = Sphere;
using OBBVolume = OrientedBox<3>;

bool GameObject::GetBroadphaseAABB(Vector3& outSize) const {
  if (!boundingVolume) return false;
  outSize = broadphaseAABB;
  return true;
}

void GameObject::UpdateBroadphaseAABB() {
  if (!boundingVolume) return;
  const auto* volume = &*boundingVolume;
  if (auto* aabb = std::get_if<AABBVolume>(volume)) {
    broadphaseAABB = aabb->half_size;
  } else if (auto* sphere = std::get_if<SphereVolume>(volume)) {
    const double r = sphere->radius;
    broadphaseAABB = Vector3(r, r, r);
  } else if (auto* obb = std::get_if<OBBVolume>(volume)) {
    Matrix3 mat = glm::mat3_cast(transform.GetWorldOrientation());
    for (int i = 0; i < 3; ++i) mat[i] = glm::abs(mat[i]);
    broadphaseAABB = mat * obb->half_size;
  } else {
    // Mended: the text stops here, and for any other volume the half sizes are never set. This is
    // the smallest box around the object's position that contains the volume.
    const Vector3& position = transform.GetWorldPosition();
    const Box<3> around =
        bounding_box<3>(*boundingVolume, position, {transform.GetWorldOrientation()});
    broadphaseAABB = glm::max(position - around.lo, around.hi - position);
  }
}

bool CollisionDetection::CollisionInfo::operator<(const CollisionInfo& other) const {
  const std::pair otherIds(other.a->GetWorldID(), other.b->GetWorldID());
  const std::pair theseIds(a->GetWorldID(), b->GetWorldID());
  return theseIds < otherIds;
}

}  // namespace lantern::lecture
