// Elastic bodies without gravity. Half of the time they run; then all velocities are turned round,
// and they should run back to where they came from.
#include <algorithm>

#include <fmt/format.h>

#include "measure/error_metrics.hpp"
#include "measure/problem_scene.hpp"

namespace lantern {
namespace {

class Billiards : public ErrorMetric {
 public:
  explicit Billiards(const Scenario& scenario)
      : half_(scenario.problem->samples / 2), moving_(moving_bodies(scenario)) {
    require_links(scenario, 0);
    if (scenario.world.gravity != Vec<3>(0.0)) refuse_problem(scenario, "there is gravity");
    if (scenario.problem->samples % 2 != 0)
      refuse_problem(scenario, "an odd number of samples has none in the middle");
    walls_ = moving_.size() < scenario.bodies.size();
    for (const std::size_t i : moving_) {
      const BodySpec& body = scenario.bodies[i];
      if (body.material.restitution != 1)
        refuse_problem(scenario, fmt::format("'{}' is not elastic (restitution = 1)", body.name));
      if (body.spin != 0 || (turns(body) && (!is_ball(body) || body.material.friction != 0)))
        refuse_problem(scenario, fmt::format("'{}' turns, or may be turned", body.name));
      masses_.push_back(mass_of_body(scenario, i));
      starts_.push_back({body.position, body.velocity});
      const double speed = glm::length(body.velocity);
      speed_ = std::max(speed_, speed);
      energy_ += masses_.back() * speed * speed;
      momentum_ += masses_.back() * body.velocity;
      momentum_size_ += masses_.back() * speed;
      size_ = std::max(size_, reach_along(body, {1, 0, 0}));
    }
    if (!(speed_ > 0)) refuse_problem(scenario, "all bodies rest");
  }

  void look(const Observation& now) override {
    double energy = 0;
    Vec<3> momentum(0.0);
    Worst away;
    for (std::size_t i = 0; i < moving_.size(); ++i) {
      const BodyState& state = now.states[moving_[i]];
      energy += masses_[i] * glm::dot(state.velocity, state.velocity);
      momentum += masses_[i] * state.velocity;
      away.meet(glm::length(state.position - starts_[i].position) / size_);
      away.meet(glm::length(state.velocity + starts_[i].velocity) / speed_);
    }
    energy_error_.meet((energy - energy_) / energy_);
    // Only the second half carries momentum the other way.
    const Vec<3> exact = looks_ > half_ ? -momentum_ : momentum_;
    momentum_error_.meet(glm::length(momentum - exact) / momentum_size_);
    return_ = away.value();
    ++looks_;
  }

  void interfere(const Observation& now, Simulation& simulation) override {
    if (looks_ != half_ + 1) return;
    for (const std::size_t i : moving_) {
      Move turn;
      turn.body = i;
      turn.velocity = -now.states[i].velocity;
      simulation.act(turn);
    }
  }

  std::vector<Norm> norms() const override {
    std::vector<Norm> all{{"return", return_, "1",
                           "distance from the start at the end: of places over the largest half "
                           "width of a body, of velocities over the largest speed"},
                          {"E", energy_error_.value(), "1", kEnergyMeaning}};
    if (!walls_) all.push_back({"p", momentum_error_.value(), "1", kMomentumMeaning});
    return all;
  }

 private:
  struct Start {
    Vec<3> position{0.0}, velocity{0.0};
  };

  std::uint32_t half_;  // samples until all are turned round
  std::vector<std::size_t> moving_;
  std::vector<Start> starts_;
  std::vector<double> masses_;
  bool walls_ = false;
  std::uint32_t looks_ = 0;
  double size_ = 0, speed_ = 0, energy_ = 0, momentum_size_ = 0, return_ = 0;
  Vec<3> momentum_{0.0};
  Worst energy_error_, momentum_error_;
};

}  // namespace

std::unique_ptr<ErrorMetric> billiards_metric(const Scenario& scenario) {
  return std::make_unique<Billiards>(scenario);
}

}  // namespace lantern
