#include "measure/peer_scene.hpp"

#include <algorithm>

#include "geometry/flat.hpp"
#include "physics/mass.hpp"

namespace lantern {
namespace {

// As World::add derives it.
template <int D>
void weigh(const BodySpec& spec, PeerBody& body) {
  const double density = spec.mass > 0 && spec.density == 0 ? 1 : spec.density;
  MassProperties<D> properties = mass_of<D>(in_dimension<D>(spec.shape), density);
  if (spec.mass > 0) properties = scaled_to<D>(properties, spec.mass);
  body.mass = properties.mass;
  body.inertia = Vec<3>(properties.inertia);
}

PeerBody body_of(const BodySpec& spec, bool is_flat) {
  PeerBody body;
  body.name = spec.name;
  body.kind = spec.kind;
  body.shape = spec.shape;
  body.position = spec.position;
  body.velocity = spec.velocity;
  const Vec<3> axis = is_flat ? Vec<3>(0, 0, 1) : spec.axis;
  body.orientation = turned(Rotation<3>(), axis * spec.angle);
  body.angle = spec.angle;
  body.spin = axis * spec.spin;
  body.material = spec.material;
  body.linear_drag = spec.linear_drag;
  body.angular_drag = spec.angular_drag;
  if (body.is_dynamic()) {
    if (is_flat)
      weigh<2>(spec, body);
    else
      weigh<3>(spec, body);
  }
  body.attracting_mass = body.is_dynamic() ? body.mass : spec.mass;
  const bool has_inertia = std::min({body.inertia.x, body.inertia.y, body.inertia.z}) > 0;
  body.may_turn = spec.may_turn && has_inertia && !std::holds_alternative<AxisBox<3>>(spec.shape);
  if (body.is_dynamic() && !body.may_turn) body.spin = Vec<3>(0.0);
  return body;
}

PeerLink link_of(const LinkSpec& spec, const std::vector<PeerBody>& bodies) {
  const auto point = [&](std::size_t i, const Vec<3>& at) {
    return bodies[i].position + matrix(bodies[i].orientation) * at;
  };
  PeerLink link;
  link.kind = spec.kind;
  link.a = spec.a;
  link.b = spec.b;
  link.at_a = spec.at_a;
  link.at_b = spec.at_b;
  link.from = point(spec.a, spec.at_a);
  link.to = spec.b ? point(*spec.b, spec.at_b) : spec.at_b;
  link.rest_length = spec.rest_length.value_or(glm::length(link.to - link.from));
  link.stiffness = spec.stiffness;
  link.damping = spec.damping;
  return link;
}

// A script that only lets the bodies in and then watches them.
bool only_watches(const std::vector<Step>& steps) {
  bool runs = false;
  for (const Step& step : steps) {
    const Verb& verb = step.verb;
    if (std::holds_alternative<Insert>(verb) && runs) return false;
    if (std::holds_alternative<Remove>(verb) || std::holds_alternative<Move>(verb) ||
        std::holds_alternative<ApplyForce>(verb) || std::holds_alternative<ApplyImpulse>(verb) ||
        std::holds_alternative<Sleep>(verb) || std::holds_alternative<Wake>(verb))
      return false;
    runs |= traits_of(verb).passes_time;
  }
  return true;
}

}  // namespace

std::optional<std::string> only_lantern_can(const Scenario& scenario) {
  if (scenario.level) return "it has a level";
  if (scenario.bodies.empty()) return "it has no bodies";
  for (const BodySpec& body : scenario.bodies) {
    if (body.brain != Brain::none) return "body '" + body.name + "' is steered";
    if (body.asleep) return "body '" + body.name + "' begins asleep";
  }
  if (!scenario.problem && !only_watches(scenario.steps))
    return "its script changes bodies on their way";
  return std::nullopt;
}

PeerScene peer_scene(const Scenario& scenario) {
  PeerScene scene;
  scene.dimension = scenario.world.dimension;
  scene.bounds = scenario.world.bounds;
  scene.gravity = scenario.world.gravity;
  scene.gravitation = scenario.world.gravitation;
  scene.contacts = scenario.world.contacts != ContactMethod::none;
  for (const BodySpec& spec : scenario.bodies)
    scene.bodies.push_back(body_of(spec, scene.is_flat()));
  for (const LinkSpec& spec : scenario.links) scene.links.push_back(link_of(spec, scene.bodies));
  return scene;
}

}  // namespace lantern
