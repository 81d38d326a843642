// Box2D: flat, in single precision; warm-started impulses, semi-implicit Euler.
#include <algorithm>
#include <cmath>

#include <box2d/box2d.h>

#include "peers/peer_run.hpp"

namespace lantern::peers {
namespace {

struct Effort {
  int velocity_sweeps, position_sweeps;
};
constexpr Effort kManuals{8, 3}, kFiner{40, 20};

float number(double value) { return static_cast<float>(value); }
b2Vec2 to_box2d(const Vec<3>& v) { return {number(v.x), number(v.y)}; }
Vec<3> from_box2d(const b2Vec2& v) { return {v.x, v.y, 0}; }

// Polygons have a skin, by which others are kept off. The manual has them be smaller than what they
// stand for, and so they are, unless little would be left.
double shrinking(const Vec<3>& half) {
  return std::min(half.x, half.y) > 4 * b2_polygonRadius ? b2_polygonRadius : 0;
}

class Box2dRun : public PeerRun {
 public:
  Box2dRun(const PeerScene& scene, double h, const Effort& effort)
      : PeerRun(scene, h), effort_(effort), world_(to_box2d(scene.gravity)) {
    world_.SetAllowSleeping(scene.may_sleep);
    const b2BodyDef fixed;
    ground_ = world_.CreateBody(&fixed);
    for (const PeerBody& body : scene.bodies) add(body);
    for (const PeerLink& link : scene.links) add(link);
  }

  double skin(std::size_t i) const override {
    const auto is_bare = [&](const Vec<3>& half) { return shrinking(half) == 0; };
    return visit_peer_shape(
               scene_.bodies[i].shape, [](const Sphere&) { return false; }, is_bare,
               [](const Capsule&) { return false; }, [](const HalfSpace<3>&) { return false; })
               ? b2_polygonRadius
               : 0;
  }

 protected:
  void step() override {
    world_.Step(number(h_), effort_.velocity_sweeps, effort_.position_sweeps);
  }

  bool is_finite() const override {
    float sum = 0;
    for (const b2Body* body : bodies_)
      sum += 0 * (body->GetPosition().x + body->GetPosition().y + body->GetLinearVelocity().x +
                  body->GetLinearVelocity().y + body->GetAngularVelocity());
    return sum == 0;
  }

  PeerMotion motion(std::size_t i) const override {
    const b2Body& body = *bodies_[i];
    return {from_box2d(body.GetPosition()), from_box2d(body.GetLinearVelocity()),
            turned(Rotation<3>(), Vec<3>(0, 0, body.GetAngle())),
            Vec<3>(0, 0, body.GetAngularVelocity())};
  }

  void push(std::size_t i, const Vec<3>& force, const Vec<3>& arm) override {
    const b2Vec2 f = to_box2d(force);
    if (!f.IsValid()) throw Refused("a spring's force is too large for single precision");
    bodies_[i]->ApplyForceToCenter(f, true);
    bodies_[i]->ApplyTorque(number(cross(arm, force).z), true);
  }

  void set_velocity(std::size_t i, const Vec<3>& velocity) override {
    bodies_[i]->SetLinearVelocity(to_box2d(velocity));
  }

  std::optional<double> whole_angle(std::size_t i) const override { return bodies_[i]->GetAngle(); }

 private:
  void add(const PeerBody& spec) {
    b2BodyDef def;
    def.type = spec.is_dynamic()                       ? b2_dynamicBody
               : spec.kind == BodyKind::kinematic_body ? b2_kinematicBody
                                                       : b2_staticBody;
    def.position = to_box2d(spec.position);
    def.angle = number(spec.angle);
    def.linearVelocity = to_box2d(spec.velocity);
    def.angularVelocity = number(spec.turning.z);
    // It keeps 1 / (1 + h damping) of a velocity: the same drag, by implicit Euler.
    def.linearDamping = number(spec.linear_drag * spec.inverse_mass());
    def.angularDamping = spec.may_turn ? number(spec.angular_drag / spec.inertia.z) : 0;
    def.fixedRotation = spec.is_dynamic() && !spec.may_turn;
    def.bullet =
        needs_continuous(scene_, spec, h_);  // in its world all meet what is static in time
    bodies_.push_back(world_.CreateBody(&def));
    if (scene_.collides()) add_shape(spec, *bodies_.back());
    if (spec.is_dynamic()) {
      const b2MassData mass{number(spec.mass), b2Vec2(0, 0), number(spec.inertia.z)};
      bodies_.back()->SetMassData(&mass);
    }
  }

  void add_shape(const PeerBody& spec, b2Body& body) {
    b2CircleShape disc;
    b2PolygonShape box;
    b2EdgeShape edge;
    b2FixtureDef def;
    visit_peer_shape(
        spec.shape,
        [&](const Sphere& s) {
          disc.m_radius = number(s.radius);
          def.shape = &disc;
        },
        [&](const Vec<3>& half) {
          const double less = shrinking(half);
          box.SetAsBox(number(half.x - less), number(half.y - less));
          def.shape = &box;
        },
        [](const Capsule&) { throw Refused("Box2D has no capsules"); },
        [&](const HalfSpace<3>& s) {
          // Its edge, below its skin, as far as bodies are likely to go; the normal lies left of
          // the way back.
          const Vec<3> along =
              Vec<3>(s.normal.y, -s.normal.x, 0) * (4 * glm::length(scene_.bounds.size()));
          const Vec<3> below = -double{b2_polygonRadius} * s.normal;
          edge.SetTwoSided(to_box2d(below - along), to_box2d(below + along));
          def.shape = &edge;
          body.SetTransform(body.GetPosition(), 0);
        });
    def.friction = number(spec.material.friction);
    def.restitution = number(spec.material.restitution);
    def.restitutionThreshold = 0;  // slow bounces bounce, too
    body.CreateFixture(&def);
  }

  void add(const PeerLink& link) {
    b2Body* a = bodies_[link.a];
    b2Body* b = link.b ? bodies_[*link.b] : ground_;
    const auto attach = [&](auto& def) {
      def.bodyA = a;
      def.bodyB = b;
      def.localAnchorA = to_box2d(link.at_a);
      def.localAnchorB = to_box2d(link.at_b);
    };
    if (link.kind == LinkSpec::Kind::pin) {
      b2RevoluteJointDef def;
      attach(def);
      def.referenceAngle = b->GetAngle() - a->GetAngle();
      world_.CreateJoint(&def);
      return;
    }
    const bool is_spring = link.kind == LinkSpec::Kind::spring;
    if (is_spring && (is_soft(link) || link.length < b2_linearSlop)) return pull_by_force(link);
    b2DistanceJointDef def;
    attach(def);
    def.length = number(link.length);
    def.collideConnected = is_spring;
    if (is_spring) {
      def.stiffness = number(link.stiffness);
      def.damping = number(link.damping);
    } else {
      def.minLength = def.maxLength = def.length;
    }
    world_.CreateJoint(&def);
  }

  Effort effort_;
  b2World world_;
  b2Body* ground_ = nullptr;
  std::vector<b2Body*> bodies_;
};

bool fits(double value) { return std::isfinite(number(value)); }

std::optional<std::string> cannot(const PeerScene& scene, bool finer) {
  if (finer && !scene.collides() && scene.links.empty()) return kNothingToSolve;
  for (const PeerBody& body : scene.bodies) {
    if (scene.collides() && std::holds_alternative<Capsule>(body.shape))
      return "body '" + body.name + "': Box2D 2.4 has no capsules";
    if (body.is_dynamic() && (!fits(body.mass) || !(number(body.mass) > 0)))
      return "body '" + body.name + "': its mass does not fit single precision";
    if (!fits(body.position.x) || !fits(body.position.y))
      return "body '" + body.name + "': its position does not fit single precision";
  }
  for (const PeerLink& link : scene.links) {
    if (link.kind == LinkSpec::Kind::distance && link.length < b2_linearSlop)
      return "Box2D has no rod shorter than 0.005";
    if (!fits(link.stiffness) || !fits(link.damping))
      return "a spring does not fit single precision";
  }
  return solid_engine_cannot(scene);
}

std::unique_ptr<Simulation> start(const PeerScene& scene, double h, const Effort& effort) {
  if (!(number(h) > 0) || !fits(h)) throw Refused("the step does not fit single precision");
  for (const PeerBody& body : scene.bodies) {
    if (glm::length(body.velocity) * h > b2_maxTranslation)
      throw Refused("body '" + body.name + "': Box2D moves a body by no more than 2 a step");
    if (std::abs(body.turning.z) * h > b2_maxRotation)
      throw Refused("body '" + body.name + "': Box2D turns a body by no more than pi/2 a step");
  }
  return std::make_unique<Box2dRun>(scene, h, effort);
}

}  // namespace
extern "C" void lantern_peers(std::vector<Peer>& peers) {
  for (const Effort& effort : {kManuals, kFiner}) {
    const bool finer = effort.velocity_sweeps > kManuals.velocity_sweeps;
    const std::string v = std::to_string(effort.velocity_sweeps),
                      p = std::to_string(effort.position_sweeps);
    peers.push_back(
        {"Box2D:" + v + "," + p,
         LANTERN_PEER_VERSION,
         {.precision = "single",
          .integrator = "semi-implicit Euler",
          .solver = "sequential impulses, warm-started",
          .iterations = v + " of velocities, " + p + " of positions",
          .joints = "revolute, distance; springs as forces, stiff ones as its soft distance joint",
          .flags =
              "bullet only on bodies that start faster than their size a step; restitution "
              "threshold 0; polygons smaller by their skin of 0.01, if they are larger than 0.04",
          .source =
              finer ? "a finer effort, ours"
                    : "Box2D's manual 2.4: Simulating the World, Polygon shapes (skin), Bullets"},
         [=](const PeerScene& scene) { return cannot(scene, finer); },
         [=](const PeerScene& scene, double h) { return start(scene, h, effort); }});
  }
}

}  // namespace lantern::peers
