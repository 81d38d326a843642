// What rolls and slides on a plate that slides itself.
#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "measure/error_metrics.hpp"

namespace lantern::measure {
namespace {

// A plate on level or sloping ground, which is pulled, and balls and boxes on it, all along one
// line and from rest. With gravity g along it, and N = m g across, a rider takes from the plate
//
//   f = c m (A - g)     while it sticks: c = 1 of a box; k/(1 + k) of what rolls, inertia k m r^2
//   f = mu N            else
//   M A = F + M g - mu0 (M + sum of m) g across - sum of f
//
// so that everything goes by a constant acceleration.
struct Slide1D {
  double pull = 0;             // F, N
  double along = 0;            // gravity along the line, units a second²
  double across = 0;           // and onto the ground
  double mass = 0, rough = 0;  // M, mu0
};

struct Rider {
  std::size_t body = 0;
  double mass = 0, share = 1, rough = 0;  // m, c, mu
  bool slips = false;
  double acceleration = 0;
};

double plate_acceleration(const Slide1D& plate, const std::vector<Rider>& riders) {
  double force = plate.pull + plate.mass * plate.along, inertia = plate.mass, load = plate.mass;
  for (const Rider& r : riders) {
    load += r.mass;
    if (r.slips) force -= r.rough * r.mass * plate.across;
    if (!r.slips) force += r.share * r.mass * plate.along;
    if (!r.slips) inertia += r.share * r.mass;
  }
  return (force - plate.rough * load * plate.across) / inertia;
}

// Gives A, and each rider its own. Whoever would need more friction than there is slips; that
// quickens the plate, so that the next may slip, too.
double settle(const Slide1D& plate, std::vector<Rider>& riders) {
  for (;;) {
    const double plate_goes = plate_acceleration(plate, riders);
    bool changed = false;
    for (Rider& r : riders) {
      const double needs = r.share * (plate_goes - plate.along);
      if (r.slips || needs <= r.rough * plate.across) continue;
      r.slips = changed = true;
    }
    if (changed) continue;
    for (Rider& r : riders)
      r.acceleration =
          plate.along + (r.slips ? r.rough * plate.across : r.share * (plate_goes - plate.along));
    return plate_goes;
  }
}

class BallOnPlate : public ErrorMetric {
 public:
  explicit BallOnPlate(const Scenario& scenario) : ground_(ground_of(scenario)) {
    require_links(scenario, 0);
    Slide1D plate;
    const std::size_t below = find_plate(scenario);
    heading_ = line_of(scenario, below, plate);
    plate.mass = mass_of_body(scenario, below);
    plate.rough = friction_between(scenario, below, ground_.body);
    std::vector<Rider> riders;
    for (const std::size_t i : moving_bodies(scenario)) {
      require_at_rest(scenario, i);
      if (i != below) riders.push_back(rider(scenario, i, below));
    }
    const double goes = settle(plate, riders);
    if (!(goes > 0)) refuse_problem(scenario, "its plate does not move");
    moving_.push_back({below, scenario.bodies[below].position, goes});
    for (const Rider& r : riders)
      moving_.push_back({r.body, scenario.bodies[r.body].position, r.acceleration});
    scale_ = goes;
    seconds_ = scenario.problem->seconds;
  }

  void look(const Observation& now) override {
    for (const Moving& m : moving_) {
      const BodyState& state = now.states[m.body];
      const Vec<3> way = heading_ * (m.acceleration * now.time * now.time / 2);
      const Vec<3> velocity = heading_ * (m.acceleration * now.time);
      velocity_.meet(glm::length(state.velocity - velocity) / (scale_ * seconds_));
      place_.meet(glm::length(state.position - m.start - way) / (scale_ * seconds_ * seconds_ / 2));
    }
  }

  std::vector<Norm> norms() const override {
    return {{"v", velocity_.value(), "1",
             "largest error of a velocity over the run, over the plate's at the end"},
            {"place", place_.value(), "1",
             "largest error of a place over the run, over the plate's way"}};
  }

 private:
  struct Moving {
    std::size_t body = 0;
    Vec<3> start{0.0};
    double acceleration = 0;
  };

  // The lowest box.
  std::size_t find_plate(const Scenario& scenario) const {
    const std::vector<std::size_t> bodies = moving_bodies(scenario);
    const auto height = [&](std::size_t i) {
      return glm::dot(scenario.bodies[i].position, ground_.normal);
    };
    const std::size_t lowest = *std::ranges::min_element(bodies, {}, height);
    require_on_ground(scenario, ground_, lowest);
    if (is_ball(scenario.bodies[lowest])) refuse_problem(scenario, "it has no plate");
    return lowest;
  }

  // Along gravity and the forces that its script begins with, which must pull the plate.
  Vec<3> line_of(const Scenario& scenario, std::size_t plate, Slide1D& forces) const {
    Vec<3> pull(0.0);
    for (const Step& step : scenario.steps) {
      if (const auto* push = std::get_if<ApplyForce>(&step.verb)) {
        if (push->body != plate) refuse_problem(scenario, "its force does not pull the plate");
        pull += push->force;
      }
      if (traits_of(step.verb).passes_time) break;
    }
    const Vec<3>& gravity = scenario.world.gravity;
    forces.across = -glm::dot(gravity, ground_.normal);
    const Vec<3> along = gravity + ground_.normal * forces.across;
    const Vec<3> sum = pull + along;
    if (!(forces.across > 0) || !(glm::length(sum) > 0) ||
        std::abs(glm::dot(pull, ground_.normal)) > 1e-12 * glm::length(pull) ||
        !are_parallel(pull, sum) || !are_parallel(along, sum))
      refuse_problem(scenario, "nothing pulls the plate along one line");
    const Vec<3> heading = sum / glm::length(sum);
    forces.pull = glm::dot(pull, heading);
    forces.along = glm::dot(along, heading);
    return heading;
  }

  Rider rider(const Scenario& scenario, std::size_t index, std::size_t plate) const {
    const BodySpec &body = scenario.bodies[index], &below = scenario.bodies[plate];
    const double gap = glm::dot(body.position - below.position, ground_.normal) -
                       reach_along(body, ground_.normal) - reach_along(below, ground_.normal);
    if (std::abs(gap) > 1e-9 * reach_along(body, ground_.normal))
      refuse_problem(scenario, fmt::format("'{}' does not lie on the plate", body.name));
    const bool rolls = is_ball(body) && turns(body);
    const double k = roundness(scenario);
    return {index, mass_of_body(scenario, index), rolls ? k / (1 + k) : 1,
            friction_between(scenario, index, plate)};
  }

  Footing ground_;
  Vec<3> heading_{0.0};
  std::vector<Moving> moving_;
  double scale_ = 1, seconds_ = 1;
  Worst velocity_, place_;
};

}  // namespace

OwnMetric ball_on_plate_metric(const Scenario& s) { return std::make_unique<BallOnPlate>(s); }

}  // namespace lantern::measure
