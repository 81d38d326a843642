#include <cmath>

#include <fmt/format.h>

#include "measure/closed_forms.hpp"
#include "measure/error_metrics.hpp"
#include "measure/problem_scene.hpp"

namespace lantern {
namespace {

// Two bodies about their common centre of mass, which flies straight on. One that is static stays,
// and is the centre.
struct Couple {
  std::size_t a = 0, b = 0;
  bool a_moves = true;
  long double share_a = 0, share_b = 1;  // of the way between them that each lies from the centre
  long double mu = 1;
  LongVec3 centre{0.0L}, drift{0.0L};
  Orbit start;  // of b from a
};

}  // namespace

std::unique_ptr<ErrorMetric> kepler_metric(const Scenario& scenario) {
  require_links(scenario, 0);
  if (scenario.world.gravity != Vec<3>(0.0)) refuse_problem(scenario, "there is no other gravity");
  if (!(scenario.world.gravitation > 0)) refuse_problem(scenario, "[world] needs a `gravitation`");
  if (scenario.bodies.size() != 2)
    refuse_problem(scenario, fmt::format("it has two bodies, not {}", scenario.bodies.size()));
  Couple c;
  c.a = 0;
  c.b = 1;
  if (scenario.bodies[c.b].kind == BodyKind::static_body) std::swap(c.a, c.b);
  const BodySpec &a = scenario.bodies[c.a], &b = scenario.bodies[c.b];
  if (b.kind != BodyKind::dynamic_body || a.kind == BodyKind::kinematic_body)
    refuse_problem(scenario, "one body is dynamic, the other dynamic or static");
  if (a.linear_drag != 0 || b.linear_drag != 0) refuse_problem(scenario, "nothing may brake it");
  c.a_moves = a.kind == BodyKind::dynamic_body;
  const long double mass_a = c.a_moves ? mass_of_body(scenario, c.a) : a.mass;
  const long double mass_b = mass_of_body(scenario, c.b);
  if (!(mass_a > 0)) refuse_problem(scenario, fmt::format("body '{}' needs a mass", a.name));
  const LongVec3 velocity_a(c.a_moves ? a.velocity : Vec<3>(0.0));
  c.start = {LongVec3(b.position) - LongVec3(a.position), LongVec3(b.velocity) - velocity_a};
  c.mu = scenario.world.gravitation * (mass_a + (c.a_moves ? mass_b : 0));
  if (c.a_moves) {
    c.share_a = mass_b / (mass_a + mass_b);
    c.share_b = mass_a / (mass_a + mass_b);
  }
  c.centre = LongVec3(a.position) + c.share_a * c.start.position;
  c.drift = velocity_a + c.share_a * c.start.velocity;
  exact_orbit(c.mu, c.start, 0);  // refuses
  const long double axis = half_axis(c.mu, c.start);
  return std::make_unique<TrajectoryMetric>(
      axis, std::sqrt(c.mu / axis), [c](double time, auto& states) {
        const Orbit now = exact_orbit(c.mu, c.start, time);
        const LongVec3 centre = c.centre + static_cast<long double>(time) * c.drift;
        const auto add = [&](std::size_t body, long double share) {
          states.push_back({body, Vec<3>(centre + share * now.position),
                            Vec<3>(c.drift + share * now.velocity)});
        };
        if (c.a_moves) add(c.a, -c.share_a);
        add(c.b, c.share_b);
      });
}

}  // namespace lantern
