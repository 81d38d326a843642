// Balls that are thrown along level ground without spin. Friction brakes them and makes them turn,
// until they roll. With inertia k m r^2 (k = 2/5, of a disc 1/2) they slip at first with v, and
//
//   slip(t) = v - (1 + 1/k) mu g t       so it rolls at t = k/(1+k) v/(mu g) = 2/7 v/(mu g)
//                                        with v/(1+k) = 5/7 v, for ever
#include <fmt/format.h>

#include "measure/error_metrics.hpp"
#include "measure/problem_scene.hpp"

namespace lantern {
namespace {

class SlipThenRoll : public ErrorMetric {
 public:
  explicit SlipThenRoll(const Scenario& scenario)
      : ground_(ground_of(scenario)), k_(roundness(scenario)) {
    require_links(scenario, 0);
    const double gravity = pull_onto(scenario, ground_);
    for (const std::size_t i : moving_bodies(scenario)) {
      const BodySpec& body = scenario.bodies[i];
      require_on_ground(scenario, ground_, i);
      if (!is_ball(body) || !turns(body) || body.spin != 0)
        refuse_problem(scenario, fmt::format("'{}' is no ball that begins to turn", body.name));
      const double speed = glm::length(body.velocity);
      if (!(speed > 0) || std::abs(glm::dot(body.velocity, ground_.normal)) > 1e-12 * speed)
        refuse_problem(scenario, fmt::format("'{}' does not go along the ground", body.name));
      const double mu = friction_between(scenario, i, ground_.body);
      if (!(mu > 0)) refuse_problem(scenario, fmt::format("'{}' has no friction", body.name));
      balls_.push_back({i, body.position, body.velocity / speed, speed, mu * gravity,
                        reach_along(body, ground_.normal)});
      if (rolls_after(balls_.back()) > scenario.problem->seconds)
        refuse_problem(scenario, fmt::format("'{}' still slips at the end", body.name));
    }
  }

  void look(const Observation& now) override {
    for (const Ball& ball : balls_) {
      const BodyState& state = now.states[ball.body];
      const double rolls = rolls_after(ball);
      const double slipping = std::min(now.time, rolls), rolling = now.time - slipping;
      const double end_speed = ball.speed / (1 + k_);
      const double slid = ball.speed * slipping - ball.braking * slipping * slipping / 2;
      const double speed = ball.speed - ball.braking * slipping;
      const double way_until_rolls = rolls * (ball.speed + end_speed) / 2;
      distance_.meet(
          glm::length(state.position - ball.start - ball.heading * (slid + end_speed * rolling)) /
          way_until_rolls);
      speed_.meet(glm::length(state.velocity - ball.heading * speed) / ball.speed);
      const Vec<3> touching =
          state.velocity + glm::cross(state.angular_velocity, -ball.radius * ground_.normal);
      const double slip = glm::dot(touching, ball.heading);
      const double end = now.time + slip / (ball.braking * (1 + 1 / k_));
      const bool slips = std::abs(slip) > kStill * ball.speed || !std::isfinite(slip);
      if (slips || now.time < rolls) time_.meet((end - rolls) / rolls);
    }
  }

  std::vector<Norm> norms() const override {
    return {
        {"distance", distance_.value(), "1",
         "largest error of a place over the run, over the distance slipped"},
        {"time", time_.value(), "1", "largest error of the moment from which it rolls, relative"},
        {"v", speed_.value(), "1", "largest error of a velocity, over the first speed"}};
  }

 private:
  static constexpr double kStill = 1e-6;  // of its first speed: so little slip is none

  struct Ball {
    std::size_t body = 0;
    Vec<3> start{0.0}, heading{0.0};
    double speed = 0, braking = 0, radius = 0;  // braking: mu g
  };

  double rolls_after(const Ball& ball) const { return k_ / (1 + k_) * ball.speed / ball.braking; }

  Footing ground_;
  double k_;
  std::vector<Ball> balls_;
  Worst distance_, time_, speed_;
};

}  // namespace

std::unique_ptr<ErrorMetric> slip_then_roll_metric(const Scenario& scenario) {
  return std::make_unique<SlipThenRoll>(scenario);
}

}  // namespace lantern
