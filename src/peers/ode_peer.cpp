// ODE: semi-implicit Euler; contacts and joints as one linear complementarity problem, solved by
// sweeps (quick step) or exactly.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <set>

#include <ode/ode.h>

#include "peers/peer_run.hpp"

namespace lantern::peers {
namespace {

constexpr int kDefaultIterations = 20, kFinerIterations = 100;  // of the quick step
constexpr int kMostPoints = 8;                                  // of a pair that touches
constexpr double kRigid = 1e20;     // inertia of what may not turn: ODE wants it above 0
constexpr double kFastTurn = 0.01;  // radians a step
constexpr std::size_t kMany = 64;   // bodies, beyond which the exact solver's n^3 is too much

Vec<3> from_ode(const dReal* v) { return {v[0], v[1], v[2]}; }

// All that ODE makes for a world goes with it.
struct OdeWorld {
  dWorldID world = dWorldCreate();
  dSpaceID space = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
  dJointGroupID contacts = dJointGroupCreate(0);
  ~OdeWorld() {
    dJointGroupDestroy(contacts);
    dSpaceDestroy(space);
    dWorldDestroy(world);
  }
};

class OdeRun : public PeerRun {
 public:
  // By the direct solver if there are no iterations.
  OdeRun(const PeerScene& scene, double h, int iterations)
      : PeerRun(scene, h), exact_(iterations == 0) {
    dRandSetSeed(1);  // the quick step takes constraints in random order
    dWorldSetGravity(ode_.world, scene.gravity.x, scene.gravity.y, scene.gravity.z);
    dWorldSetAutoDisableFlag(ode_.world, scene.may_sleep);
    if (!exact_) dWorldSetQuickStepNumIterations(ode_.world, iterations);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) add(i);
    for (const PeerLink& link : scene.links) add(link);
  }

 protected:
  void step() override {
    if (scene_.collides()) dSpaceCollide(ode_.space, this, &OdeRun::meet);
    if (exact_)
      dWorldStep(ode_.world, h_);
    else
      dWorldQuickStep(ode_.world, h_);
    dJointGroupEmpty(ode_.contacts);
  }

  bool is_finite() const override {
    double sum = 0;
    for (const dBodyID body : bodies_) {
      if (!body) continue;
      const dReal *x = dBodyGetPosition(body), *v = dBodyGetLinearVel(body),
                  *w = dBodyGetAngularVel(body);
      for (int i = 0; i < 3; ++i) sum += 0 * (x[i] + v[i] + w[i]);
    }
    return sum == 0;
  }

  PeerMotion motion(std::size_t i) const override {
    const dBodyID body = bodies_[i];
    if (!body) return motion_at_start(scene_.bodies[i]);
    const dReal* q = dBodyGetQuaternion(body);
    return {from_ode(dBodyGetPosition(body)),
            from_ode(dBodyGetLinearVel(body)),
            {glm::dquat(q[0], q[1], q[2], q[3])},
            from_ode(dBodyGetAngularVel(body))};
  }

  std::pair<Vec<3>, Vec<3>> centre(std::size_t i) const override {
    if (!bodies_[i]) return {scene_.bodies[i].position, Vec<3>(0.0)};
    return {from_ode(dBodyGetPosition(bodies_[i])), from_ode(dBodyGetLinearVel(bodies_[i]))};
  }

  void push(std::size_t i, const Vec<3>& force, const Vec<3>& arm) override {
    if (!scene_.bodies[i].is_dynamic()) return;
    const Vec<3> torque = cross(arm, force);
    dBodyAddForce(bodies_[i], force.x, force.y, force.z);
    dBodyAddTorque(bodies_[i], torque.x, torque.y, torque.z);
  }

  void set_velocity(std::size_t i, const Vec<3>& velocity) override {
    if (bodies_[i]) dBodySetLinearVel(bodies_[i], velocity.x, velocity.y, velocity.z);
  }

 private:
  void add(std::size_t index) {
    const PeerBody& spec = scene_.bodies[index];
    const dQuaternion q = {spec.orientation.q.w, spec.orientation.q.x, spec.orientation.q.y,
                           spec.orientation.q.z};
    dBodyID body = nullptr;
    if (spec.kind != BodyKind::static_body) {
      body = dBodyCreate(ode_.world);
      dBodySetPosition(body, spec.position.x, spec.position.y, spec.position.z);
      dBodySetQuaternion(body, q);
      dBodySetLinearVel(body, spec.velocity.x, spec.velocity.y, spec.velocity.z);
      dBodySetAngularVel(body, spec.turning.x, spec.turning.y, spec.turning.z);
      // The manual: "more costly to compute, but more accurate for high speed rotations".
      dBodySetFiniteRotationMode(body, glm::length(spec.turning) * h_ > kFastTurn);
    }
    if (spec.kind == BodyKind::kinematic_body) dBodySetKinematic(body);
    if (spec.is_dynamic()) set_mass(body, spec);
    bodies_.push_back(body);
    if (!scene_.collides()) return;
    const dGeomID geom = shape_of(spec);
    dGeomSetData(geom, reinterpret_cast<void*>(index));
    const bool is_capsule = std::holds_alternative<Capsule>(spec.shape);
    if (body) {
      dGeomSetBody(geom, body);
      if (is_capsule) dGeomSetOffsetQuaternion(geom, kUpright.data());
    } else if (!std::holds_alternative<HalfSpace<3>>(spec.shape)) {
      dGeomSetPosition(geom, spec.position.x, spec.position.y, spec.position.z);
      dQuaternion turned_q;
      dQMultiply0(turned_q, q, kUpright.data());
      dGeomSetQuaternion(geom, is_capsule ? turned_q : q);
    }
  }

  void set_mass(dBodyID body, const PeerBody& spec) {
    const Vec<3> i = spec.may_turn ? spec.inertia : Vec<3>(kRigid * spec.mass);
    dMass mass;
    dMassSetParameters(&mass, spec.mass, 0, 0, 0, i.x, i.y, i.z, 0, 0, 0);
    dBodySetMass(body, &mass);
    // A step keeps 1 - scale of a velocity: exact.
    if (spec.linear_drag > 0) {
      dBodySetLinearDampingThreshold(body, 0);
      dBodySetLinearDamping(body, -std::expm1(-spec.linear_drag / spec.mass * h_));
    }
    if (spec.angular_drag > 0 && spec.may_turn) {
      dBodySetAngularDampingThreshold(body, 0);
      dBodySetAngularDamping(body, -std::expm1(-spec.angular_drag / spec.inertia.x * h_));
    }
  }

  dGeomID shape_of(const PeerBody& body) const {
    return visit_peer_shape(
        body.shape, [&](const Sphere& s) { return dCreateSphere(ode_.space, s.radius); },
        [&](const Vec<3>& half) {
          const Vec<3> size = 2.0 * with_depth(half, scene_.is_flat());
          return dCreateBox(ode_.space, size.x, size.y, size.z);
        },
        [&](const Capsule& c) { return dCreateCapsule(ode_.space, c.radius, 2 * c.half_length); },
        [&](const HalfSpace<3>& s) {
          const Vec<3>& n = s.normal;
          return dCreatePlane(ode_.space, n.x, n.y, n.z, glm::dot(n, body.position));
        });
  }

  void add(const PeerLink& link) {
    const dBodyID a = bodies_[link.a], b = link.b ? bodies_[*link.b] : nullptr;
    const bool is_spring = link.kind == LinkSpec::Kind::spring;
    if (is_spring && is_soft(link)) return pull_by_force(link);
    if (link.b && !is_spring) joined_.insert(std::minmax(link.a, *link.b));
    if (!a && !b) return;
    if (link.kind == LinkSpec::Kind::pin) {
      const dJointID pin = dJointCreateBall(ode_.world, nullptr);
      dJointAttach(pin, a, b);
      dJointSetBallAnchor(pin, link.from.x, link.from.y, link.from.z);
      return;
    }
    const dJointID rod = dJointCreateDBall(ode_.world, nullptr);
    dJointAttach(rod, a, b);
    dJointSetDBallAnchor1(rod, link.from.x, link.from.y, link.from.z);
    dJointSetDBallAnchor2(rod, link.to.x, link.to.y, link.to.z);
    dJointSetDBallDistance(rod, link.length);
    if (!is_spring) return;
    // ODE's manual: a joint that gives way acts as an implicit spring.
    const double yielding = h_ * link.stiffness + link.damping;
    dJointSetDBallParam(rod, dParamERP, h_ * link.stiffness / yielding);
    dJointSetDBallParam(rod, dParamCFM, 1 / yielding);
  }

  static void meet(void* self, dGeomID a, dGeomID b) { static_cast<OdeRun*>(self)->meet(a, b); }

  void meet(dGeomID ga, dGeomID gb) {
    const auto ia = reinterpret_cast<std::size_t>(dGeomGetData(ga)),
               ib = reinterpret_cast<std::size_t>(dGeomGetData(gb));
    const PeerBody &a = scene_.bodies[ia], &b = scene_.bodies[ib];
    if (!a.is_dynamic() && !b.is_dynamic()) return;
    if (!joined_.empty() && joined_.contains(std::minmax(ia, ib))) return;
    std::array<dContact, kMostPoints> points;
    const int n = dCollide(ga, gb, kMostPoints, &points[0].geom, sizeof(dContact));
    for (int i = 0; i < n; ++i) {
      dSurfaceParameters& surface = points[i].surface;
      surface.mode = dContactApprox1;
      surface.mu = std::sqrt(a.material.friction * b.material.friction);
      surface.bounce = std::max(a.material.restitution, b.material.restitution);
      surface.bounce_vel = 0;  // slow bounces bounce, too
      if (surface.bounce > 0) surface.mode |= dContactBounce;
      dJointAttach(dJointCreateContact(ode_.world, ode_.contacts, &points[i]), bodies_[ia],
                   bodies_[ib]);
    }
  }

  // From ODE's capsule, along z, to Lantern's, along y.
  static constexpr std::array<dReal, 4> kUpright = {0.70710678118654752, 0.70710678118654752, 0, 0};

  bool exact_;
  OdeWorld ode_;
  std::vector<dBodyID> bodies_;  // null for static ones
  std::set<std::pair<std::size_t, std::size_t>> joined_;
};

std::optional<std::string> cannot(const PeerScene& scene, int iterations) {
  if (iterations != kDefaultIterations && is_unconstrained(scene)) return kNothingToSolve;
  if (iterations == 0 && scene.bodies.size() > kMany)
    return "the exact solver's time grows with the cube of the bodies";
  return solid_engine_cannot(scene);
}

}  // namespace
}  // namespace lantern::peers

extern "C" void lantern_peers(std::vector<lantern::measure::Peer>& peers) {
  using namespace lantern::peers;
  [[maybe_unused]] static const int started = dInitODE2(0);
  // Else it writes to the terminal, and ends the program.
  dSetMessageHandler([](int, const char*, va_list) {});
  dSetErrorHandler([](int, const char* why, va_list) { throw lantern::Refused(why); });
  dSetDebugHandler([](int, const char* why, va_list) { throw lantern::Refused(why); });
  for (const int iterations : {kDefaultIterations, kFinerIterations, 0}) {
    const std::string n = std::to_string(iterations);
    peers.push_back(
        {iterations > 0 ? "ODE:" + n : "ODE:exact",
         LANTERN_PEER_VERSION,
         {.precision = "double",
          .integrator = "semi-implicit Euler; finite rotations for bodies that turn fast",
          .solver = iterations > 0 ? "dWorldQuickStep: projected Gauss-Seidel with over-relaxation"
                                   : "dWorldStep: Dantzig's algorithm, direct",
          .iterations = iterations > 0 ? n : "none: until it is solved",
          .joints = "ball, double ball; springs as forces, stiff ones by ERP and CFM",
          .flags = "ERP 0.2, CFM 1e-10 and no surface layer, as by default; friction pyramid 1; at "
                   "most 8 points a contact",
          .source = iterations == kFinerIterations
                        ? "a finer effort, ours"
                        : "ODE's manual: World, Joint types (ERP and CFM), Rigid body functions"},
         [=](const PeerScene& scene) { return cannot(scene, iterations); },
         [=](const PeerScene& scene, double h) {
           return std::make_unique<OdeRun>(scene, h, iterations);
         }});
  }
}
