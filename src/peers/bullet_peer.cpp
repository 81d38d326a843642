// Bullet: semi-implicit Euler; impulses by projected Gauss-Seidel, by its non-smooth conjugate
// gradients or directly. Its multibodies keep joints by coordinates (bullet_trees.hpp).
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <BulletDynamics/ConstraintSolver/btNNCGConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>
#include <BulletDynamics/MLCPSolvers/btMLCPSolver.h>
#include <btBulletDynamicsCommon.h>

#include "peers/bullet_trees.hpp"
#include "peers/peer_run.hpp"

namespace lantern::peers {
namespace {

enum class Way { impulses, conjugate_gradients, direct, multibody, multibody_runge_kutta };
bool has_trees(Way way) { return way == Way::multibody || way == Way::multibody_runge_kutta; }

struct Variant {
  const char* name;
  Way way;
  int iterations;
};
constexpr int kDefaultIterations = 10;
constexpr Variant kVariants[] = {{"Bullet:10", Way::impulses, kDefaultIterations},
                                 {"Bullet:50", Way::impulses, 50},
                                 {"Bullet:NNCG", Way::conjugate_gradients, 50},
                                 {"Bullet:Dantzig", Way::direct, 10},
                                 {"Bullet:multibody", Way::multibody, 50},
                                 {"Bullet:multibody,RK4", Way::multibody_runge_kutta, 50}};

constexpr std::size_t kMany = 30;  // bodies, beyond which the direct solver's n^3 is too much

std::unique_ptr<btConstraintSolver> solver_of(Way way, btDantzigSolver& dantzig) {
  if (way == Way::conjugate_gradients) return std::make_unique<btNNCGConstraintSolver>();
  if (way == Way::direct) return std::make_unique<btMLCPSolver>(&dantzig);
  if (has_trees(way)) return std::make_unique<btMultiBodyConstraintSolver>();
  return std::make_unique<btSequentialImpulseConstraintSolver>();
}

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
  BulletRun(const PeerScene& scene, double h, const Variant& variant)
      : PeerRun(scene, h), dispatcher_(&configuration_), solver_(solver_of(variant.way, dantzig_)) {
    gCalculateCombinedRestitutionCallback = larger_restitution;
    gCalculateCombinedFrictionCallback = mean_friction;
    make_world(has_trees(variant.way));
    world_->setGravity(to_bullet(scene.gravity));
    btContactSolverInfo& info = world_->getSolverInfo();
    info.m_numIterations = variant.iterations;
    info.m_restitutionVelocityThreshold = 0;                            // slow bounces bounce, too
    if (variant.way == Way::direct) info.m_minimumSolverBatchSize = 1;  // small matrices
    for (const PeerBody& body : scene.bodies) make(body);
    if (trees_world_)
      trees_ = std::make_unique<BulletTrees>(scene_, *trees_world_, shapes_,
                                             variant.way == Way::multibody_runge_kutta);
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (!in_tree(i)) enter(i);
    for (std::size_t i = 0; i < scene.links.size(); ++i)
      if (!trees_ || scene.links[i].kind == LinkSpec::Kind::spring) add(scene.links[i]);
  }

  ~BulletRun() override {
    trees_.reset();
    for (auto& pin : pins_) world_->removeConstraint(pin.get());
    for (auto& body : bodies_)
      if (body->isInWorld()) world_->removeRigidBody(body.get());
  }

 protected:
  void step() override {
    world_->stepSimulation(h_, 0, h_);
    if (trees_) trees_->has_moved();
  }

  bool is_finite() const override {
    double sum = trees_ ? trees_->sum() : 0;
    for (const auto& body : bodies_)
      sum += body->getWorldTransform().getOrigin().length2() + body->getLinearVelocity().length2() +
             body->getAngularVelocity().length2();
    return std::isfinite(sum);
  }

  PeerMotion motion(std::size_t i) const override {
    if (in_tree(i)) return trees_->motion(i);
    const btRigidBody& body = *bodies_[i];
    const btQuaternion q = body.getWorldTransform().getRotation();
    return {from_bullet(body.getWorldTransform().getOrigin()),
            from_bullet(body.getLinearVelocity()),
            {glm::dquat(q.w(), q.x(), q.y(), q.z())},
            from_bullet(body.getAngularVelocity())};
  }

  void push(std::size_t i, const Vec<3>& force, const Vec<3>& arm) override {
    if (in_tree(i)) return trees_->push(i, force, cross(arm, force));
    bodies_[i]->applyForce(to_bullet(force), to_bullet(arm));
  }

  void set_velocity(std::size_t i, const Vec<3>& velocity) override {
    if (in_tree(i)) throw Refused("Bullet's joints leave no velocity to be set");
    bodies_[i]->setLinearVelocity(to_bullet(velocity));
  }

 private:
  bool in_tree(std::size_t i) const { return trees_ && trees_->has(i); }

  void make_world(bool with_trees) {
    if (!with_trees) {
      world_ = std::make_unique<btDiscreteDynamicsWorld>(&dispatcher_, &broad_phase_, solver_.get(),
                                                         &configuration_);
      return;
    }
    auto* solver = static_cast<btMultiBodyConstraintSolver*>(solver_.get());
    auto world = std::make_unique<btMultiBodyDynamicsWorld>(&dispatcher_, &broad_phase_, solver,
                                                            &configuration_);
    trees_world_ = world.get();
    world_ = std::move(world);
  }

  void make(const PeerBody& spec) {
    shapes_.push_back(shape_of(spec, scene_.is_flat()));
    const btVector3 inertia = to_bullet(spec.may_turn ? spec.inertia : Vec<3>(0.0));
    btRigidBody::btRigidBodyConstructionInfo info(spec.mass, nullptr, shapes_.back().get(),
                                                  inertia);
    info.m_startWorldTransform =
        btTransform(to_bullet(spec.orientation.q), to_bullet(spec.position));
    info.m_friction = spec.material.friction;
    info.m_restitution = spec.material.restitution;
    info.m_linearDamping = damping_of(spec.linear_drag, spec.mass);
    info.m_angularDamping = damping_of(spec.angular_drag, spec.inertia.x);
    bodies_.push_back(std::make_unique<btRigidBody>(info));
  }

  void enter(std::size_t i) {
    const PeerBody& spec = scene_.bodies[i];
    btRigidBody& body = *bodies_[i];
    if (!scene_.may_sleep) body.setActivationState(DISABLE_DEACTIVATION);
    const int all = scene_.collides() ? -1 : 0;
    world_->addRigidBody(&body, all, all);
    if (!spec.is_dynamic()) return;
    if (needs_continuous(scene_, spec, h_)) {
      const double least = least_extent(spec.shape, scene_.is_flat());
      body.setCcdMotionThreshold(least);
      body.setCcdSweptSphereRadius(least / 2);
    }
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
    world_->addConstraint(pins_.back().get(), true);
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broad_phase_;
  btDantzigSolver dantzig_;
  std::unique_ptr<btConstraintSolver> solver_;
  std::unique_ptr<btDiscreteDynamicsWorld> world_;
  btMultiBodyDynamicsWorld* trees_world_ = nullptr;  // the same, if it has any
  BulletShapes shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;  // in the world unless in a tree
  std::vector<std::unique_ptr<btTypedConstraint>> pins_;
  std::unique_ptr<BulletTrees> trees_;
};

bool is_joint(const PeerLink& link) { return link.kind != LinkSpec::Kind::spring; }

std::optional<std::string> cannot(const PeerScene& scene, const Variant& variant) {
  for (const PeerBody& body : scene.bodies)
    if (body.kind == BodyKind::kinematic_body)
      return "body '" + body.name + "': Bullet has no bodies that keep their velocity";
  const bool jointed = std::ranges::any_of(scene.links, is_joint);
  if (has_trees(variant.way)) {
    if (!jointed) return "it has no joints, which multibodies are for";
    if (auto reason = BulletTrees::cannot(scene)) return reason;
    return solid_engine_cannot(scene);
  }
  for (const PeerLink& link : scene.links)
    if (link.kind == LinkSpec::Kind::distance)
      return "Bullet's rigid bodies have no rod between two points";
  if (!(variant.way == Way::impulses && variant.iterations == kDefaultIterations) &&
      !scene.collides() && !jointed)
    return kNothingToSolve;
  if (variant.way == Way::conjugate_gradients && jointed)
    return "Bullet's conjugate gradients blow up on a single pin";
  if (variant.way == Way::direct && scene.bodies.size() > kMany)
    return "the direct solver's time grows with the cube of the bodies";
  return solid_engine_cannot(scene);
}

PeerSettings settings(const Variant& variant) {
  using enum Way;
  const bool runge_kutta = variant.way == multibody_runge_kutta;
  const std::string n = std::to_string(variant.iterations);
  PeerSettings told{
      .precision = "double",
      .integrator = runge_kutta ? "Runge-Kutta of order 4 for multibodies" : "semi-implicit Euler",
      .solver = "sequential impulses, warm-started",
      .iterations = n,
      .joints = "point to point; springs as forces",
      .flags =
          "split impulse, ERP 0.2, implicit gyroscopic term, as by default; continuous only "
          "for bodies that start faster than their size a step; restitution threshold 0",
      .source = variant.iterations == kDefaultIterations
                    ? "Bullet's manual and wiki, BtContactSolverInfo: 10 iterations"
                    : "a finer effort, ours; the wiki takes 4 to 20"};
  if (variant.way == conjugate_gradients) {
    told.solver = "non-smooth nonlinear conjugate gradients";
    told.source = "a finer effort, ours, by its other iterative solver";
  } else if (variant.way == direct) {
    told.solver = "Dantzig's algorithm, direct; sequential impulses where it fails";
    told.iterations = "none: until it is solved";
    told.source = "Bullet's examples (MLCP: a solver batch size of 1)";
  } else if (has_trees(variant.way)) {
    told.solver = "Featherstone's articulated bodies; impulses for contacts and closed loops";
    told.joints = "revolute, spherical; point to point for what closes a loop; springs as forces";
    told.source = "Bullet's examples (MultiBody): damping 0, gyroscopic term on";
  }
  return told;
}

}  // namespace
extern "C" void lantern_peers(std::vector<Peer>& peers) {
  for (const Variant& variant : kVariants)
    peers.push_back({variant.name, LANTERN_PEER_VERSION, settings(variant),
                     [&variant](const PeerScene& scene) { return cannot(scene, variant); },
                     [&variant](const PeerScene& scene, double h) {
                       return std::make_unique<BulletRun>(scene, h, variant);
                     }});
}

}  // namespace lantern::peers
