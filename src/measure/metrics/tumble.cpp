// Blocks that tip: on a slope, one that rocks, and many that knock each other over.

#include "measure/forms/dormand_prince.hpp"
#include "measure/metrics/reading.hpp"
#include "measure/solvers.hpp"

namespace lantern::measure {
namespace {

constexpr double kTopples = 0.1;  // radians: one that leans so far does not come back
constexpr double kIsTold = 0.2;   // radians that it must have turned by the end of the problem

// Boxes that are put on a slope too rough to slide on. One of half width w and half height h
// topples over its lower edge iff tan a > w / h: iff its centre is beyond that edge.
class Topple : public ErrorMetric {
 public:
  explicit Topple(const Scenario& scenario)
      : ground_(ground_of(scenario)), slope_(slope_of(scenario, ground_)) {
    require_links(scenario, 0);
    for (const std::size_t i : moving_bodies(scenario)) add(scenario, i);
  }

  void look(const Observation& now) override {
    double wrong = 0;
    for (Box& box : boxes_) {
      const Rotation<3>& r = now.states[box.body].orientation;
      const Vec<3> leans = matrix(r) * box.up;
      const double tilt = std::atan2(glm::length(glm::cross(ground_.normal, leans)),
                                     glm::dot(ground_.normal, leans));
      if (!(tilt < kTopples)) box.has_toppled = true;
      if (!box.should) tilt_.meet(tilt);
      wrong += box.has_toppled != box.should;
    }
    wrong_.set(wrong);
  }

 private:
  struct Box {
    std::size_t body = 0;
    Vec<3> up{0.0};  // the normal of the ground in the axes of the body
    bool should = false;
    bool has_toppled = false;
  };

  void add(const Scenario& scenario, std::size_t index) {
    const BodySpec& body = scenario.bodies[index];
    const auto refuse = [&](const char* why) {
      refuse_problem(scenario, fmt::format("'{}' {}", body.name, why));
    };
    require_on_ground(scenario, ground_, index);
    const auto* shape = std::get_if<OrientedBox<3>>(&body.shape);
    if (!shape || !turns(body)) refuse("is no box that turns");
    require_at_rest(scenario, index);
    const double mu = friction_between(scenario, index, ground_.body);
    if (!(mu * slope_.pull > slope_.push)) refuse("would slide");
    Box box;
    box.body = index;
    const Mat<3> axes = matrix(turned(Rotation<3>(), body.axis * body.angle));
    box.up = glm::transpose(axes) * ground_.normal;
    const double w = reach_along(body, slope_.downhill), h = reach_along(body, ground_.normal);
    double flattest = 1;
    for (int i = 0; i < 3; ++i)
      flattest = std::min(flattest, 1 - std::abs(glm::dot(axes[i], ground_.normal)));
    if (flattest > 1e-9) refuse("does not stand flat on the ground");
    box.should = slope_.push * h > slope_.pull * w;
    if (box.should && tilt_after(scenario.problem->seconds, w, h) < kIsTold)
      refuse("needs more seconds to topple");
    boxes_.push_back(box);
  }

  // Of a box that tips over its edge, near to the start: about the edge its inertia over its mass
  // is 4/3 (w^2 + h^2), and what turns it grows with the angle.
  double tilt_after(double seconds, double w, double h) const {
    const double inertia = 4.0 / 3 * (w * w + h * h);
    const double at_first = (slope_.push * h - slope_.pull * w) / inertia;
    const double growth = (slope_.pull * h + slope_.push * w) / inertia;
    return at_first / growth * (std::cosh(std::sqrt(growth) * seconds) - 1);
  }

  Footing ground_;
  Slope slope_;
  std::vector<Box> boxes_;
  Worst& wrong_ =
      norm("class", "boxes",
           "how many stand at the end that should have toppled, or topple that should stand");
  Worst& tilt_ = norm("tilt", "rad", "largest tilt over the run of a box that should stand");
};

// A block on its corner rocks from one to the other. Housner ("The behavior of inverted pendulum
// structures during earthquakes", Bulletin of the Seismological Society of America 53, 1963): with
// its half diagonal R at the angle alpha from its side,
//
//   angle'' = -3 g / (4 R) sin(alpha - angle)      for angles above 0, and mirrored
//   rate -> (1 - 3/2 sin^2 alpha) rate             at each impact, where the angle is 0
class Rocking {
 public:
  Rocking(double half_width, double half_height, double gravity, double angle)
      : alpha_(std::atan2(static_cast<long double>(half_width), half_height)),
        rate2_(0.75L * gravity / std::hypot(static_cast<long double>(half_width), half_height)),
        kept_(1 - 1.5L * std::sin(alpha_) * std::sin(alpha_)),
        side_(angle < 0 ? -1 : 1),
        y_{std::abs(static_cast<long double>(angle)), 0} {}

  struct Moment {
    double angle = 0, rate = 0;
    int impacts = 0;
  };

  // `time` >= that of the call before.
  Moment at(long double time) {
    constexpr long double kGlance = 1e-3L;  // s: how often an impact is looked for
    while (time_ < time) {
      const long double end = std::min(time, time_ + kGlance);
      State next = moved(end - time_);
      if (next[0] > 0 || next[1] > 0) {
        y_ = next;
        time_ = end;
      } else {
        strike(end);
      }
    }
    return {static_cast<double>(side_ * y_[0]), static_cast<double>(side_ * y_[1]), impacts_};
  }

 private:
  using State = DormandPrince<long double>::State;  // angle and rate, on the side where it is

  State moved(long double seconds) const {
    State y = y_;
    DormandPrince<long double> method(1e-17L, {1, 1});
    method.run(
        [this](long double, const State& now, State& dy) {
          dy = {now[1], -rate2_ * std::sin(alpha_ - now[0])};
        },
        0, seconds, y);
    return y;
  }

  // At the moment before `end` where the angle is 0.
  void strike(long double end) {
    long double before = 0, after = end - time_;
    for (int i = 0; i < 60; ++i) {
      const long double middle = (before + after) / 2;
      (moved(middle)[0] > 0 ? before : after) = middle;
    }
    y_ = {0, -kept_ * moved(after)[1]};
    side_ = -side_;
    time_ += after;
    if (++impacts_ > 1000) throw Refused("its block comes to rest");
  }

  long double alpha_, rate2_, kept_;
  int side_;
  State y_;
  long double time_ = 0;
  int impacts_ = 0;
};

class RockingBlock : public ErrorMetric {
 public:
  using Moments = std::vector<Rocking::Moment>;

  RockingBlock(std::size_t body, std::shared_ptr<const Moments> exact)
      : exact_(std::move(exact)), body_(body), start_(std::abs(exact_->front().angle)) {}

  void look(const Observation& now) override {
    const Rocking::Moment& exact = exact_->at(next_++);
    const BodyState& state = now.states[body_];
    angle_.meet((state.angle - exact.angle) / start_);
  }

  std::string reference() const override {
    return "Housner's impacts, Dormand-Prince between them";
  }

 private:
  std::shared_ptr<const Moments> exact_;  // at each sample
  std::size_t body_ = 0;
  std::size_t next_ = 0;
  double start_ = 1;
  Worst& angle_ =
      norm("angle", "1",
           fmt::format("largest error of the angle over the run, {} impacts, over the first angle",
                       exact_->back().impacts));
};

// --- dominoes ---

// When each of a row has begun to fall: the moment at which it passes this tilt.
constexpr double kFalls = 0.2;  // rad

std::vector<std::size_t> row_of(const Scenario& scenario) {
  std::vector<std::size_t> row = moving_bodies(scenario);
  std::ranges::sort(row, {}, [&](std::size_t i) { return scenario.bodies[i].position.x; });
  return row;
}

class FallTimes {
 public:
  explicit FallTimes(const Scenario& scenario)
      : row_(row_of(scenario)), times_(row_.size()), tilts_(row_.size(), 0.0) {}

  void look(double time, const std::vector<BodyState>& states) {
    for (std::size_t i = 0; i < row_.size(); ++i) {
      const double tilt = std::abs(states[row_[i]].angle);
      if (!times_[i] && tilt > kFalls)
        times_[i] = before_ + (time - before_) * (kFalls - tilts_[i]) / (tilt - tilts_[i]);
      tilts_[i] = tilt;
    }
    before_ = time;
  }
  const std::vector<std::optional<double>>& times() const { return times_; }

 private:
  std::vector<std::size_t> row_;  // from left to right
  std::vector<std::optional<double>> times_;
  std::vector<double> tilts_;
  double before_ = 0;
};

constexpr const char* kOwnMethod = "impulse:100";

// A run of our own: where there is no closed form the finest one is the best that is known.
std::vector<std::optional<double>> own_fall_times(const Scenario& scenario, double step) {
  const ProblemSpec& problem = *scenario.problem;
  const double part = problem.seconds / problem.samples;
  const auto steps = static_cast<std::uint64_t>(std::max(1.0, std::round(part / step)));
  const auto simulation =
      LanternSolver(*method_named(kOwnMethod)).start(scenario, part / static_cast<double>(steps));
  FallTimes falls(scenario);
  std::vector<BodyState> states;
  for (std::uint32_t i = 0; i <= problem.samples; ++i) {
    if (i > 0) simulation->advance(steps);
    simulation->observe(states);
    falls.look(part * i, states);
  }
  return falls.times();
}

double latest_error(const std::vector<std::optional<double>>& times,
                    const std::vector<std::optional<double>>& exact) {
  double worst = 0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    worst = std::max(worst, times[i] ? std::abs(*times[i] - *exact[i]) / *exact.back() : 1.0);
  return worst;
}

class Dominoes : public ErrorMetric {
 public:
  struct Own {
    std::vector<std::optional<double>> times;
    double step = 0, error = 0;
  };

  Dominoes(const Scenario& scenario, std::shared_ptr<const Own> own)
      : own_(std::move(own)), falls_(scenario), energy_(scenario) {}

  void look(const Observation& now) override {
    falls_.look(now.time, now.states);
    energy_.look(now);
    arrival_.set(latest_error(falls_.times(), own_->times));
    order_.set(out_of_order());
    gain_.set(energy_.gain());
  }
  std::optional<std::string> collapse() const override {
    if (order_.value() == 0) return std::nullopt;
    return fmt::format("{} do not fall in order", order_.value());
  }
  std::string reference() const override {
    return fmt::format("own finest run, {} at {:.2g} s: there is no closed form", kOwnMethod,
                       own_->step);
  }
  double reference_error() const override { return own_->error; }

 private:
  double out_of_order() const {
    const auto& times = falls_.times();
    double wrong = 0;
    for (std::size_t i = 0; i < times.size(); ++i)
      wrong += !times[i] || (i > 0 && times[i - 1] && *times[i] < *times[i - 1]);
    return wrong;
  }

  std::shared_ptr<const Own> own_;
  FallTimes falls_;
  EnergyMeter energy_;
  Worst& arrival_ = norm("arrival", "1",
                         "largest difference from our finest run of the moment at which one begins "
                         "to fall, over the moment of the last; 1 for one that does not fall");
  Worst& order_ = norm("order", "1", "how many do not fall, or before the one behind them");
  Worst& gain_ = norm("gain", "1", EnergyMeter::kGainMeaning);
};

MetricMaker rocking_block_metric(const Scenario& scenario) {
  require_links(scenario, 0);
  if (scenario.world.dimension != 2) refuse_problem(scenario, "the world must be flat");
  const Footing ground = ground_of(scenario);
  const double gravity = pull_onto(scenario, ground);
  const std::size_t block = the_body(scenario);
  const BodySpec& body = scenario.bodies[block];
  require_on_ground(scenario, ground, block);
  require_at_rest(scenario, block);
  const auto* box = std::get_if<OrientedBox<3>>(&body.shape);
  if (!box || ground.normal != Vec<3>(0, 1, 0))
    refuse_problem(scenario, "it needs a box that turns, on level ground");
  const Vec<3>& half = box->half_size;
  if (body.angle == 0 || std::abs(body.angle) >= std::atan2(half.x, half.y))
    refuse_problem(scenario, "its block does not rock");
  if (friction_between(scenario, block, ground.body) < half.x / half.y ||
      restitution_between(scenario, block, ground.body) != 0)
    refuse_problem(scenario, "its block slips or bounces");
  Rocking rocking(half.x, half.y, gravity, body.angle);
  const std::shared_ptr<const RockingBlock::Moments> moments =
      at_samples(*scenario.problem, [&](long double time) { return rocking.at(time); });
  return [block, moments] { return std::make_unique<RockingBlock>(block, moments); };
}

void require_dominoes(const Scenario& scenario) {
  require_links(scenario, 0);
  if (scenario.world.dimension != 2) refuse_problem(scenario, "the world must be flat");
  if (scenario.world.gravity == Vec<3>(0.0)) refuse_problem(scenario, "there is no gravity");
  moving_bodies(scenario);  // refuses
}

MetricMaker dominoes_metric(const Scenario& scenario) {
  require_dominoes(scenario);
  const ProblemSpec& problem = *scenario.problem;
  auto own = std::make_shared<Dominoes::Own>();
  own->step = problem.step / std::ldexp(1.0, problem.halvings + 1);
  own->times = own_fall_times(scenario, own->step);
  if (std::ranges::any_of(own->times, [](const auto& time) { return !time; }))
    refuse_problem(scenario, "not all of its dominoes fall");
  own->error = latest_error(own_fall_times(scenario, 2 * own->step), own->times);
  return [&scenario, own] { return std::make_unique<Dominoes>(scenario, own); };
}

}  // namespace

std::span<const Problem> tumble_problems() {
  static constexpr Problem kAll[] = {{Solution::topple, made_of<Topple>},
                                     {Solution::rocking_block, rocking_block_metric},
                                     {Solution::dominoes, dominoes_metric, require_dominoes}};
  return kAll;
}

}  // namespace lantern::measure
