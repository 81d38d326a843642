#include <cmath>

#include "measure/closed_forms.hpp"
#include "measure/error_metrics.hpp"
#include "measure/problem_scene.hpp"

namespace lantern {
namespace {

struct Oscillator {
  std::size_t body = 0;
  long double stiffness = 1, damping = 0, mass = 1;
  LongVec3 rest{0.0L};  // where it would come to rest
  LongVec3 away{0.0L};  // from there, at the start
  LongVec3 velocity{0.0L};
};

}  // namespace

std::unique_ptr<ErrorMetric> oscillator_metric(const Scenario& scenario) {
  const std::size_t body = the_body(scenario);
  require_links(scenario, 1);
  const LinkSpec& spring = scenario.links.front();
  if (spring.kind != LinkSpec::Kind::spring) refuse_problem(scenario, "it hangs on a spring");
  const Tie tie = read_tie(scenario, spring);
  const BodySpec& spec = scenario.bodies[body];
  Oscillator o;
  o.body = body;
  o.stiffness = spring.stiffness;
  o.mass = mass_of_body(scenario, body);
  o.damping = static_cast<long double>(spring.damping) + spec.linear_drag;
  o.velocity = spec.velocity;
  const LongVec3 gravity(scenario.world.gravity), start(spec.position);
  const LongVec3 between = start - tie.anchor;
  LongVec3 line = between;
  if (line == LongVec3(0.0L)) line = o.velocity;
  if (line == LongVec3(0.0L)) line = gravity;
  if (line == LongVec3(0.0L)) refuse_problem(scenario, "nothing moves");
  const bool straight = tie.rest_length > 0 || spring.damping > 0;
  if (straight && !(parallel(line, o.velocity) && parallel(line, gravity)))
    refuse_problem(scenario, "it must move along the line of its spring");
  const LongVec3 direction = line / glm::length(line);
  o.rest = tie.anchor + tie.rest_length * direction + gravity * (o.mass / o.stiffness);
  o.away = start - o.rest;
  const long double omega = std::sqrt(o.stiffness / o.mass);
  const long double amplitude = std::hypot(glm::length(o.away), glm::length(o.velocity) / omega);
  if (tie.rest_length > 0 &&
      (between == LongVec3(0.0L) || !(amplitude < glm::dot(o.rest - tie.anchor, direction))))
    refuse_problem(scenario, "it would pass through the spring's other end");
  if (!(amplitude > 0)) refuse_problem(scenario, "nothing moves");
  return std::make_unique<TrajectoryMetric>(
      amplitude, amplitude * omega, [o](double time, auto& states) {
        LongVec3 x, v;
        for (int axis = 0; axis < 3; ++axis) {
          const Swing swing =
              exact_swing(o.stiffness, o.damping, o.mass, {o.away[axis], o.velocity[axis]}, time);
          x[axis] = o.rest[axis] + swing.x;
          v[axis] = swing.v;
        }
        states.push_back({o.body, Vec<3>(x), Vec<3>(v)});
      });
}

}  // namespace lantern
