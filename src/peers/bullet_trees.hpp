// Bullet's multibodies: what is jointed keeps its joints by coordinates (Featherstone).
#pragma once

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <BulletDynamics/Featherstone/btMultiBodyPoint2Point.h>
#include <btBulletDynamicsCommon.h>

#include "peers/joint_tree.hpp"
#include "peers/peer_run.hpp"

namespace lantern::peers {

inline btVector3 to_bullet(const Vec<3>& v) { return {v.x, v.y, v.z}; }
inline Vec<3> from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
inline btQuaternion to_bullet(const glm::dquat& q) { return {q.x, q.y, q.z, q.w}; }

using BulletShapes = std::vector<std::unique_ptr<btCollisionShape>>;  // one a body

// All trees of a scene. World and shapes must outlive them.
class BulletTrees {
 public:
  // Why the joints make no trees; nothing if they do.
  static std::optional<std::string> cannot(const PeerScene& scene) {
    const JointTree tree(scene);
    std::vector<bool> in_tree(scene.bodies.size());
    for (const Hanging& one : tree.all())
      if (one.link) {
        in_tree[one.body] = true;
        if (one.parent) in_tree[*one.parent] = true;
      }
    const auto is_loose = [&](std::size_t i) {
      return scene.bodies[i].is_dynamic() && !in_tree[i];
    };
    for (std::size_t i = 0; i < scene.links.size(); ++i) {
      const PeerLink& link = scene.links[i];
      if (link.kind == LinkSpec::Kind::spring || tree.hangs_by(i)) continue;
      if (link.kind == LinkSpec::Kind::distance)
        return "Bullet's multibodies have no rod in space, or one that closes a loop";
      if (is_loose(link.a) || (link.b && is_loose(*link.b)))
        return "Bullet's multibodies do not joint what is braked or may not turn";
    }
    return std::nullopt;
  }

  BulletTrees(const PeerScene& scene, btMultiBodyDynamicsWorld& world, const BulletShapes& shapes,
              bool runge_kutta)
      : scene_(scene), world_(world), shapes_(shapes), places_(scene.bodies.size()) {
    const JointTree joints(scene);
    std::map<std::size_t, std::vector<Hanging>> trees;  // by the first body of each
    std::vector<std::size_t> first(scene.bodies.size());
    for (const Hanging& one : joints.all()) {
      const std::size_t i = one.body;
      const bool goes_on = one.parent && scene.bodies[*one.parent].is_dynamic();
      first[i] = goes_on ? first[*one.parent] : i;
      if (scene.bodies[i].is_dynamic()) trees[first[i]].push_back(one);
    }
    for (const auto& [root, tree] : trees)
      if (tree.size() > 1 || tree[0].link) add(tree, runge_kutta);
    for (std::size_t i = 0; i < scene.links.size(); ++i)
      if (scene.links[i].kind == LinkSpec::Kind::pin && !joints.hangs_by(i)) close(scene.links[i]);
  }

  ~BulletTrees() {
    for (auto& loop : loops_) world_.removeMultiBodyConstraint(loop.get());
    for (auto& collider : colliders_) world_.removeCollisionObject(collider.get());
    for (auto& tree : trees_) world_.removeMultiBody(tree.get());
  }
  BulletTrees(const BulletTrees&) = delete;
  BulletTrees& operator=(const BulletTrees&) = delete;

  bool has(std::size_t body) const { return places_[body].tree != nullptr; }
  void has_moved() { is_placed_ = false; }

  // Not finite if anything is not.
  double sum() const {
    double sum = 0;
    for (const auto& tree : trees_) {
      sum += tree->getBasePos().length2() + tree->getBaseVel().length2();
      for (int k = 0; k < tree->getNumLinks(); ++k)
        for (int d = 0; d < tree->getLink(k).m_dofCount; ++d)
          sum +=
              std::abs(tree->getJointPosMultiDof(k)[d]) + std::abs(tree->getJointVelMultiDof(k)[d]);
    }
    return sum;
  }

  PeerMotion motion(std::size_t body) const {
    place_links();
    const Place& place = places_[body];
    const btTransform& at = place.link < 0 ? place.tree->getBaseWorldTransform()
                                           : place.tree->getLink(place.link).m_cachedWorldTransform;
    const btQuaternion q = at.getRotation();
    const Speeds& speeds = speeds_.at(place.tree);
    const int k = place.link + 1;
    return {from_bullet(at.getOrigin()),
            from_bullet(at.getBasis() * speeds.velocity[k]),
            {glm::dquat(q.w(), q.x(), q.y(), q.z())},
            from_bullet(at.getBasis() * speeds.turning[k])};
  }

  void push(std::size_t body, const Vec<3>& force, const Vec<3>& torque) {
    const Place& place = places_[body];
    if (place.link < 0) {
      place.tree->addBaseForce(to_bullet(force));
      place.tree->addBaseTorque(to_bullet(torque));
      return;
    }
    place.tree->addLinkForce(place.link, to_bullet(force));
    place.tree->addLinkTorque(place.link, to_bullet(torque));
  }

 private:
  struct Place {
    btMultiBody* tree = nullptr;
    int link = -1;  // -1: the base
  };
  struct Speeds {  // of base and links, each in its own axes
    btAlignedObjectArray<btVector3> turning, velocity;
  };

  void add(const std::vector<Hanging>& tree, bool runge_kutta) {
    const bool is_held = tree[0].link.has_value();
    int links = 0;
    for (const Hanging& one : tree) links += one.link ? one.is_rod ? 2 : 1 : 0;
    const PeerBody& root = scene_.bodies[tree[0].body];
    trees_.push_back(std::make_unique<btMultiBody>(links, is_held ? 0 : root.mass,
                                                   to_bullet(is_held ? Vec<3>(0.0) : root.inertia),
                                                   is_held, false));
    btMultiBody& made = *trees_.back();
    const auto none = std::numeric_limits<double>::max();
    made.setLinearDamping(0);
    made.setAngularDamping(0);
    made.setMaxCoordinateVelocity(none);
    made.setMaxAppliedImpulse(none);
    made.useRK4Integration(runge_kutta);
    if (!is_held)
      made.setBaseWorldTransform(
          btTransform(to_bullet(root.orientation.q), to_bullet(root.position)));
    int next = 0;
    for (const Hanging& one : tree) {
      if (one.link) next = hang(made, one, next);
      places_[one.body] = {&made, one.link ? next - 1 : -1};
    }
    made.finalizeMultiDof();
    if (!is_held) {
      made.setBaseVel(to_bullet(root.velocity));
      made.setBaseOmega(to_bullet(root.turning));
    }
    for (const Hanging& one : tree)
      if (one.link) set_speed(made, one);
    world_.addMultiBody(&made);
    place(made);
    for (const Hanging& one : tree) add_collider(made, one.body);
    made.setHasSelfCollision(true);
  }

  // Gives the number of the next link. A rod is a link of its own without mass.
  int hang(btMultiBody& tree, const Hanging& one, int next) const {
    const PeerBody& body = scene_.bodies[one.body];
    const bool on_world = !one.parent || !scene_.bodies[*one.parent].is_dynamic();
    int parent = on_world ? -1 : places_[*one.parent].link;
    glm::dquat parents =
        on_world ? glm::dquat(1, 0, 0, 0) : scene_.bodies[*one.parent].orientation.q;
    const Vec<3> from = on_world ? Vec<3>(0.0) : scene_.bodies[*one.parent].position;
    Vec<3> pivot = glm::conjugate(parents) * (one.anchor - from);
    const btVector3 z(0, 0, 1);
    if (one.is_rod) {
      tree.setupRevolute(next, 0, {0, 0, 0}, parent, to_bullet(parents), z, to_bullet(pivot),
                         {0, 0, 0}, true);
      parent = next++;
      parents = glm::dquat(1, 0, 0, 0);
      pivot = one.end - one.anchor;
    }
    const btQuaternion turned_by = to_bullet(glm::conjugate(body.orientation.q) * parents);
    if (scene_.is_flat())
      tree.setupRevolute(next, body.mass, to_bullet(body.inertia), parent, turned_by, z,
                         to_bullet(pivot), to_bullet(-one.at), true);
    else
      tree.setupSpherical(next, body.mass, to_bullet(body.inertia), parent, turned_by,
                          to_bullet(pivot), to_bullet(-one.at), true);
    return next + 1;
  }

  void set_speed(btMultiBody& tree, const Hanging& one) const {
    const HangingSpin spin = spin_of(scene_, one);
    const int link = places_[one.body].link;
    if (scene_.is_flat()) {
      if (one.is_rod) tree.setJointVel(link - 1, spin.of_rod.z);
      tree.setJointVel(link, spin.of_body.z);
      return;
    }
    const Vec<3> own = glm::conjugate(scene_.bodies[one.body].orientation.q) * spin.of_body;
    const double speeds[] = {own.x, own.y, own.z};
    tree.setJointVelMultiDof(link, speeds);
  }

  void add_collider(btMultiBody& tree, std::size_t body) {
    const int link = places_[body].link;
    colliders_.push_back(std::make_unique<btMultiBodyLinkCollider>(&tree, link));
    btMultiBodyLinkCollider& collider = *colliders_.back();
    collider.setCollisionShape(shapes_[body].get());
    collider.setWorldTransform(link < 0 ? tree.getBaseWorldTransform()
                                        : tree.getLink(link).m_cachedWorldTransform);
    collider.setFriction(scene_.bodies[body].material.friction);
    collider.setRestitution(scene_.bodies[body].material.restitution);
    // Where nothing collides, islands still go by it.
    const int all = scene_.collides() ? -1 : 0;
    world_.addCollisionObject(&collider, all, all);
    if (link < 0)
      tree.setBaseCollider(&collider);
    else
      tree.getLink(link).m_collider = &collider;
  }

  // A pin that closes a loop.
  void close(const PeerLink& link) {
    Place a = places_[link.a], b = link.b ? places_[*link.b] : Place{};
    Vec<3> at_a = link.at_a, at_b = link.at_b, to = link.to;
    if (!a.tree) {
      std::swap(a, b);
      std::swap(at_a, at_b);
      to = link.from;
    }
    if (!a.tree) return;  // between two that never move
    loops_.push_back(b.tree ? std::make_unique<btMultiBodyPoint2Point>(
                                  a.tree, a.link, b.tree, b.link, to_bullet(at_a), to_bullet(at_b))
                            : std::make_unique<btMultiBodyPoint2Point>(
                                  a.tree, a.link, nullptr, to_bullet(at_a), to_bullet(to)));
    loops_.back()->setMaxAppliedImpulse(std::numeric_limits<double>::max());
    world_.addMultiBodyConstraint(loops_.back().get());
  }

  void place(btMultiBody& tree) const {
    btAlignedObjectArray<btQuaternion> turns;
    btAlignedObjectArray<btVector3> origins;
    tree.forwardKinematics(turns, origins);
    Speeds& speeds = speeds_[&tree];
    speeds.turning.resize(tree.getNumLinks() + 1);
    speeds.velocity.resize(tree.getNumLinks() + 1);
    tree.compTreeLinkVelocities(&speeds.turning[0], &speeds.velocity[0]);
  }

  void place_links() const {
    if (is_placed_) return;
    for (const auto& tree : trees_) place(*tree);
    is_placed_ = true;
  }

  const PeerScene& scene_;
  btMultiBodyDynamicsWorld& world_;
  const BulletShapes& shapes_;
  std::vector<Place> places_;
  std::vector<std::unique_ptr<btMultiBody>> trees_;
  std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders_;
  std::vector<std::unique_ptr<btMultiBodyPoint2Point>> loops_;
  mutable std::map<const btMultiBody*, Speeds> speeds_;
  mutable bool is_placed_ = false;
};

}  // namespace lantern::peers
