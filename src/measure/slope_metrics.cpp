// Bodies that are put on a slope.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "measure/error_metrics.hpp"

namespace lantern::measure {
namespace {

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
  double acceleration_ = 0, wrong_ = 0;
};

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
    wrong_ = wrong;
  }

  std::vector<Norm> norms() const override {
    return {{"class", wrong_, "boxes",
             "how many stand at the end that should have toppled, or topple that should stand"},
            {"tilt", tilt_.value(), "rad", "largest tilt over the run of a box that should stand"}};
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
  double wrong_ = 0;
  Worst tilt_;
};

}  // namespace

OwnMetric incline_metric(const Scenario& s) { return std::make_unique<Incline>(s); }
OwnMetric topple_metric(const Scenario& s) { return std::make_unique<Topple>(s); }

}  // namespace lantern::measure
