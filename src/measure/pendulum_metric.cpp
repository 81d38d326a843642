#include <algorithm>
#include <cmath>

#include "measure/closed_forms.hpp"
#include "measure/error_metrics.hpp"
#include "measure/problem_scene.hpp"

namespace lantern {
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
  LongVec3 anchor{0.0L}, down{0.0L}, side{0.0L};
  long double length = 1, omega = 1;
  PendulumState start;
};

class PendulumMetric : public TrajectoryMetric {
 public:
  explicit PendulumMetric(const Pendulum& p)
      : TrajectoryMetric(p.length, p.length * p.omega, exact_of(p)), p_(p) {}

  void look(const Observation& now) override {
    TrajectoryMetric::look(now);
    const LongVec3 rod = LongVec3(now.states[p_.body].position) - p_.anchor;
    const auto off = static_cast<double>(std::abs(glm::length(rod) - p_.length) / p_.length);
    if (off > drift_) drift_ = off;
  }
  std::vector<Norm> norms() const override {
    std::vector<Norm> all = TrajectoryMetric::norms();
    all.push_back({"joint", drift_, "1", "largest change of the rod's length, relative"});
    return all;
  }

 private:
  static ExactStates exact_of(const Pendulum& p) {
    return [p](double time, std::vector<Exact>& states) {
      const PendulumState now = exact_pendulum(p.omega, p.start, time);
      const long double c = std::cos(now.angle), s = std::sin(now.angle);
      const LongVec3 rod = p.length * (c * p.down + s * p.side);
      const LongVec3 velocity = p.length * now.speed * (c * p.side - s * p.down);
      states.push_back({p.body, Vec<3>(p.anchor + rod), Vec<3>(velocity)});
    };
  }

  Pendulum p_;
  double drift_ = 0;
};

}  // namespace

std::unique_ptr<ErrorMetric> pendulum_metric(const Scenario& scenario) {
  Pendulum p;
  p.body = the_body(scenario);
  require_links(scenario, 1);
  const BodySpec& body = scenario.bodies[p.body];
  const LinkSpec& link = scenario.links.front();
  if (link.kind == LinkSpec::Kind::pin) refuse_problem(scenario, "its rod has kind \"distance\"");
  if (body.linear_drag != 0 || link.damping != 0) refuse_problem(scenario, "nothing may brake it");
  const Tie tie = read_tie(scenario, link);
  const LongVec3 gravity(scenario.world.gravity), velocity(body.velocity);
  const LongVec3 rod = LongVec3(body.position) - tie.anchor;
  const long double g = glm::length(gravity);
  p.length = tie.rest_length;
  p.anchor = tie.anchor;
  if (!(g > 0)) refuse_problem(scenario, "there is no gravity");
  if (!(std::abs(glm::length(rod) - p.length) <= 1e-12L * p.length))
    refuse_problem(scenario, "its rod must be as long as it is at first");
  p.down = gravity / g;
  p.omega = std::sqrt(g / p.length);
  // The plane is that of gravity and the rod; if the rod hangs straight down, of the velocity.
  LongVec3 side = rod - glm::dot(rod, p.down) * p.down;
  if (!(glm::length(side) > 1e-15L * p.length)) side = velocity;
  if (!(glm::length(side) > 0)) refuse_problem(scenario, "nothing moves");
  p.side = side / glm::length(side);
  const long double s = glm::dot(rod, p.side), c = glm::dot(rod, p.down);
  const LongVec3 tangent = (c * p.side - s * p.down) / p.length;
  p.start = {std::atan2(s, c), glm::dot(velocity, tangent) / p.length};
  if (!(glm::length(velocity - glm::dot(velocity, tangent) * tangent) <=
        1e-12L * glm::length(velocity)))
    refuse_problem(scenario, "its velocity must be across the rod, in the plane of gravity");
  exact_pendulum(p.omega, p.start, 0);  // refuses
  return std::make_unique<PendulumMetric>(p);
}

}  // namespace lantern
