// Bodies that are thrown along level ground.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "measure/error_metrics.hpp"

namespace lantern::measure {
namespace {

// Blocks that slide over level ground until friction has stopped them: after v / (mu g) seconds and
// v^2 / (2 mu g) units, straight on, whatever their heading.
class Slide : public ErrorMetric {
 public:
  explicit Slide(const Scenario& scenario) : ground_(ground_of(scenario)) {
    require_links(scenario, 0);
    const double gravity = pull_onto(scenario, ground_);
    for (const std::size_t i : moving_bodies(scenario)) {
      const BodySpec& body = scenario.bodies[i];
      require_on_ground(scenario, ground_, i);
      const double speed = glm::length(body.velocity);
      if (!(speed > 0) || std::abs(glm::dot(body.velocity, ground_.normal)) > 1e-12 * speed)
        refuse_problem(scenario, fmt::format("'{}' does not slide along the ground", body.name));
      const double mu = friction_between(scenario, i, ground_.body);
      if (!(mu > 0)) refuse_problem(scenario, fmt::format("'{}' has no friction", body.name));
      const Vec<3> heading = body.velocity / speed;
      if (turns(body) &&
          (is_ball(body) || mu * reach_along(body, ground_.normal) > reach_along(body, heading)))
        refuse_problem(scenario, fmt::format("'{}' would roll or topple", body.name));
      sliders_.push_back({i, body.position, heading, speed, mu * gravity});
      if (sliders_.back().time() > scenario.problem->seconds)
        refuse_problem(scenario, fmt::format("'{}' still slides at the end", body.name));
    }
  }

  void look(const Observation& now) override {
    double most = 0, least = 0;
    for (const Slider& s : sliders_) {
      const BodyState& state = now.states[s.body];
      const double along = glm::dot(state.velocity, s.heading);
      const Vec<3> way = state.position - s.start;
      // Where it will stop, and when, if friction goes on as it should.
      const double ahead = along * std::abs(along) / (2 * s.braking);
      const Vec<3> off = way + s.heading * ahead - s.heading * s.distance();
      const double error = glm::length(off - ground_.normal * glm::dot(off, ground_.normal));
      distance_.meet(error / s.distance());
      const bool slides = std::abs(along) > kStill * s.speed || !std::isfinite(along);
      const double end = now.time + along / s.braking;
      if (slides || now.time < s.time()) time_.meet((end - s.time()) / s.time());
      const double share = (glm::dot(way, s.heading) + ahead) / s.distance();
      most = &s == &sliders_.front() ? share : std::max(most, share);
      least = &s == &sliders_.front() ? share : std::min(least, share);
    }
    apart_.meet(most - least);
  }

  std::vector<Norm> norms() const override {
    std::vector<Norm> all{
        {"distance", distance_.value(), "1",
         "largest error of the place where a body stops, or by its speed would stop, over the "
         "distance to there"},
        {"time", time_.value(), "1", "largest error of the moment at which it stops, relative"}};
    if (sliders_.size() > 1)
      all.push_back({"agree", apart_.value(), "1",
                     "largest difference between the bodies' distances, relative"});
    return all;
  }

 private:
  static constexpr double kStill = 1e-6;  // of its first speed: so slow is stopped

  struct Slider {
    std::size_t body = 0;
    Vec<3> start{0.0}, heading{0.0};
    double speed = 0, braking = 0;  // mu g
    double time() const { return speed / braking; }
    double distance() const { return speed * speed / (2 * braking); }
  };

  Footing ground_;
  std::vector<Slider> sliders_;
  Worst distance_, time_, apart_;
};

// Balls that are thrown along level ground without spin. Friction brakes them and makes them turn,
// until they roll. With inertia k m r^2 (k = 2/5, of a disc 1/2) they slip at first with v, and
//
//   slip(t) = v - (1 + 1/k) mu g t       so it rolls at t = k/(1+k) v/(mu g) = 2/7 v/(mu g)
//                                        with v/(1+k) = 5/7 v, for ever
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

OwnMetric slide_metric(const Scenario& s) { return std::make_unique<Slide>(s); }
OwnMetric slip_then_roll_metric(const Scenario& s) { return std::make_unique<SlipThenRoll>(s); }

}  // namespace lantern::measure
