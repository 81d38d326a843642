// Bodies that slide and roll on the ground, on a slope and on a plate.

#include "measure/metrics/reading.hpp"

namespace lantern::measure {
namespace {

// A body that is thrown along level ground, and what brakes it.
struct Thrown {
  std::size_t body = 0;
  Vec<3> start{0.0}, heading{0.0};
  double speed = 0, braking = 0;  // braking: mu g
};

// Refuses one that does not `go` along it, or has no friction.
Thrown thrown_along(const Scenario& scenario, const Footing& ground, std::size_t i, double gravity,
                    const char* go) {
  const BodySpec& body = scenario.bodies[i];
  const double speed = glm::length(body.velocity);
  if (!(speed > 0) || std::abs(glm::dot(body.velocity, ground.normal)) > 1e-12 * speed)
    refuse_problem(scenario, fmt::format("'{}' does not {} along the ground", body.name, go));
  const double mu = friction_between(scenario, i, ground.body);
  if (!(mu > 0)) refuse_problem(scenario, fmt::format("'{}' has no friction", body.name));
  return {i, body.position, body.velocity / speed, speed, mu * gravity};
}

constexpr double kStill = 1e-6;  // of its first speed: so slow is stopped, so little slip is none

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
      const Thrown thrown = thrown_along(scenario, ground_, i, gravity, "slide");
      const double mu = friction_between(scenario, i, ground_.body);
      if (turns(body) && (is_ball(body) || mu * reach_along(body, ground_.normal) >
                                               reach_along(body, thrown.heading)))
        refuse_problem(scenario, fmt::format("'{}' would roll or topple", body.name));
      sliders_.push_back({thrown});
      if (sliders_.back().time() > scenario.problem->seconds)
        refuse_problem(scenario, fmt::format("'{}' still slides at the end", body.name));
    }
    if (sliders_.size() < 2) drop(apart_);
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

 private:
  struct Slider : Thrown {
    double time() const { return speed / braking; }
    double distance() const { return speed * speed / (2 * braking); }
  };

  Footing ground_;
  std::vector<Slider> sliders_;
  Worst& distance_ = norm("distance", "1",
                          "largest error of the place where a body stops, or by its speed would "
                          "stop, over the distance to there");
  Worst& time_ = norm("time", "1", "largest error of the moment at which it stops, relative");
  Worst& apart_ = norm("agree", "1", "largest difference between the bodies' distances, relative");
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
      balls_.push_back(
          {thrown_along(scenario, ground_, i, gravity, "go"), reach_along(body, ground_.normal)});
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

 private:
  struct Ball : Thrown {
    double radius = 0;
  };

  double rolls_after(const Ball& ball) const { return k_ / (1 + k_) * ball.speed / ball.braking; }

  Footing ground_;
  double k_;
  std::vector<Ball> balls_;
  Worst& distance_ =
      norm("distance", "1", "largest error of a place over the run, over the distance slipped");
  Worst& time_ = norm("time", "1", "largest error of the moment from which it rolls, relative");
  Worst& speed_ = norm("v", "1", "largest error of a velocity, over the first speed");
};

// Blocks and balls that are put on a slope. A block stays iff tan a <= mu, else it slides with
// g (sin a - mu cos a). A ball of inertia k m r^2 rolls with g sin a / (1 + k) iff
// tan a <= mu (1 + k) / k, else it slips, and slides as a block does.
class Incline : public ErrorMetric {
 public:
  explicit Incline(const Scenario& scenario)
      : ground_(ground_of(scenario)), slope_(slope_of(scenario, ground_)), k_(roundness(scenario)) {
    require_links(scenario, 0);
    for (const std::size_t i : moving_bodies(scenario)) add(scenario, i);
  }

  void look(const Observation& now) override {
    if (!(now.time > 0)) return;
    Worst error;
    double wrong = 0;
    for (const Slider& s : sliders_) {
      const BodyState& state = now.states[s.body];
      const double way = glm::dot(state.position - s.start, slope_.downhill);
      const double found = 2 * way / (now.time * now.time);
      error.meet((found - s.acceleration) / std::hypot(slope_.pull, slope_.push));
      wrong += is_wrong(s, state, found, now.time);
    }
    acceleration_.set(error.value());
    wrong_.set(wrong);
  }

 private:
  struct Slider {
    std::size_t body = 0;
    Vec<3> start{0.0};
    double acceleration = 0;
    double radius = 0;  // of a ball, else 0
    double excess = 0;  // acceleration (of a ball: of its slip) that friction cannot hold; below 0
                        // what it could hold besides
  };

  void add(const Scenario& scenario, std::size_t index) {
    const BodySpec& body = scenario.bodies[index];
    require_on_ground(scenario, ground_, index);
    require_at_rest(scenario, index);
    const double grip = friction_between(scenario, index, ground_.body) * slope_.pull;
    Slider s{index, body.position, std::max(slope_.push - grip, 0.0), 0, slope_.push - grip};
    if (is_ball(body) && turns(body)) {
      s.radius = reach_along(body, ground_.normal);
      s.excess = slope_.push - grip * (1 + 1 / k_);
      if (s.excess <= 0) s.acceleration = slope_.push / (1 + k_);
    } else if (turns(body) && std::min(grip, slope_.push) * reach_along(body, ground_.normal) >
                                  slope_.pull * reach_along(body, slope_.downhill)) {
      refuse_problem(scenario, fmt::format("'{}' would topple", body.name));
    }
    sliders_.push_back(s);
  }

  // What a body does is told apart half way between the two.
  bool is_wrong(const Slider& s, const BodyState& state, double found, double time) const {
    double gains = found;
    if (s.radius > 0) {
      const Vec<3> touching =
          state.velocity + glm::cross(state.angular_velocity, -s.radius * ground_.normal);
      gains = glm::dot(touching, slope_.downhill) / time;
    }
    const bool goes = !(gains <= std::abs(s.excess) / 2);
    return goes != (s.excess > 0);
  }

  Footing ground_;
  Slope slope_;
  double k_;
  std::vector<Slider> sliders_;
  Worst& acceleration_ = norm("a", "1",
                              "error of the mean acceleration from start to end, over that of "
                              "gravity; of the worst body");
  Worst& wrong_ = norm("class", "bodies",
                       "how many stay, slide, roll or slip at the end that should do the opposite");
};

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
  Worst& velocity_ =
      norm("v", "1", "largest error of a velocity over the run, over the plate's at the end");
  Worst& place_ = norm("place", "1", "largest error of a place over the run, over the plate's way");
};

}  // namespace

std::span<const Problem> ground_problems() {
  static constexpr Problem kAll[] = {{Solution::slide, made_of<Slide>},
                                     {Solution::slip_then_roll, made_of<SlipThenRoll>},
                                     {Solution::incline, made_of<Incline>},
                                     {Solution::ball_on_plate, made_of<BallOnPlate>}};
  return kAll;
}

}  // namespace lantern::measure
