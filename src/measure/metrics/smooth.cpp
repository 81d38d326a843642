// Bodies that never touch, each against its closed form.

#include "measure/metrics/reading.hpp"
#include "physics/body.hpp"

namespace lantern::measure {
namespace {

// A spring or rod as the engine makes it: between the centres of bodies, or a centre and a fixed
// point.
struct Tie {
  std::size_t a = 0;
  std::optional<std::size_t> b;  // a dynamic body; none: it ends at `anchor`
  LongVec anchor{0.0L};
  long double rest_length = 0;
};

// Refuses an end that is off a body's centre or on a kinematic body.
Tie read_tie(const Scenario& scenario, const LinkSpec& link) {
  Tie tie;
  tie.a = link.a;
  if (link.at_a != Vec<3>(0.0) || (link.b && link.at_b != Vec<3>(0.0)))
    refuse_problem(scenario, "a spring or rod does not end at its bodies' centres");
  Vec<3> end = link.at_b;
  if (link.b) {
    tie.b = link.b;
    end = scenario.bodies[*link.b].position;
    // The moving one first.
    if (scenario.bodies[tie.a].kind != BodyKind::dynamic_body) std::swap(tie.a, *tie.b);
    const BodySpec& other = scenario.bodies[*tie.b];
    if (other.kind == BodyKind::kinematic_body)
      refuse_problem(scenario, fmt::format("body '{}' is kinematic", other.name));
    if (other.kind == BodyKind::static_body) {
      end = other.position;
      tie.b.reset();
    }
  }
  if (scenario.bodies[tie.a].kind != BodyKind::dynamic_body)
    refuse_problem(scenario, "nothing moves on one of the springs or rods");
  tie.anchor = end;
  const Vec<3> other = tie.b ? scenario.bodies[*tie.b].position : end;
  tie.rest_length = link.rest_length
                        ? static_cast<long double>(*link.rest_length)
                        : glm::length(LongVec(other) - LongVec(scenario.bodies[tie.a].position));
  return tie;
}

// Whether both point along one line, exactly but for rounding; zero does with any.
bool parallel(const LongVec& a, const LongVec& b) {
  return glm::length(glm::cross(a, b)) <= 1e-15L * glm::length(a) * glm::length(b);
}

MetricMaker projectile_metric(const Scenario& scenario) {
  struct Flight {
    std::size_t body = 0;
    LongVec position{0.0L}, velocity{0.0L}, gravity{0.0L};
    long double rate = 0;

    void at(long double time, LongVec& way, LongVec& speed) const {
      for (int axis = 0; axis < 3; ++axis) {
        const auto [x, v] = exact_flight({0, velocity[axis]}, gravity[axis], rate, time);
        way[axis] = x;
        speed[axis] = v;
      }
    }
  };
  require_links(scenario, 0);
  require_nothing_else(scenario);
  std::vector<Flight> flights;
  for (const std::size_t i : dynamic_bodies(scenario)) {
    const BodySpec& body = scenario.bodies[i];
    flights.push_back({i, body.position, body.velocity, scenario.world.gravity,
                       body.linear_drag / static_cast<long double>(mass_of_body(scenario, i))});
  }
  if (flights.empty()) refuse_problem(scenario, "it has no dynamic body");
  long double length = 0, speed = 0;
  LongVec way, velocity;
  const int samples = static_cast<int>(scenario.problem->samples);
  for (const Flight& body : flights)
    for (int n = 0; n <= samples; ++n) {
      body.at(static_cast<long double>(scenario.problem->seconds) * n / samples, way, velocity);
      length = std::max(length, glm::length(way));
      speed = std::max(speed, glm::length(velocity));
    }
  if (!(length > 0)) refuse_problem(scenario, "nothing moves");
  return trajectories(length, speed, [flights](double time, auto& states) {
    for (const Flight& body : flights) {
      LongVec gone, now;
      body.at(time, gone, now);
      states.push_back({body.body, Vec<3>(body.position + gone), Vec<3>(now)});
    }
  });
}

// One body on one spring to a fixed point, under any damping: along a line, or, if the spring has
// no rest length and no damping, in any direction.
MetricMaker oscillator_metric(const Scenario& scenario) {
  const std::size_t body = the_body(scenario);
  require_links(scenario, 1);
  require_nothing_else(scenario);
  const LinkSpec& spring = scenario.links.front();
  if (spring.kind != LinkSpec::Kind::spring) refuse_problem(scenario, "it hangs on a spring");
  const Tie tie = read_tie(scenario, spring);
  const BodySpec& spec = scenario.bodies[body];
  const long double stiffness = spring.stiffness, mass = mass_of_body(scenario, body);
  const long double damping = static_cast<long double>(spring.damping) + spec.linear_drag;
  const LongVec gravity(scenario.world.gravity), start(spec.position), velocity(spec.velocity);
  const LongVec between = start - tie.anchor;
  LongVec line = between;
  if (line == LongVec(0.0L)) line = velocity;
  if (line == LongVec(0.0L)) line = gravity;
  if (line == LongVec(0.0L)) refuse_problem(scenario, "nothing moves");
  const bool straight = tie.rest_length > 0 || spring.damping > 0;
  if (straight && !(parallel(line, velocity) && parallel(line, gravity)))
    refuse_problem(scenario, "it must move along the line of its spring");
  const LongVec direction = line / glm::length(line);
  // Where it would come to rest, and how far from there it begins.
  const LongVec rest = tie.anchor + tie.rest_length * direction + gravity * (mass / stiffness);
  const LongVec away = start - rest;
  const long double omega = std::sqrt(stiffness / mass);
  const long double amplitude = std::hypot(glm::length(away), glm::length(velocity) / omega);
  if (tie.rest_length > 0 &&
      (between == LongVec(0.0L) || !(amplitude < glm::dot(rest - tie.anchor, direction))))
    refuse_problem(scenario, "it would pass through the spring's other end");
  if (!(amplitude > 0)) refuse_problem(scenario, "nothing moves");
  return trajectories(
      amplitude, amplitude * omega,
      [=](double time, auto& states) {
        LongVec x, v;
        for (int axis = 0; axis < 3; ++axis) {
          const Swing swing =
              exact_swing(stiffness, damping, mass, {away[axis], velocity[axis]}, time);
          x[axis] = rest[axis] + swing.x;
          v[axis] = swing.v;
        }
        states.push_back({body, Vec<3>(x), Vec<3>(v)});
      },
      fmt::format("undamped period {:.4g} s", static_cast<double>(2 * kPi / omega)));
}

// Two bodies about their common centre of mass, which flies straight on. One that is static stays,
// and is the centre.
MetricMaker kepler_metric(const Scenario& scenario) {
  require_links(scenario, 0);
  require_nothing_else(scenario, true);
  if (scenario.world.gravity != Vec<3>(0.0)) refuse_problem(scenario, "there is gravity, too");
  if (!(scenario.world.gravitation > 0)) refuse_problem(scenario, "[world] needs a `gravitation`");
  if (scenario.bodies.size() != 2)
    refuse_problem(scenario, fmt::format("it has two bodies, not {}", scenario.bodies.size()));
  const std::size_t ib = scenario.bodies[1].kind == BodyKind::static_body ? 0 : 1, ia = 1 - ib;
  const BodySpec &a = scenario.bodies[ia], &b = scenario.bodies[ib];
  if (b.kind != BodyKind::dynamic_body || a.kind == BodyKind::kinematic_body)
    refuse_problem(scenario, "one body must be dynamic, the other dynamic or static");
  if (a.linear_drag != 0 || b.linear_drag != 0) refuse_problem(scenario, "nothing may brake it");
  const bool a_moves = a.kind == BodyKind::dynamic_body;
  const long double mass_a = a_moves ? mass_of_body(scenario, ia) : a.mass;
  const long double mass_b = mass_of_body(scenario, ib);
  if (!(mass_a > 0)) refuse_problem(scenario, fmt::format("body '{}' needs a mass", a.name));
  const LongVec velocity_a(a_moves ? a.velocity : Vec<3>(0.0));
  const Orbit start{LongVec(b.position) - LongVec(a.position),  // of b from a
                    LongVec(b.velocity) - velocity_a};
  const long double mu = scenario.world.gravitation * (mass_a + (a_moves ? mass_b : 0));
  // Of the way between them that each lies from the centre.
  const long double share_a = a_moves ? mass_b / (mass_a + mass_b) : 0;
  const long double share_b = a_moves ? mass_a / (mass_a + mass_b) : 1;
  const LongVec centre = LongVec(a.position) + share_a * start.position;
  const LongVec drift = velocity_a + share_a * start.velocity;
  exact_orbit(mu, start, 0);  // refuses
  const long double axis = half_axis(mu, start);
  const LongVec turning = glm::cross(start.position, start.velocity);
  const long double eccentricity =
      std::sqrt(std::max(0.0L, 1 - glm::dot(turning, turning) / (mu * axis)));
  return trajectories(
      axis, std::sqrt(mu / axis),
      [=](double time, auto& states) {
        const Orbit now = exact_orbit(mu, start, time);
        const LongVec middle = centre + static_cast<long double>(time) * drift;
        const auto add = [&](std::size_t body, long double share) {
          states.push_back(
              {body, Vec<3>(middle + share * now.position), Vec<3>(drift + share * now.velocity)});
        };
        if (a_moves) add(ia, -share_a);
        add(ib, share_b);
      },
      fmt::format("eccentricity {:.3g}, period {:.4g} s", static_cast<double>(eccentricity),
                  static_cast<double>(2 * kPi * axis * std::sqrt(axis / mu))));
}

// The plane that it swings in: `side` is where the angle is positive.
//
//       anchor
//         |\                        .
//     down| \ length
//         |  \                      .
//         +---o-> side
struct Pendulum {
  std::size_t body = 0;
  LongVec anchor{0.0L}, down{0.0L}, side{0.0L};
  long double length = 1, omega = 1;
  PendulumState start;

  void at(double time, std::vector<TrajectoryMetric::Exact>& states) const {
    const PendulumState now = exact_pendulum(omega, start, time);
    const long double c = std::cos(now.angle), s = std::sin(now.angle);
    const LongVec velocity = length * now.speed * (c * side - s * down);
    states.push_back({body, Vec<3>(anchor + length * (c * down + s * side)), Vec<3>(velocity)});
  }
};

class PendulumMetric : public TrajectoryMetric {
 public:
  explicit PendulumMetric(const Pendulum& p)
      : TrajectoryMetric(p.length, p.length * p.omega,
                         [p](double time, auto& states) { p.at(time, states); }),
        p_(p) {}

  void look(const Observation& now) override {
    TrajectoryMetric::look(now);
    const LongVec rod = LongVec(now.states[p_.body].position) - p_.anchor;
    drift_.meet(static_cast<double>((glm::length(rod) - p_.length) / p_.length));
  }

 private:
  Pendulum p_;
  Worst& drift_ = norm("joint", "1", "largest change of the rod's length, relative");
};

class FreeTopMetric : public ErrorMetric {
 public:
  FreeTopMetric(std::size_t body, const FreeTop& top) : body_(body), top_(top) {}

  void look(const Observation& now) override {
    worst_.meet(angle_between(top_.orientation(now.time), now.states[body_]));
  }

 private:
  std::size_t body_;
  FreeTop top_;
  Worst& worst_ = norm("att", "rad", kAttitudeMeaning);
};

MetricMaker pendulum_metric(const Scenario& scenario) {
  Pendulum p;
  p.body = the_body(scenario);
  require_links(scenario, 1);
  require_nothing_else(scenario);
  const BodySpec& body = scenario.bodies[p.body];
  const LinkSpec& link = scenario.links.front();
  if (link.kind == LinkSpec::Kind::pin)
    refuse_problem(scenario, "its rod must have kind \"distance\"");
  if (body.linear_drag != 0 || link.damping != 0) refuse_problem(scenario, "nothing may brake it");
  const Tie tie = read_tie(scenario, link);
  const LongVec gravity(scenario.world.gravity), velocity(body.velocity);
  const LongVec rod = LongVec(body.position) - tie.anchor;
  const long double g = glm::length(gravity);
  p.length = tie.rest_length;
  p.anchor = tie.anchor;
  if (!(g > 0)) refuse_problem(scenario, "there is no gravity");
  if (!(std::abs(glm::length(rod) - p.length) <= 1e-12L * p.length))
    refuse_problem(scenario, "its rod must be as long as it is at first");
  p.down = gravity / g;
  p.omega = std::sqrt(g / p.length);
  // The plane is that of gravity and the rod; if the rod hangs straight down, of the velocity.
  LongVec side = rod - glm::dot(rod, p.down) * p.down;
  if (!(glm::length(side) > 1e-15L * p.length)) side = velocity;
  if (!(glm::length(side) > 0)) refuse_problem(scenario, "nothing moves");
  p.side = side / glm::length(side);
  const long double s = glm::dot(rod, p.side), c = glm::dot(rod, p.down);
  const LongVec tangent = (c * p.side - s * p.down) / p.length;
  p.start = {std::atan2(s, c), glm::dot(velocity, tangent) / p.length};
  if (!(glm::length(velocity - glm::dot(velocity, tangent) * tangent) <=
        1e-12L * glm::length(velocity)))
    refuse_problem(scenario, "its velocity must be across the rod, in the plane of gravity");
  exact_pendulum(p.omega, p.start, 0);  // refuses
  return [p] { return std::make_unique<PendulumMetric>(p); };
}

MetricMaker free_top_metric(const Scenario& scenario) {
  const std::size_t i = the_body(scenario);
  require_links(scenario, 0);
  require_nothing_else(scenario);
  const BodySpec& body = scenario.bodies[i];
  if (scenario.world.dimension != 3) refuse_problem(scenario, "the world must be solid");
  if (body.angular_drag != 0) refuse_problem(scenario, "nothing may brake it");
  if (!body.may_turn || !geometry::turns<3>(body.shape))
    refuse_problem(scenario, "its body cannot turn; give a box `oriented = true`");
  MassProperties<3> mass = mass_of<3>(body.shape, body.density);
  if (body.mass > 0) mass = scaled_to<3>(mass, body.mass);
  for (int axis = 0; axis < 3; ++axis)
    if (!(mass.inertia[axis] > 0)) refuse_problem(scenario, "its body has no extent");
  const Rotation<3> start = orientation_of(body);
  const LongQuat orientation = glm::normalize(LongQuat(start.q.w, start.q.x, start.q.y, start.q.z));
  const LongVec spin =
      glm::conjugate(orientation) * (LongVec(body.axis_of_spin()) * LongVec(body.spin));
  LongVec inverse, momentum;
  for (int axis = 0; axis < 3; ++axis) {
    inverse[axis] = 1 / mass.inertia[axis];  // in double, as the engine has it
    momentum[axis] = spin[axis] / inverse[axis];
  }
  return [i, top = FreeTop(inverse, orientation, momentum)] {
    return std::make_unique<FreeTopMetric>(i, top);
  };
}

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
  const auto first = std::ranges::find_if(bonds, [](const Bond& b) { return !b.tie.b; });
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
    bond = std::ranges::find_if(
        bonds, [&](const Bond& b) { return !b.used && (b.tie.a == at || b.tie.b == at); });
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
  const bool all = std::ranges::all_of(bonds, &Bond::used);
  if (!all || row.bodies.size() != dynamic_bodies(scenario).size())
    refuse_problem(scenario, "its bodies are not one row from a fixed point on");
  find_rest(scenario, end, row);
  read_motion(scenario, row);
  require_no_passing(scenario, row);
  return row;
}

void require_short_chain(const Scenario& scenario) {
  constexpr std::size_t kMostLinks = 1000;  // to follow a chain takes the square of their number
  if (scenario.links.size() <= kMostLinks) line_of(scenario);
}

// Bodies in a row between one or two fixed points, tied each to the next by springs without
// damping, moving along the row.
MetricMaker chain_metric(const Scenario& scenario) {
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
  return trajectories(length, speed, [=](double time, auto& states) {
    std::vector<long double> xs, vs;
    motion.at(time, xs, vs);
    for (std::size_t i = 0; i < row.bodies.size(); ++i)
      states.push_back({row.bodies[i], Vec<3>(row.from + (row.rest[i] + xs[i]) * row.direction),
                        Vec<3>(vs[i] * row.direction)});
  });
}

}  // namespace

std::span<const Problem> smooth_problems() {
  static constexpr Problem kAll[] = {{Solution::projectile, projectile_metric},
                                     {Solution::oscillator, oscillator_metric},
                                     {Solution::chain, chain_metric, require_short_chain},
                                     {Solution::kepler, kepler_metric},
                                     {Solution::pendulum, pendulum_metric},
                                     {Solution::free_top, free_top_metric}};
  return kAll;
}

}  // namespace lantern::measure
