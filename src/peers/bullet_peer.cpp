// Bullet: impulses by projected Gauss-Seidel, semi-implicit Euler.
#include <cmath>

#include <btBulletDynamicsCommon.h>

#include "peers/peer_run.hpp"

namespace lantern::peers {
namespace {

btVector3 to_bullet(const Vec<3>& v) { return {v.x, v.y, v.z}; }
Vec<3> from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

// As Lantern combines them; Bullet's own way is the product.
btScalar larger_restitution(const btCollisionObject* a, const btCollisionObject* b) {
  return std::max(a->getRestitution(), b->getRestitution());
}
btScalar mean_friction(const btCollisionObject* a, const btCollisionObject* b) {
  return std::sqrt(a->getFriction() * b->getFriction());
}

std::unique_ptr<btCollisionShape> shape_of(const PeerBody& body, bool is_flat) {
  using Made = std::unique_ptr<btCollisionShape>;
  return visit_peer_shape(
      body.shape, [](const Sphere& s) -> Made { return std::make_unique<btSphereShape>(s.radius); },
      [&](const Vec<3>& half) -> Made {
        return std::make_unique<btBoxShape>(to_bullet(with_depth(half, is_flat)));
      },
      [](const Capsule& c) -> Made {
        return std::make_unique<btCapsuleShape>(c.radius, 2 * c.half_length);
      },
      [](const HalfSpace<3>& space) -> Made {
        return std::make_unique<btStaticPlaneShape>(to_bullet(space.normal), 0.0);
      });
}

// Bullet keeps (1 - damping)^h of a velocity: exact for a drag that is the same about all axes.
double damping_of(double drag, double inertia) {
  return drag > 0 ? -std::expm1(-drag / inertia) : 0;
}

class BulletRun : public PeerRun {
 public:
  BulletRun(const PeerScene& scene, double h, int iterations)
      : PeerRun(scene, h),
        dispatcher_(&configuration_),
        world_(&dispatcher_, &broad_phase_, &solver_, &configuration_) {
    gCalculateCombinedRestitutionCallback = larger_restitution;
    gCalculateCombinedFrictionCallback = mean_friction;
    world_.setGravity(to_bullet(scene.gravity));
    world_.getSolverInfo().m_numIterations = iterations;
    world_.getSolverInfo().m_restitutionVelocityThreshold = 0;  // slow bounces bounce, too
    for (const PeerBody& body : scene.bodies) add(body);
    for (const PeerLink& link : scene.links) add(link);
  }

  ~BulletRun() override {
    for (auto& pin : pins_) world_.removeConstraint(pin.get());
    for (auto& body : bodies_) world_.removeRigidBody(body.get());
  }

 protected:
  void step() override { world_.stepSimulation(h_, 0, h_); }

  bool is_finite() const override {
    double sum = 0;
    for (const auto& body : bodies_)
      sum += body->getWorldTransform().getOrigin().length2() + body->getLinearVelocity().length2() +
             body->getAngularVelocity().length2();
    return std::isfinite(sum);
  }

  PeerMotion motion(std::size_t i) const override {
    const btRigidBody& body = *bodies_[i];
    const btQuaternion q = body.getWorldTransform().getRotation();
    return {from_bullet(body.getWorldTransform().getOrigin()),
            from_bullet(body.getLinearVelocity()),
            {glm::dquat(q.w(), q.x(), q.y(), q.z())},
            from_bullet(body.getAngularVelocity())};
  }

  std::pair<Vec<3>, Vec<3>> centre(std::size_t i) const override {
    return {from_bullet(bodies_[i]->getWorldTransform().getOrigin()),
            from_bullet(bodies_[i]->getLinearVelocity())};
  }

  void push(std::size_t i, const Vec<3>& force, const Vec<3>& arm) override {
    bodies_[i]->applyForce(to_bullet(force), to_bullet(arm));
  }

  void set_velocity(std::size_t i, const Vec<3>& velocity) override {
    bodies_[i]->setLinearVelocity(to_bullet(velocity));
  }

 private:
  void add(const PeerBody& spec) {
    shapes_.push_back(shape_of(spec, scene_.is_flat()));
    const btVector3 inertia = to_bullet(spec.may_turn ? spec.inertia : Vec<3>(0.0));
    btRigidBody::btRigidBodyConstructionInfo info(spec.mass, nullptr, shapes_.back().get(),
                                                  inertia);
    const glm::dquat& q = spec.orientation.q;
    info.m_startWorldTransform =
        btTransform(btQuaternion(q.x, q.y, q.z, q.w), to_bullet(spec.position));
    info.m_friction = spec.material.friction;
    info.m_restitution = spec.material.restitution;
    info.m_linearDamping = damping_of(spec.linear_drag, spec.mass);
    info.m_angularDamping = damping_of(spec.angular_drag, spec.inertia.x);
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    btRigidBody& body = *bodies_.back();
    body.setActivationState(DISABLE_DEACTIVATION);
    const int all = scene_.collides() ? -1 : 0;
    world_.addRigidBody(&body, all, all);
    if (!spec.is_dynamic()) return;
    body.setLinearVelocity(to_bullet(spec.velocity));
    body.setAngularVelocity(to_bullet(spec.turning));
    if (scene_.is_flat()) {
      body.setLinearFactor({1, 1, 0});
      body.setAngularFactor({0, 0, 1});
    }
    if (!spec.may_turn) body.setAngularFactor(btVector3(0, 0, 0));
  }

  void add(const PeerLink& link) {
    if (link.kind == LinkSpec::Kind::spring) return pull_by_force(link);
    btRigidBody& a = *bodies_[link.a];
    if (link.b)
      pins_.push_back(std::make_unique<btPoint2PointConstraint>(
          a, *bodies_[*link.b], to_bullet(link.at_a), to_bullet(link.at_b)));
    else
      pins_.push_back(std::make_unique<btPoint2PointConstraint>(a, to_bullet(link.at_a)));
    world_.addConstraint(pins_.back().get(), true);
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broad_phase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::vector<std::unique_ptr<btTypedConstraint>> pins_;
};

std::optional<std::string> cannot(const PeerScene& scene) {
  for (const PeerBody& body : scene.bodies)
    if (body.kind == BodyKind::kinematic_body)
      return "body '" + body.name + "': Bullet has no bodies that keep their velocity";
  for (const PeerLink& link : scene.links)
    if (link.kind == LinkSpec::Kind::distance) return "Bullet has no rod between two points";
  return solid_engine_cannot(scene);
}

}  // namespace
}  // namespace lantern::peers

extern "C" void lantern_peers(std::vector<lantern::measure::Peer>& peers) {
  using namespace lantern::peers;
  for (const int iterations : {10, 50})  // 10 is what Bullet takes if it is not told
    peers.push_back({"Bullet:" + std::to_string(iterations), LANTERN_PEER_VERSION, cannot,
                     [=](const PeerScene& scene, double h) {
                       return std::make_unique<BulletRun>(scene, h, iterations);
                     }});
}
