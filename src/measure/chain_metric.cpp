#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "measure/error_metrics.hpp"

namespace lantern::measure {
namespace {

// In order from the first fixed point on.
struct Line {
  std::vector<std::size_t> bodies;
  std::vector<long double> masses, rest, velocities, displacements;  // rest: from the first point
  std::vector<long double> stiffnesses, lengths;                     // of springs, unstretched
  LongVec from{0.0L}, direction{0.0L};
};

struct Bond {
  Tie tie;
  long double stiffness = 0;
  bool used = false;
};

std::vector<Bond> read_bonds(const Scenario& scenario) {
  std::vector<Bond> bonds;
  for (const LinkSpec& link : scenario.links) {
    if (link.kind != LinkSpec::Kind::spring) refuse_problem(scenario, "it has a joint");
    if (link.damping != 0) refuse_problem(scenario, "a spring has damping");
    bonds.push_back({read_tie(scenario, link), link.stiffness});
  }
  return bonds;
}

// Follows the springs from a fixed point to the other, or to a free end. Gives the last point.
std::optional<LongVec> follow(const Scenario& scenario, std::vector<Bond>& bonds, Line& row) {
  const auto first =
      std::find_if(bonds.begin(), bonds.end(), [](const Bond& b) { return !b.tie.b; });
  if (first == bonds.end()) refuse_problem(scenario, "no end of it is fixed");
  row.from = first->tie.anchor;
  std::size_t at = first->tie.a;
  for (auto bond = first; bond != bonds.end();) {
    bond->used = true;
    row.stiffnesses.push_back(bond->stiffness);
    row.lengths.push_back(bond->tie.rest_length);
    if (bond != first && !bond->tie.b) return bond->tie.anchor;
    if (bond != first) at = bond->tie.a == at ? *bond->tie.b : bond->tie.a;
    row.bodies.push_back(at);
    bond = std::find_if(bonds.begin(), bonds.end(),
                        [&](const Bond& b) { return !b.used && (b.tie.a == at || b.tie.b == at); });
  }
  return std::nullopt;
}

// Where the bodies come to rest: all springs pull alike, and not at all if one end is free.
void find_rest(const Scenario& scenario, const std::optional<LongVec>& end, Line& row) {
  const LongVec first(scenario.bodies[row.bodies.front()].position);
  const LongVec line = (end ? *end : first) - row.from;
  if (!(glm::length(line) > 0)) refuse_problem(scenario, "its ends coincide");
  row.direction = line / glm::length(line);
  long double tension = 0, loose = 0, give = 0;
  for (std::size_t i = 0; i < row.lengths.size(); ++i) {
    loose += row.lengths[i];
    give += 1 / row.stiffnesses[i];
  }
  if (end) tension = (glm::length(line) - loose) / give;
  long double place = 0;
  for (std::size_t i = 0; i < row.bodies.size(); ++i) {
    place += row.lengths[i] + tension / row.stiffnesses[i];
    row.rest.push_back(place);
  }
}

void read_motion(const Scenario& scenario, Line& row) {
  for (std::size_t i = 0; i < row.bodies.size(); ++i) {
    const BodySpec& body = scenario.bodies[row.bodies[i]];
    const LongVec position = LongVec(body.position) - row.from, velocity(body.velocity);
    const LongVec aside = position - glm::dot(position, row.direction) * row.direction;
    if (glm::length(aside) > 1e-12L * glm::length(position) || !parallel(velocity, row.direction))
      refuse_problem(scenario, fmt::format("body '{}' does not move along the row", body.name));
    if (body.linear_drag != 0) refuse_problem(scenario, "nothing may brake it");
    row.masses.push_back(mass_of_body(scenario, row.bodies[i]));
    row.displacements.push_back(glm::dot(position, row.direction) - row.rest[i]);
    row.velocities.push_back(glm::dot(velocity, row.direction));
  }
}

// A spring with a rest length is linear as long as its ends do not pass each other. The energy of
// the motion, were it all in one spring, bounds how far they go.
void require_no_passing(const Scenario& scenario, const Line& row) {
  long double energy = 0, before = 0, place = 0;
  for (std::size_t i = 0; i < row.stiffnesses.size(); ++i) {
    const bool body = i < row.bodies.size();
    const long double now = body ? row.displacements[i] : 0;
    energy += row.stiffnesses[i] * (now - before) * (now - before) / 2;
    if (body) energy += row.masses[i] * row.velocities[i] * row.velocities[i] / 2;
    before = now;
  }
  for (std::size_t i = 0; i < row.bodies.size(); ++i) {
    const long double length = row.rest[i] - place;
    place = row.rest[i];
    if (row.lengths[i] > 0 && !(std::sqrt(2 * energy / row.stiffnesses[i]) < length))
      refuse_problem(scenario, fmt::format("bodies may pass each other at spring {}", i + 1));
  }
}

Line line_of(const Scenario& scenario) {
  if (scenario.world.gravity != Vec<3>(0.0)) refuse_problem(scenario, "there is gravity");
  require_nothing_else(scenario);
  std::vector<Bond> bonds = read_bonds(scenario);
  Line row;
  const std::optional<LongVec> end = follow(scenario, bonds, row);
  const bool all = std::all_of(bonds.begin(), bonds.end(), [](const Bond& b) { return b.used; });
  if (!all || row.bodies.size() != dynamic_bodies(scenario).size())
    refuse_problem(scenario, "its bodies are not one row from a fixed point on");
  find_rest(scenario, end, row);
  read_motion(scenario, row);
  require_no_passing(scenario, row);
  return row;
}

}  // namespace

void require_chain(const Scenario& scenario) { line_of(scenario); }

OwnMetric chain_metric(const Scenario& scenario) {
  const Line row = line_of(scenario);
  ChainMotion motion(row.masses, row.stiffnesses, row.displacements, row.velocities);
  long double length = 0, speed = 0;
  const int samples = static_cast<int>(std::min(scenario.problem->samples, 20u));
  std::vector<long double> x, v;
  for (int n = 0; n <= samples; ++n) {
    motion.at(static_cast<long double>(scenario.problem->seconds) * n / samples, x, v);
    for (std::size_t i = 0; i < x.size(); ++i) {
      length = std::max(length, std::abs(x[i]));
      speed = std::max(speed, std::abs(v[i]));
    }
  }
  if (!(length > 0 && speed > 0)) refuse_problem(scenario, "nothing moves");
  return std::make_unique<TrajectoryMetric>(length, speed, [=](double time, auto& states) {
    std::vector<long double> xs, vs;
    motion.at(time, xs, vs);
    for (std::size_t i = 0; i < row.bodies.size(); ++i)
      states.push_back({row.bodies[i], Vec<3>(row.from + (row.rest[i] + xs[i]) * row.direction),
                        Vec<3>(vs[i] * row.direction)});
  });
}

}  // namespace lantern::measure
