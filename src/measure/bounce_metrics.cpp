// Bodies that bounce for long.
#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "measure/error_metrics.hpp"

namespace lantern::measure {
namespace {

using Real = long double;

// Flights that rise less than this share of the first are no longer timed: engines may call them
// rest. The height of rest is still measured.
constexpr Real kTimed = 1e-6L;
// A state so near to an impact, in flights, may belong to the flight before or after it.
constexpr Real kNearImpact = 0.1L;

struct Fall {
  Real begin = 0, end = 0;
  Real speed = 0;  // with which it leaves the ground; 0 at rest
  bool first = false;
};

// A ball that falls on the ground and bounces. It leaves the ground with e times the speed of its
// impact, so flight k begins with u e^k and takes 2 u e^k / g: for e < 1 all is over at
//
//   t = sqrt(2 h / g) (1 + e) / (1 - e)
//
// Between two impacts place and speed say exactly when the last one was and when the next will be.
class BouncingBall : public ErrorMetric {
 public:
  explicit BouncingBall(const Scenario& scenario) : ground_(ground_of(scenario)) {
    require_links(scenario, 0);
    const auto moving = moving_bodies(scenario);
    if (moving.size() != 1) refuse_problem(scenario, "it needs one ball");
    ball_ = moving.front();
    const BodySpec& ball = scenario.bodies[ball_];
    if (!is_ball(ball) && turns(ball)) refuse_problem(scenario, "what bounces may turn");
    gravity_ = pull_onto(scenario, ground_);
    if (!are_parallel(ball.velocity, ground_.normal))
      refuse_problem(scenario, "the ball does not fall straight down");
    restitution_ = restitution_between(scenario, ball_, ground_.body);
    reach_ = reach_along(ball, ground_.normal);
    const Real height = above(ball.position), speed = glm::dot(ball.velocity, ground_.normal);
    if (height < 0) refuse_problem(scenario, "the ball begins in the ground");
    const Real leaves = std::sqrt(speed * speed + 2 * gravity_ * height);
    if (!(leaves > 0)) refuse_problem(scenario, "the ball rests");
    // As if it had left the ground before the start.
    flight_ = {-(leaves - speed) / gravity_, (leaves + speed) / gravity_, leaves, true};
    before_ = flight_;
    first_ = flight_;
  }

  void look(const Observation& now) override {
    const Real t = now.time;
    while (flight_.speed > 0 && t >= flight_.end) {
      before_ = flight_;
      flight_ = after(flight_);
    }
    std::array<Fall, 3> meant{flight_};
    std::size_t count = 1;
    if (!flight_.first && t - flight_.begin < kNearImpact * (before_.end - before_.begin))
      meant[count++] = before_;
    if (flight_.speed > 0 && flight_.end - t < kNearImpact * (flight_.end - flight_.begin))
      meant[count++] = after(flight_);
    Errors least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    bool any = false;
    for (std::size_t i = 0; i < count; ++i) {
      const Errors errors = held_against(meant[i], now);
      if (!any || std::max(errors.times, errors.apex) < std::max(least.times, least.apex))
        least = errors;
      any = true;
    }
    times_.meet(least.times);
    apex_.meet(least.apex);
  }

  std::vector<Norm> norms() const override {
    return {{"times", times_.value(), "1",
             "largest error of the moment of an impact over the run, in flights of the first "
             "height"},
            {"apex", apex_.value(), "1",
             "largest error of the height that a flight rises to, in first heights"}};
  }

 private:
  struct Errors {
    double times = 0, apex = 0;
  };

  Real above(const Vec<3>& position) const {
    return static_cast<Real>(glm::dot(position, ground_.normal)) - reach_ - ground_.height;
  }

  Fall after(const Fall& flight) const {
    const Real speed = restitution_ * flight.speed;
    const bool rests = speed < 1e-12L * first_.speed;
    if (rests) return {flight.end, std::numeric_limits<Real>::infinity(), 0, false};
    return {flight.end, flight.end + 2 * speed / gravity_, speed, false};
  }

  Errors held_against(const Fall& flight, const Observation& now) const {
    const BodyState& state = now.states[ball_];
    const Real y = above(state.position), v = glm::dot(state.velocity, ground_.normal);
    const Real square = v * v + 2 * gravity_ * y;
    const Real first_square = first_.speed * first_.speed;
    Errors errors;
    errors.apex =
        static_cast<double>(std::abs(square - flight.speed * flight.speed) / first_square);
    if (!(flight.speed * flight.speed >= kTimed * first_square)) return errors;
    const Real left = square > 0 ? std::sqrt(square) : (square <= 0 ? 0 : square);  // or no number
    const Real last = now.time - (left - v) / gravity_, next = now.time + (left + v) / gravity_;
    Worst worst;
    worst.meet(static_cast<double>((next - flight.end) / (first_.end - first_.begin)));
    if (!flight.first)
      worst.meet(static_cast<double>((last - flight.begin) / (first_.end - first_.begin)));
    errors.times = worst.value();
    return errors;
  }

  Footing ground_;
  std::size_t ball_ = 0;
  Real gravity_ = 0, restitution_ = 0, reach_ = 0;
  Fall first_, before_, flight_;
  Worst times_, apex_;
};

// Elastic bodies without gravity. Half of the time they run; then all velocities are turned round,
// and they should run back to where they came from.
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

OwnMetric bouncing_ball_metric(const Scenario& s) { return std::make_unique<BouncingBall>(s); }
OwnMetric billiards_metric(const Scenario& s) { return std::make_unique<Billiards>(s); }

}  // namespace lantern::measure
