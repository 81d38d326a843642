#include "measure/problem_scene.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "physics/mass.hpp"

namespace lantern {

std::vector<std::size_t> dynamic_bodies(const Scenario& scenario) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i)
    if (scenario.bodies[i].kind == BodyKind::dynamic_body) all.push_back(i);
  return all;
}

std::size_t the_body(const Scenario& scenario, std::string_view problem) {
  const std::vector<std::size_t> all = dynamic_bodies(scenario);
  if (all.size() != 1)
    throw Refused(fmt::format("{}: it has one dynamic body, not {}", problem, all.size()));
  return all.front();
}

void require_links(const Scenario& scenario, std::size_t count, std::string_view problem) {
  if (scenario.links.size() != count)
    throw Refused(fmt::format("{}: it has {} springs or joints, not {}", problem, count,
                              scenario.links.size()));
}

double mass_of_body(const Scenario& scenario, std::size_t body) {
  const BodySpec& spec = scenario.bodies[body];
  if (spec.mass > 0) return spec.mass;
  return scenario.world.dimension == 3 ? mass_of<3>(spec.shape, spec.density).mass
                                       : mass_of<2>(in_dimension<2>(spec.shape), spec.density).mass;
}

Tie read_tie(const Scenario& scenario, const LinkSpec& link, std::string_view problem) {
  Tie tie;
  tie.a = link.a;
  const bool at_point = !link.b;
  if (link.at_a != Vec<3>(0.0) || (!at_point && link.at_b != Vec<3>(0.0)))
    throw Refused(fmt::format("{}: springs and rods end at the bodies' centres", problem));
  Vec<3> end = link.at_b;
  if (link.b) {
    tie.b = link.b;
    end = scenario.bodies[*link.b].position;
    // The moving one first.
    if (scenario.bodies[tie.a].kind != BodyKind::dynamic_body) std::swap(tie.a, *tie.b);
    const BodySpec& other = scenario.bodies[*tie.b];
    if (other.kind == BodyKind::kinematic_body)
      throw Refused(fmt::format("{}: body '{}' is kinematic", problem, other.name));
    if (other.kind == BodyKind::static_body) {
      end = other.position;
      tie.b.reset();
    }
  }
  if (scenario.bodies[tie.a].kind != BodyKind::dynamic_body)
    throw Refused(fmt::format("{}: nothing moves on one of the springs or rods", problem));
  tie.anchor = end;
  const Vec<3> other = tie.b ? scenario.bodies[*tie.b].position : end;
  tie.rest_length = link.rest_length
                        ? static_cast<long double>(*link.rest_length)
                        : glm::length(LongVec3(other) - LongVec3(scenario.bodies[tie.a].position));
  return tie;
}

bool parallel(const LongVec3& a, const LongVec3& b) {
  return glm::length(glm::cross(a, b)) <= 1e-15L * glm::length(a) * glm::length(b);
}

}  // namespace lantern
