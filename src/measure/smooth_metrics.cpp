// Bodies that never touch, each against its closed form.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "measure/error_metrics.hpp"
#include "physics/mass.hpp"

namespace lantern::measure {

OwnMetric projectile_metric(const Scenario& scenario) {
  struct Thrown {
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
  std::vector<Thrown> flights;
  for (const std::size_t i : dynamic_bodies(scenario)) {
    const BodySpec& body = scenario.bodies[i];
    flights.push_back({i, body.position, body.velocity, scenario.world.gravity,
                       body.linear_drag / static_cast<long double>(mass_of_body(scenario, i))});
  }
  if (flights.empty()) refuse_problem(scenario, "it has no dynamic body");
  long double length = 0, speed = 0;
  LongVec way, velocity;
  const int samples = static_cast<int>(scenario.problem->samples);
  for (const Thrown& body : flights)
    for (int n = 0; n <= samples; ++n) {
      body.at(static_cast<long double>(scenario.problem->seconds) * n / samples, way, velocity);
      length = std::max(length, glm::length(way));
      speed = std::max(speed, glm::length(velocity));
    }
  if (!(length > 0)) refuse_problem(scenario, "nothing moves");
  return std::make_unique<TrajectoryMetric>(length, speed, [flights](double time, auto& states) {
    for (const Thrown& body : flights) {
      LongVec gone, now;
      body.at(time, gone, now);
      states.push_back({body.body, Vec<3>(body.position + gone), Vec<3>(now)});
    }
  });
}

OwnMetric oscillator_metric(const Scenario& scenario) {
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
  return std::make_unique<
      TrajectoryMetric>(amplitude, amplitude * omega, [=](double time, auto& states) {
    LongVec x, v;
    for (int axis = 0; axis < 3; ++axis) {
      const Swing swing = exact_swing(stiffness, damping, mass, {away[axis], velocity[axis]}, time);
      x[axis] = rest[axis] + swing.x;
      v[axis] = swing.v;
    }
    states.push_back({body, Vec<3>(x), Vec<3>(v)});
  });
}

// Two bodies about their common centre of mass, which flies straight on. One that is static stays,
// and is the centre.
OwnMetric kepler_metric(const Scenario& scenario) {
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
  return std::make_unique<TrajectoryMetric>(
      axis, std::sqrt(mu / axis), [=](double time, auto& states) {
        const Orbit now = exact_orbit(mu, start, time);
        const LongVec middle = centre + static_cast<long double>(time) * drift;
        const auto add = [&](std::size_t body, long double share) {
          states.push_back(
              {body, Vec<3>(middle + share * now.position), Vec<3>(drift + share * now.velocity)});
        };
        if (a_moves) add(ia, -share_a);
        add(ib, share_b);
      });
}

namespace {

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
    const auto off = static_cast<double>(std::abs(glm::length(rod) - p_.length) / p_.length);
    if (off > drift_) drift_ = off;
  }
  std::vector<Norm> norms() const override {
    std::vector<Norm> all = TrajectoryMetric::norms();
    all.push_back({"joint", drift_, "1", "largest change of the rod's length, relative"});
    return all;
  }

 private:
  Pendulum p_;
  double drift_ = 0;
};

class FreeTopMetric : public ErrorMetric {
 public:
  FreeTopMetric(std::size_t body, const FreeTop& top) : body_(body), top_(top) {}

  void look(const Observation& now) override {
    const glm::dquat q = now.states[body_].orientation.q;
    const LongQuat off = glm::conjugate(top_.orientation(now.time)) * LongQuat(q.w, q.x, q.y, q.z);
    // The angle of a turn, whatever the quaternion's sign and length.
    worst_.meet(static_cast<double>(
        2 * std::atan2(std::sqrt(off.x * off.x + off.y * off.y + off.z * off.z), std::abs(off.w))));
  }
  std::vector<Norm> norms() const override {
    return {{"att", worst_.value(), "rad",
             "largest angle over the run by which the orientation is off"}};
  }

 private:
  std::size_t body_;
  FreeTop top_;
  Worst worst_;
};

}  // namespace

OwnMetric pendulum_metric(const Scenario& scenario) {
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
  return std::make_unique<PendulumMetric>(p);
}

OwnMetric free_top_metric(const Scenario& scenario) {
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
  return std::make_unique<FreeTopMetric>(i, FreeTop(inverse, orientation, momentum));
}

}  // namespace lantern::measure
