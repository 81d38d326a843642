#include "lecture/game_object.hpp"

#include <glm/common.hpp>

namespace lantern::lecture {

bool GameObject::GetBroadphaseAABB(Vector3& outSize) const {
  if (!boundingVolume) return false;
  outSize = broadphaseAABB;
  return true;
}

void GameObject::UpdateBroadphaseAABB() {
  if (!boundingVolume) return;
  if (const auto* box = std::get_if<AxisBox<3>>(&*boundingVolume)) {
    broadphaseAABB = box->half_size;
  } else if (const auto* ball = std::get_if<Sphere>(&*boundingVolume)) {
    const double r = ball->radius;
    broadphaseAABB = Vector3(r, r, r);
  } else if (const auto* turned_box = std::get_if<OrientedBox<3>>(&*boundingVolume)) {
    Matrix3 mat = glm::mat3_cast(transform.GetWorldOrientation());
    for (int i = 0; i < 3; ++i) mat[i] = glm::abs(mat[i]);
    broadphaseAABB = mat * turned_box->half_size;
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
  if (a->GetWorldID() != other.a->GetWorldID()) return a->GetWorldID() < other.a->GetWorldID();
  return b->GetWorldID() < other.b->GetWorldID();
}

}  // namespace lantern::lecture
