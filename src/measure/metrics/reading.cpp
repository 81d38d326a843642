#include "measure/metrics/reading.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/error.hpp"
#include "physics/body.hpp"

namespace lantern::measure {
namespace {

constexpr double kNear = 1e-9;  // of a body's size: so near is touching

// The axis that `along` is nearest to, with its sign.
Vec<3> nearest_axis(const Vec<3>& along) {
  int best = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(along[i]) > std::abs(along[best])) best = i;
  Vec<3> axis(0.0);
  axis[best] = along[best] < 0 ? -1 : 1;
  return axis;
}

const Problem& row_of_problem(const Scenario& scenario) {
  if (!scenario.problem) throw Refused("the scenario has no [problem]");
  for (const auto problems : {smooth_problems, joints_problems, impacts_problems, ground_problems,
                              heaps_problems, tumble_problems})
    for (const Problem& one : problems())
      if (one.solution == scenario.problem->solution) return one;
  LANTERN_CHECK(to_string(scenario.problem->solution), ==, std::string_view("a known problem"));
  return smooth_problems().front();
}

}  // namespace

void refuse_problem(const Scenario& scenario, std::string_view why) {
  throw Refused("'{}' is no problem of kind {}: {}", scenario.name,
                to_string(scenario.problem->solution), why);
}

std::vector<std::size_t> dynamic_bodies(const Scenario& scenario) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i)
    if (scenario.bodies[i].kind == BodyKind::dynamic_body) all.push_back(i);
  return all;
}

std::size_t the_body(const Scenario& scenario) {
  const std::vector<std::size_t> all = dynamic_bodies(scenario);
  if (all.size() != 1)
    refuse_problem(scenario, fmt::format("it needs one dynamic body, not {}", all.size()));
  return all.front();
}

void require_links(const Scenario& scenario, std::size_t count) {
  if (scenario.links.size() != count)
    refuse_problem(scenario, fmt::format("it needs {} springs or joints, not {}", count,
                                         scenario.links.size()));
}

double mass_of_body(const Scenario& scenario, std::size_t body) {
  const BodySpec& spec = scenario.bodies[body];
  if (spec.mass > 0) return spec.mass;
  return scenario.world.dimension == 3 ? mass_of<3>(spec.shape, spec.density).mass
                                       : mass_of<2>(in_dimension<2>(spec.shape), spec.density).mass;
}

std::vector<std::size_t> moving_bodies(const Scenario& scenario) {
  std::vector<std::size_t> bodies;
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    const BodySpec& body = scenario.bodies[i];
    if (body.kind == BodyKind::static_body) continue;
    if (body.kind == BodyKind::kinematic_body || body.brain != Brain::none)
      refuse_problem(scenario, fmt::format("'{}' is steered", body.name));
    if (body.linear_drag != 0 || body.angular_drag != 0)
      refuse_problem(scenario, fmt::format("'{}' has drag", body.name));
    bodies.push_back(i);
  }
  if (bodies.empty()) refuse_problem(scenario, "nothing moves");
  return bodies;
}

void require_nothing_else(const Scenario& scenario, bool may_attract) {
  const WorldSpec& world = scenario.world;
  if (world.contacts != ContactMethod::none && scenario.bodies.size() > 1)
    refuse_problem(scenario, fmt::format("its bodies may touch: contacts = \"{}\"",
                                         to_string(world.contacts)));
  if (world.gravitation != 0 && scenario.bodies.size() > 1 && !may_attract)
    refuse_problem(scenario, "its bodies attract each other");
  for (const BodySpec& body : scenario.bodies) {
    if (body.brain != Brain::none)
      refuse_problem(scenario, fmt::format("'{}' is steered", body.name));
    if (body.asleep) refuse_problem(scenario, fmt::format("'{}' begins asleep", body.name));
  }
  for (const Step& step : scenario.steps)
    if (const auto* push = std::get_if<ApplyForce>(&step.verb); push && push->force != Vec<3>(0.0))
      refuse_problem(scenario,
                     fmt::format("the script pushes '{}'", scenario.bodies[push->body].name));
}

Footing ground_of(const Scenario& scenario) {
  Footing ground;
  int count = 0;
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i)
    if (scenario.bodies[i].kind == BodyKind::static_body) {
      ground.body = i;
      ++count;
    }
  if (count != 1) refuse_problem(scenario, fmt::format("it has {} static bodies, not one", count));
  const BodySpec& body = scenario.bodies[ground.body];
  if (const auto* half = std::get_if<HalfSpace<3>>(&body.shape)) {
    ground.normal = half->normal;
  } else if (std::holds_alternative<AxisBox<3>>(body.shape)) {
    Vec<3> towards = -scenario.world.gravity;
    if (towards == Vec<3>(0.0))
      towards = scenario.bodies[moving_bodies(scenario).front()].position - body.position;
    ground.normal = nearest_axis(towards);
  } else {
    refuse_problem(scenario, fmt::format("'{}' has no flat face", body.name));
  }
  ground.height = glm::dot(body.position, ground.normal) + reach_along(body, ground.normal);
  return ground;
}

void require_on_ground(const Scenario& scenario, const Footing& ground, std::size_t index) {
  const BodySpec& body = scenario.bodies[index];
  const double reach = reach_along(body, ground.normal);
  const double above = glm::dot(body.position, ground.normal) - reach - ground.height;
  const double size = reach + std::abs(ground.height);
  if (std::abs(above) > kNear * size)
    refuse_problem(scenario, fmt::format("'{}' does not lie on the ground", body.name));
}

void require_at_rest(const Scenario& scenario, std::size_t index) {
  const BodySpec& body = scenario.bodies[index];
  if (body.velocity != Vec<3>(0.0) || body.spin != 0)
    refuse_problem(scenario, fmt::format("'{}' does not begin at rest", body.name));
}

Slope slope_of(const Scenario& scenario, const Footing& ground) {
  const Vec<3>& g = scenario.world.gravity;
  Slope slope;
  slope.pull = -glm::dot(g, ground.normal);
  const Vec<3> along = g + ground.normal * slope.pull;
  slope.push = glm::length(along);
  if (!(slope.pull > 0) || !(slope.push > 1e-12 * slope.pull))
    refuse_problem(scenario, "gravity does not pull slantwise onto the ground");
  slope.downhill = along / slope.push;
  return slope;
}

double pull_onto(const Scenario& scenario, const Footing& ground) {
  const Vec<3>& gravity = scenario.world.gravity;
  const double pull = -glm::dot(gravity, ground.normal);
  if (!(pull > 0) || !are_parallel(gravity, ground.normal))
    refuse_problem(scenario, "gravity does not pull straight onto the ground");
  return pull;
}

double friction_between(const Scenario& scenario, std::size_t a, std::size_t b) {
  return std::sqrt(scenario.bodies[a].material.friction * scenario.bodies[b].material.friction);
}

double restitution_between(const Scenario& scenario, std::size_t a, std::size_t b) {
  return std::max(scenario.bodies[a].material.restitution, scenario.bodies[b].material.restitution);
}

double reach_along(const BodySpec& body, const Vec<3>& along) {
  const Vec<3> local = glm::transpose(matrix(orientation_of(body))) * along;
  return visit_shape<3>(
      body.shape,
      [&](const Core<3>& core) {
        return core.radius + glm::dot(core.half, glm::abs(core.turns ? local : along));
      },
      [](const HalfSpace<3>&) { return 0.0; });
}

bool is_ball(const BodySpec& body) { return std::holds_alternative<Sphere>(body.shape); }

bool turns(const BodySpec& body) { return body.may_turn && geometry::turns<3>(body.shape); }

double roundness(const Scenario& scenario) { return scenario.world.dimension == 3 ? 0.4 : 0.5; }

bool are_parallel(const Vec<3>& a, const Vec<3>& b) {
  return glm::length(glm::cross(a, b)) <= 1e-12 * glm::length(a) * glm::length(b);
}

MetricMaker metrics_of(const Scenario& scenario) {
  return row_of_problem(scenario).metrics(scenario);
}

void require_problem(const Scenario& scenario) {
  const Problem& problem = row_of_problem(scenario);
  if (problem.require)
    problem.require(scenario);
  else
    problem.metrics(scenario)();
}

std::vector<Norm> ErrorMetric::norms() const {
  std::vector<Norm> all;
  for (const Declared& one : norms_) {
    if (one.dropped) continue;
    all.push_back(one.norm);
    all.back().value = one.error.value();
  }
  return all;
}

std::string trajectory_meaning(double length, double speed) {
  return fmt::format(
      "largest distance from the reference over the run: |Δx| / {:.3g} units or |Δv| / {:.3g} "
      "units/s, whichever is larger{}",
      length, speed,
      std::abs(length - 1) + std::abs(speed - 1) < 1e-9 ? "; over 1, so that it is absolute" : "");
}

TrajectoryMetric::TrajectoryMetric(long double length, long double speed, ExactStates exact,
                                   std::string parameters)
    : length_(static_cast<double>(length)),
      speed_(static_cast<double>(speed)),
      exact_at_(std::move(exact)),
      parameters_(std::move(parameters)) {}

void TrajectoryMetric::look(const Observation& now) {
  exact_.clear();
  exact_at_(now.time, exact_);
  for (const Exact& e : exact_) {
    LANTERN_CHECK(e.body, <, now.states.size());
    const BodyState& state = now.states[e.body];
    if (!state.there) throw Refused("a body of the problem is not there");
    const double error = std::max(glm::length(state.position - e.position) / length_,
                                  glm::length(state.velocity - e.velocity) / speed_);
    const bool finite = std::isfinite(glm::dot(state.position, state.velocity));
    worst_.meet(finite ? error : std::numeric_limits<double>::quiet_NaN());
  }
}

}  // namespace lantern::measure
