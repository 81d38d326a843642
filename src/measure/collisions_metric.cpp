// Balls on a line that hit each other: Newton's cradle, where equal balls pass the blow on, and the
// superball, v' = 2 m1 v / (m1 + m2). Between hits all fly straight on, so the reference goes from
// hit to hit. Balls that touch are taken pair by pair: the limit of gaps that close.
#include <algorithm>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "measure/error_metrics.hpp"
#include "measure/problem_scene.hpp"

namespace lantern {
namespace {

using Real = long double;

constexpr int kMostHits = 1'000'000;

struct Ball {
  std::size_t body = 0;
  Real mass = 0, place = 0, speed = 0, reach = 0;
};

class Collisions : public ErrorMetric {
 public:
  explicit Collisions(const Scenario& scenario) {
    require_links(scenario, 0);
    if (scenario.world.gravity != Vec<3>(0.0)) refuse_problem(scenario, "there is gravity");
    const auto moving = moving_bodies(scenario);
    if (moving.size() != scenario.bodies.size() || moving.size() < 2)
      refuse_problem(scenario, "it needs two moving bodies or more, and no static one");
    find_line(scenario, moving);
    for (const std::size_t i : moving) {
      const BodySpec& body = scenario.bodies[i];
      const Vec<3> away = body.position - scenario.bodies[moving[0]].position;
      if (!are_parallel(away, along_) || !are_parallel(body.velocity, along_))
        refuse_problem(scenario, fmt::format("'{}' leaves the line of the others", body.name));
      balls_.push_back({i, mass_of_body(scenario, i), glm::dot(away, along_),
                        glm::dot(body.velocity, along_), reach_along(body, along_)});
    }
    std::sort(balls_.begin(), balls_.end(),
              [](const Ball& a, const Ball& b) { return a.place < b.place; });
    for (std::size_t i = 0; i + 1 < balls_.size(); ++i) {
      const double e = restitution_between(scenario, balls_[i].body, balls_[i + 1].body);
      restitution_.push_back(e);
      elastic_ = elastic_ && e == 1;
      if (gap(i) < -touching(i)) refuse_problem(scenario, "bodies begin in each other");
    }
    for (const Ball& ball : balls_) {
      energy_ += ball.mass * ball.speed * ball.speed;
      momentum_ += ball.mass * ball.speed;
      momentum_size_ += ball.mass * std::abs(ball.speed);
    }
    if (!(energy_ > 0)) refuse_problem(scenario, "all bodies rest");
  }

  void look(const Observation& now) override {
    advance(now.time);
    Real largest = 0, momentum = 0, energy = 0;
    for (const Ball& ball : balls_) largest = std::max(largest, std::abs(ball.speed));
    Worst off;
    for (const Ball& ball : balls_) {
      const Vec<3>& v = now.states[ball.body].velocity;
      const Real speed = glm::dot(v, along_);
      const double aside = glm::length(v - along_ * static_cast<double>(speed));
      off.meet(static_cast<double>(std::hypot(speed - ball.speed, Real(aside)) / largest));
      momentum += ball.mass * speed;
      energy += ball.mass * static_cast<Real>(glm::dot(v, v));
    }
    speeds_ = off.value();
    momentum_error_.meet(static_cast<double>((momentum - momentum_) / momentum_size_));
    energy_error_.meet(static_cast<double>((energy - energy_) / energy_));
  }

  std::vector<Norm> norms() const override {
    std::vector<Norm> all{
        {"v", speeds_, "1", "error of the velocities at the end, over the largest of them"},
        {"p", momentum_error_.value(), "1", kMomentumMeaning}};
    if (elastic_) all.push_back({"E", energy_error_.value(), "1", kEnergyMeaning});
    return all;
  }

 private:
  void find_line(const Scenario& scenario, const std::vector<std::size_t>& moving) {
    const Vec<3> away =
        scenario.bodies[moving.back()].position - scenario.bodies[moving.front()].position;
    if (!(glm::length(away) > 0)) refuse_problem(scenario, "bodies begin in each other");
    along_ = glm::normalize(away);
  }

  Real gap(std::size_t i) const {
    return balls_[i + 1].place - balls_[i].place - balls_[i + 1].reach - balls_[i].reach;
  }
  Real touching(std::size_t i) const { return 1e-9L * (balls_[i].reach + balls_[i + 1].reach); }

  // The pair that hits next and when, if it does so within `seconds`.
  std::optional<std::pair<std::size_t, Real>> next_hit(Real seconds) const {
    std::optional<std::pair<std::size_t, Real>> first;
    for (std::size_t i = 0; i + 1 < balls_.size(); ++i) {
      const Real closing = balls_[i].speed - balls_[i + 1].speed;
      const Real scale = std::abs(balls_[i].speed) + std::abs(balls_[i + 1].speed);
      if (!(closing > 1e-15L * scale)) continue;
      const Real after = gap(i) <= touching(i) ? 0 : gap(i) / closing;
      if (after <= seconds && (!first || after < first->second)) first = {i, after};
    }
    return first;
  }

  void advance(Real until) {
    for (int hits = 0; hits < kMostHits; ++hits) {
      const auto hit = next_hit(until - time_);
      fly(hit ? hit->second : until - time_);
      if (!hit) return;
      Ball& a = balls_[hit->first];
      Ball& b = balls_[hit->first + 1];
      const Real impulse = (1 + restitution_[hit->first]) * (a.speed - b.speed) * a.mass * b.mass /
                           (a.mass + b.mass);
      a.speed -= impulse / a.mass;
      b.speed += impulse / b.mass;
    }
  }

  void fly(Real seconds) {
    for (Ball& ball : balls_) ball.place += ball.speed * seconds;
    time_ += seconds;
  }

  Vec<3> along_{0.0};
  std::vector<Ball> balls_;        // in order along the line
  std::vector<Real> restitution_;  // of each and the next
  bool elastic_ = true;
  Real time_ = 0, energy_ = 0, momentum_ = 0, momentum_size_ = 0;
  double speeds_ = 0;
  Worst momentum_error_, energy_error_;
};

}  // namespace

std::unique_ptr<ErrorMetric> collisions_metric(const Scenario& scenario) {
  return std::make_unique<Collisions>(scenario);
}

}  // namespace lantern
