// Blocks that tip: one that rocks, and many that knock each other over.

#include "measure/forms/dormand_prince.hpp"
#include "measure/metrics/reading.hpp"
#include "measure/solvers.hpp"

namespace lantern::measure {
namespace {

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
  auto moments = std::make_shared<RockingBlock::Moments>();
  const ProblemSpec& problem = *scenario.problem;
  for (std::uint32_t n = 0; n <= problem.samples; ++n)
    moments->push_back(rocking.at(static_cast<long double>(problem.seconds) * n / problem.samples));
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
  static constexpr Problem kAll[] = {{Solution::rocking_block, rocking_block_metric},
                                     {Solution::dominoes, dominoes_metric, require_dominoes}};
  return kAll;
}

}  // namespace lantern::measure
