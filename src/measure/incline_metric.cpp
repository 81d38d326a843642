// Blocks and balls that are put on a slope. A block stays iff tan a <= mu, else it slides with
// g (sin a - mu cos a). A ball of inertia k m r^2 rolls with g sin a / (1 + k) iff
// tan a <= mu (1 + k) / k, else it slips, and slides as a block does.
#include <fmt/format.h>

#include "measure/error_metrics.hpp"
#include "measure/problem_scene.hpp"

namespace lantern {
namespace {

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
    acceleration_ = error.value();
    wrong_ = wrong;
  }

  std::vector<Norm> norms() const override {
    return {{"a", acceleration_, "1",
             "error of the mean acceleration from start to end, over that of gravity; of the worst "
             "body"},
            {"class", wrong_, "bodies",
             "how many stay, slide, roll or slip at the end that should do the opposite"}};
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
    if (body.velocity != Vec<3>(0.0) || body.spin != 0)
      refuse_problem(scenario, fmt::format("'{}' does not begin at rest", body.name));
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
  double acceleration_ = 0, wrong_ = 0;
};

}  // namespace

std::unique_ptr<ErrorMetric> incline_metric(const Scenario& scenario) {
  return std::make_unique<Incline>(scenario);
}

}  // namespace lantern
