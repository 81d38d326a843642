// Bodies that bounce and hit each other.

#include "measure/metrics/reading.hpp"

namespace lantern::measure {
namespace {

// --- bodies that bounce for long ---

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
  Worst& times_ = norm("times", "1",
                       "largest error of the moment of an impact over the run, in flights of the "
                       "first height");
  Worst& apex_ =
      norm("apex", "1", "largest error of the height that a flight rises to, in first heights");
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
    if (moving_.size() < scenario.bodies.size()) drop(momentum_error_);  // it has walls
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
    return_.set(away.value());
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

 private:
  struct Start {
    Vec<3> position{0.0}, velocity{0.0};
  };

  std::uint32_t half_;  // samples until all are turned round
  std::vector<std::size_t> moving_;
  std::vector<Start> starts_;
  std::vector<double> masses_;
  std::uint32_t looks_ = 0;
  double size_ = 0, speed_ = 0, energy_ = 0, momentum_size_ = 0;
  Vec<3> momentum_{0.0};
  Worst& return_ = norm("return", "1",
                        "distance from the start at the end: of places over the largest half width "
                        "of a body, of velocities over the largest speed");
  Worst& energy_error_ = norm("E", "1", kEnergyMeaning);
  Worst& momentum_error_ = norm("p", "1", kMomentumMeaning);
};

// --- bodies that hit each other on a line ---

constexpr int kMostHits = 1'000'000;

struct LineBall {
  std::size_t body = 0;
  Real mass = 0, place = 0, speed = 0, reach = 0;
};

// Balls on a line that hit each other: Newton's cradle, where equal balls pass the blow on, and the
// superball, v' = 2 m1 v / (m1 + m2). Between hits all fly straight on, so the reference goes from
// hit to hit. Balls that touch are taken pair by pair: the limit of gaps that close.
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
    std::ranges::sort(balls_, {}, &LineBall::place);
    for (std::size_t i = 0; i + 1 < balls_.size(); ++i) {
      const double e = restitution_between(scenario, balls_[i].body, balls_[i + 1].body);
      restitution_.push_back(e);
      if (e != 1) drop(energy_error_);
      if (gap(i) < -touching(i)) refuse_problem(scenario, "bodies begin in each other");
    }
    for (const LineBall& ball : balls_) {
      energy_ += ball.mass * ball.speed * ball.speed;
      momentum_ += ball.mass * ball.speed;
      momentum_size_ += ball.mass * std::abs(ball.speed);
    }
    if (!(energy_ > 0)) refuse_problem(scenario, "all bodies rest");
  }

  void look(const Observation& now) override {
    advance(now.time);
    Real largest = 0, momentum = 0, energy = 0;
    for (const LineBall& ball : balls_) largest = std::max(largest, std::abs(ball.speed));
    Worst off;
    for (const LineBall& ball : balls_) {
      const Vec<3>& v = now.states[ball.body].velocity;
      const Real speed = glm::dot(v, along_);
      const double aside = glm::length(v - along_ * static_cast<double>(speed));
      off.meet(static_cast<double>(std::hypot(speed - ball.speed, Real(aside)) / largest));
      momentum += ball.mass * speed;
      energy += ball.mass * static_cast<Real>(glm::dot(v, v));
    }
    speeds_.set(off.value());
    momentum_error_.meet(static_cast<double>((momentum - momentum_) / momentum_size_));
    energy_error_.meet(static_cast<double>((energy - energy_) / energy_));
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
      LineBall& a = balls_[hit->first];
      LineBall& b = balls_[hit->first + 1];
      const Real impulse = (1 + restitution_[hit->first]) * (a.speed - b.speed) * a.mass * b.mass /
                           (a.mass + b.mass);
      a.speed -= impulse / a.mass;
      b.speed += impulse / b.mass;
    }
  }

  void fly(Real seconds) {
    for (LineBall& ball : balls_) ball.place += ball.speed * seconds;
    time_ += seconds;
  }

  Vec<3> along_{0.0};
  std::vector<LineBall> balls_;    // in order along the line
  std::vector<Real> restitution_;  // of each and the next
  Real time_ = 0, energy_ = 0, momentum_ = 0, momentum_size_ = 0;
  Worst& speeds_ = norm("v", "1", "error of the velocities at the end, over the largest of them");
  Worst& momentum_error_ = norm("p", "1", kMomentumMeaning);
  Worst& energy_error_ = norm("E", "1", kEnergyMeaning);
};

using Point = glm::vec<2, Real>;
Real turning(const Point& a, const Point& b) { return a.x * b.y - a.y * b.x; }

// A heavy block pushes a light one against a wall; all bounces are elastic. How often do they hit?
// Galperin, "Playing Pool with pi", 2003: with the places scaled by the roots of the masses the two
// blocks are one point in a wedge, and each hit is a reflection. Unfolded, its way is a straight
// line that crosses one ray for each hit.
//
//   y = sqrt(m) q       | . way            q: gap from the wall to the light block
//                    \  |.  /              Q: gap from the wall to the heavy one, less the light
//                     \ .| /                  one's width
//                      \|/__ theta         tan theta = sqrt(m / M)
//   x = sqrt(M) Q
//
// For M = 100^k m it crosses floor(pi 10^k) rays in all.
class BlocksAndWall : public ErrorMetric {
 public:
  explicit BlocksAndWall(const Scenario& scenario) : wall_(ground_of(scenario)) {
    require_links(scenario, 0);
    if (scenario.world.gravity != Vec<3>(0.0)) refuse_problem(scenario, "there is gravity");
    const auto moving = moving_bodies(scenario);
    if (moving.size() != 2) refuse_problem(scenario, "it needs two blocks");
    inner_ = moving[0];
    outer_ = moving[1];
    const auto height = [&](std::size_t i) {
      return glm::dot(scenario.bodies[i].position, wall_.normal) - wall_.height;
    };
    if (height(inner_) > height(outer_)) std::swap(inner_, outer_);
    const BodySpec& inner = scenario.bodies[inner_];
    const BodySpec& outer = scenario.bodies[outer_];
    if (!are_parallel(outer.position - inner.position, wall_.normal) ||
        !are_parallel(inner.velocity, wall_.normal) || !are_parallel(outer.velocity, wall_.normal))
      refuse_problem(scenario, "the blocks do not move on one line towards the wall");
    if (restitution_between(scenario, inner_, outer_) != 1 ||
        restitution_between(scenario, inner_, wall_.body) != 1)
      refuse_problem(scenario, "a bounce is not elastic (restitution = 1)");
    root_inner_ = std::sqrt(static_cast<Real>(mass_of_body(scenario, inner_)));
    root_outer_ = std::sqrt(static_cast<Real>(mass_of_body(scenario, outer_)));
    const Real half = reach_along(inner, wall_.normal);
    start_.y = root_inner_ * (height(inner_) - half);
    start_.x = root_outer_ * (height(outer_) - 2 * half - reach_along(outer, wall_.normal));
    speed_ = scaled(inner.velocity, outer.velocity);
    theta_ = std::atan2(root_inner_, root_outer_);
    if (start_.y < 0 || turning(start_, {root_outer_, root_inner_}) < 0)
      refuse_problem(scenario, "the blocks begin in each other");
    if (inner.velocity != Vec<3>(0.0) || !(speed_.x < 0))
      refuse_problem(scenario, "not the outer block alone moves, towards the wall");
  }

  void look(const Observation& now) override {
    const Real t = now.time;
    const Point place = start_ + speed_ * t;
    const Real angle = std::atan2(start_.y, start_.x) +
                       std::atan2(turning(start_, place), glm::dot(start_, place));
    const Point found = scaled(now.states[inner_].velocity, now.states[outer_].velocity);
    measure_hits(angle / theta_, found, now.impacts);
    measure_speeds(std::floor(angle / theta_), found);
    const Real energy = glm::dot(speed_, speed_);
    energy_.meet(static_cast<double>((glm::dot(found, found) - energy) / energy));
  }

 private:
  Point scaled(const Vec<3>& inner, const Vec<3>& outer) const {
    return {root_outer_ * static_cast<Real>(glm::dot(outer, wall_.normal)),
            root_inner_ * static_cast<Real>(glm::dot(inner, wall_.normal))};
  }

  // Who does not count its hits is asked how far they have turned the velocities. These begin at
  // the angle pi; after n hits they are at pi - n theta, or, while the light block goes towards the
  // wall, at -(pi - (n + 1) theta).
  Real hits_by(const Point& found) const {
    const Real angle = std::atan2(found.y, found.x);
    const Real left = std::abs(angle);
    return std::round((std::numbers::pi_v<Real> - left) / theta_) - (angle < 0 ? 1 : 0);
  }

  void measure_hits(Real rays, const Point& found, std::uint64_t told) {
    const Real hits = told > 0 ? static_cast<Real>(told) : hits_by(found);
    // A look at the very moment of a hit may see it or not.
    constexpr Real kNearHit = 0.02L;
    const Real some = std::abs(std::floor(rays - kNearHit));
    const Real more = std::abs(std::floor(rays + kNearHit));
    const bool finite = std::isfinite(static_cast<double>(glm::dot(found, found)));
    hits_.set(finite ? static_cast<double>(std::min(std::abs(hits - some), std::abs(hits - more)))
                     : std::nan(""));
  }

  void measure_speeds(Real cell, const Point& found) {
    const Real size = glm::length(speed_);
    const Real from = std::numbers::pi_v<Real>;
    const bool mirrored = std::fmod(cell, 2.0L) != 0;
    const Real angle = mirrored ? (cell + 1) * theta_ - from : from - cell * theta_;
    const Point exact{size * std::cos(angle), size * std::sin(angle)};
    speed_error_.set(static_cast<double>(glm::length(found - exact) / size));
  }

  Footing wall_;
  std::size_t inner_ = 0, outer_ = 0;
  Real root_inner_ = 0, root_outer_ = 0, theta_ = 0;
  Point start_{0.0L}, speed_{0.0L};
  Worst& hits_ = norm("hits", "hits", "how many too many or too few there were by the end");
  Worst& speed_error_ =
      norm("v", "1",
           "error of both velocities at the end, weighted by the roots of the masses, relative");
  Worst& energy_ = norm("E", "1", kEnergyMeaning);
};

}  // namespace

std::span<const Problem> impacts_problems() {
  static constexpr Problem kAll[] = {{Solution::bouncing_ball, made_of<BouncingBall>},
                                     {Solution::blocks_and_wall, made_of<BlocksAndWall>},
                                     {Solution::collisions, made_of<Collisions>},
                                     {Solution::billiards, made_of<Billiards>}};
  return kAll;
}

}  // namespace lantern::measure
