#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "measure/closed_forms.hpp"
#include "measure/error_metrics.hpp"
#include "measure/problem_scene.hpp"

namespace lantern {
namespace {

struct Thrown {
  std::size_t body = 0;
  LongVec3 position{0.0L};
  LongVec3 velocity{0.0L};
  long double rate = 0;
};

struct Flight {
  std::vector<Thrown> bodies;
  LongVec3 gravity{0.0L};

  void at(std::size_t i, long double time, LongVec3& way, LongVec3& velocity) const {
    for (int axis = 0; axis < 3; ++axis) {
      const FlightState state =
          exact_flight({0, bodies[i].velocity[axis]}, gravity[axis], bodies[i].rate, time);
      way[axis] = state.position;
      velocity[axis] = state.velocity;
    }
  }
};

}  // namespace

std::unique_ptr<ErrorMetric> projectile_metric(const Scenario& scenario) {
  require_links(scenario, 0);
  Flight flight;
  flight.gravity = scenario.world.gravity;
  for (const std::size_t i : dynamic_bodies(scenario)) {
    const BodySpec& body = scenario.bodies[i];
    const long double mass = mass_of_body(scenario, i);
    flight.bodies.push_back({i, body.position, body.velocity, body.linear_drag / mass});
  }
  if (flight.bodies.empty()) refuse_problem(scenario, "it has no dynamic body");
  long double length = 0, speed = 0;
  const int samples = static_cast<int>(scenario.problem->samples);
  for (std::size_t i = 0; i < flight.bodies.size(); ++i) {
    for (int n = 0; n <= samples; ++n) {
      LongVec3 way, velocity;
      flight.at(i, static_cast<long double>(scenario.problem->seconds) * n / samples, way,
                velocity);
      length = std::max(length, glm::length(way));
      speed = std::max(speed, glm::length(velocity));
    }
  }
  if (!(length > 0)) refuse_problem(scenario, "nothing moves");
  return std::make_unique<TrajectoryMetric>(length, speed, [flight](double time, auto& states) {
    for (std::size_t i = 0; i < flight.bodies.size(); ++i) {
      LongVec3 way, velocity;
      flight.at(i, time, way, velocity);
      states.push_back(
          {flight.bodies[i].body, Vec<3>(flight.bodies[i].position + way), Vec<3>(velocity)});
    }
  });
}

}  // namespace lantern
