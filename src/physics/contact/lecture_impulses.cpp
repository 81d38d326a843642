// The lecture's own method: a single pass over the candidate pairs, in order of ids. A pair that
// really touches is moved apart at once and given one impulse (NarrowPhase and
// ImpulseResolveCollision of src/lecture); then all bodies move. No islands, no sub-steps, no
// iteration, no warm start, no friction; a collision is noticed once the bodies overlap.
//
// The price is plain to see: each impulse undoes part of the one before, so stacks jitter and sink;
// and a fast body passes through a thin one.
#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "base/scratch.hpp"
#include "lecture/physics_system.hpp"
#include "physics/contact/contact_solver.hpp"

namespace lantern::physics {
namespace {

using lecture::CollisionDetection;
using lecture::GameObject;

// The lecture's world has three dimensions; a two-dimensional one is its plane z = 0.
Vec<3> in_space(const Vec<2>& v) { return {v.x, v.y, 0}; }
Vec<3> in_space(const Vec<3>& v) { return v; }
Vec<3> as_axis(double spin) { return {0, 0, spin}; }
Vec<3> as_axis(const Vec<3>& spin) { return spin; }
Mat<3> as_tensor(double about_z) {
  Mat<3> tensor(0.0);
  tensor[2][2] = about_z;
  return tensor;
}
Mat<3> as_tensor(const Mat<3>& tensor) { return tensor; }
double as_spin(const Vec<3>& axis, double /*plane*/) { return axis.z; }
Vec<3> as_spin(const Vec<3>& axis, const Vec<3>& /*space*/) { return axis; }

// The lecture's objects store angular velocity, the world's bodies angular momentum.
template <int D>
void turn(Body<D>& body, const Vec<3>& angular_impulse) {
  if (body.is_pushed() && body.inverse_inertia != Spin<D>(0.0))
    body.angular_momentum += as_spin(angular_impulse, body.angular_momentum);
}

template <int D>
GameObject object_of(const Body<D>& body, std::uint32_t place) {
  GameObject object(place);
  object.GetTransform().SetWorldPosition(in_space(body.position));
  lecture::PhysicsObject& physics = object.GetPhysicsObject();
  physics.SetElasticity(body.material.restitution);
  if (!body.moves() || body.asleep) return object;
  physics.SetLinearVelocity(in_space(body.velocity));
  physics.SetAngularVelocity(as_axis(angular_velocity(body)));
  if (!body.is_pushed()) return object;
  physics.SetInverseMass(body.inverse_mass);
  physics.SetInertiaTensor(as_tensor(world_inverse_inertia(body)));
  return object;
}

// The lecture has one contact point per pair: here the mean of the manifold's, at the depth of the
// deepest.
template <int D>
ManifoldPoint<D> single_point(const Manifold<D>& manifold) {
  ManifoldPoint<D> single;
  for (const ManifoldPoint<D>& point : manifold.points()) {
    single.position += point.position / static_cast<double>(manifold.count);
    single.separation = std::min(single.separation, point.separation);
  }
  return single;
}

template <int D>
class LecturePass {
 public:
  LecturePass(Island<D>& island, WorldWork& work) : island_(island), work_(work) {
    for (std::uint32_t i = 0; i < island.bodies.size(); ++i)
      objects_.push_back(object_of(island.bodies[i], i));
  }

  // The pairs come from the world's broad phase, in place of the lecture's own.
  void run() {
    lecture::GameWorld world;
    lecture::PhysicsSystem system(
        world, [&](GameObject* a, GameObject* b, CollisionDetection::CollisionInfo& info) {
          return intersect(*a, *b, info);
        });
    for (const IslandPair<D>& pair : island_.pairs)
      system.AddBroadphaseCollision(&objects_[pair.rows.a], &objects_[pair.rows.b]);
    system.NarrowPhase();
    for (const CollisionDetection::CollisionInfo& info : system.GetAllCollisions()) {
      pair_of(*info.a, *info.b).record.normal_impulses[0] = info.impulse;
      const Vec<3> impulse = info.point.normal * info.impulse;
      turn(body_of(*info.a), cross(info.point.localA, -impulse));
      turn(body_of(*info.b), cross(info.point.localB, impulse));
    }
    for (GameObject& object : objects_) {
      Body<D>& body = body_of(object);
      body.position = Vec<D>(object.GetTransform().GetWorldPosition());
      body.velocity = Vec<D>(object.GetPhysicsObject().GetLinearVelocity());
    }
  }

 private:
  Body<D>& body_of(const GameObject& object) { return island_.bodies[object.GetWorldID()]; }

  IslandPair<D>& pair_of(const GameObject& a, const GameObject& b) {
    return *std::ranges::lower_bound(
        island_.pairs, std::pair(a.GetWorldID(), b.GetWorldID()), {},
        [](const IslandPair<D>& pair) { return std::pair(pair.rows.a, pair.rows.b); });
  }

  // Where it is by now: earlier pairs may have moved it.
  Placed<D> placed(const GameObject& object) {
    const Body<D>& body = body_of(object);
    return {body.shape, Vec<D>(object.GetConstTransform().GetWorldPosition()), body.orientation};
  }

  bool intersect(const GameObject& a, const GameObject& b,
                 CollisionDetection::CollisionInfo& info) {
    ++work_.narrow_tests;
    const auto manifold = collide(placed(a), placed(b), 0);
    if (!manifold) return false;
    ++work_.contact_points;
    ++work_.normal_rows;
    const ManifoldPoint<D> point = single_point(*manifold);
    IslandPair<D>& pair = pair_of(a, b);
    pair.touched = true;
    pair.record.manifold = {.normal = manifold->normal, .room = {}};
    pair.record.manifold.add(point);
    const Vec<3> at = in_space(point.position);
    info.point.localA = at - a.GetConstTransform().GetWorldPosition();
    info.point.localB = at - b.GetConstTransform().GetWorldPosition();
    info.point.normal = in_space(manifold->normal);
    info.point.penetration = -point.separation;
    return true;
  }

  Island<D>& island_;
  WorldWork& work_;
  Scratch<GameObject> objects_;  // one a body, its id the body's place in the island
};

}  // namespace

template <int D>
void lecture_impulses(const IslandMove<D>& move) {
  Island<D>& island = move.island;
  if (!island.joints.empty())
    throw Refused("contacts = \"lecture\": the lecture has no joints; choose another method");
  find_increments_if_any<D>(move.config, island.bodies, island.forces, move.h, island.increments,
                            move.work);
  for (std::size_t i = 0; i < island.bodies.size(); ++i) {  // the lecture's IntegrateAccel
    island.bodies[i].velocity += island.increments[i].kick;
    island.bodies[i].angular_momentum += island.increments[i].twist;
    island.increments[i].kick = Vec<D>(0.0);
    island.increments[i].twist = Spin<D>(0.0);
  }
  LecturePass<D>(island, move.work).run();
  for (std::size_t i = 0; i < island.bodies.size(); ++i)  // its IntegrateVelocity
    if (island.bodies[i].is_pushed())
      fly(island.bodies[i], island.increments[i], move.h, move.config.rotation, move.work);
}

extern const ContactSolver kLectureImpulses = {
    .name = "lecture",
    .solve = {lecture_impulses<2>, lecture_impulses<3>},
    .whole_world = true,
    .frames_remembered = lecture::PhysicsSystem::numCollisionFrames};

}  // namespace lantern::physics
