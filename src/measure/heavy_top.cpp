// A body that turns about a fixed point under gravity.
#include <cmath>
#include <memory>

#include "measure/dormand_prince.hpp"
#include "measure/joint_gaps.hpp"
#include "physics/mass.hpp"

namespace lantern::measure {
namespace {

using LongMat = glm::mat<3, 3, long double>;

// Euler's equations about the fixed point, in the body's axes:
//
//   I w' = r x m g - w x I w      I = I_centre + m (r.r 1 - r r^T), r from the point to the centre
struct Top {
  std::size_t body = 0;
  long double mass = 1;
  LongVec pivot{0.0L}, arm{0.0L}, gravity{0.0L}, spin{0.0L};  // gravity in the world's axes
  LongQuat orientation{1, 0, 0, 0};
  LongMat inertia{1}, inverse{1};
};

struct TopMoment {
  LongQuat orientation{1, 0, 0, 0};
  LongVec position{0.0L}, velocity{0.0L};
};

using TopState = DormandPrince<long double>::State;  // quaternion w, x, y, z; w in the body's axes

LongQuat quaternion_of(const TopState& y) {
  return glm::normalize(LongQuat(y[0], y[1], y[2], y[3]));
}

void top_slope(const Top& top, const TopState& y, TopState& dy) {
  const LongVec w(y[4], y[5], y[6]);
  const LongQuat q(y[0], y[1], y[2], y[3]);
  const LongVec weight = top.mass * (glm::conjugate(quaternion_of(y)) * top.gravity);
  const LongVec rate = top.inverse * (glm::cross(top.arm, weight) - glm::cross(w, top.inertia * w));
  const LongQuat turning = q * LongQuat(0, w.x, w.y, w.z) * 0.5L;
  dy = {turning.w, turning.x, turning.y, turning.z, rate.x, rate.y, rate.z};
}

std::vector<TopMoment> top_motion(const Top& top, const ProblemSpec& problem) {
  const LongQuat& q = top.orientation;
  TopState y{q.w, q.x, q.y, q.z, top.spin.x, top.spin.y, top.spin.z};
  TopState scale(7, 1.0L);
  const long double fastest =
      std::max(1.0L, std::max({std::abs(y[4]), std::abs(y[5]), std::abs(y[6])}));
  for (std::size_t i = 4; i < 7; ++i) scale[i] = fastest;
  DormandPrince<long double> method(1e-16L, scale);
  std::vector<TopMoment> all;
  long double time = 0;
  for (std::uint32_t n = 0; n <= problem.samples; ++n) {
    const long double end = static_cast<long double>(problem.seconds) * n / problem.samples;
    method.run([&](long double, const TopState& now, TopState& dy) { top_slope(top, now, dy); },
               time, end, y);
    time = end;
    const LongQuat at = quaternion_of(y);
    const LongVec w(y[4], y[5], y[6]);
    all.push_back({at, top.pivot + at * top.arm, at * glm::cross(w, top.arm)});
  }
  return all;
}

class HeavyTop : public ErrorMetric {
 public:
  HeavyTop(const Scenario& scenario, const Top& top,
           std::shared_ptr<const std::vector<TopMoment>> exact)
      : scenario_(scenario), top_(top), exact_(std::move(exact)), gaps_(scenario) {}

  void look(const Observation& now) override {
    const TopMoment& exact = exact_->at(next_++);
    const BodyState& state = now.states[top_.body];
    const glm::dquat q = state.orientation.q;
    const LongQuat off = glm::conjugate(exact.orientation) * LongQuat(q.w, q.x, q.y, q.z);
    angle_.meet(static_cast<double>(
        2 * std::atan2(std::sqrt(off.x * off.x + off.y * off.y + off.z * off.z), std::abs(off.w))));
    const auto length = static_cast<double>(glm::length(top_.arm));
    place_.meet(glm::length(state.position - Vec<3>(exact.position)) / length);
    gaps_.look(now.states);
    gap_ = gaps_.worst() / length;
  }
  std::vector<Norm> norms() const override {
    return {{"att", angle_.value(), "rad",
             "largest angle over the run by which the orientation is off"},
            {"place", place_.value(), "1",
             "largest error of the centre's place over the run, over its distance from the pin"},
            {"joint", gap_, "1",
             "widest gap of the pin over the run, over the centre's distance from it"}};
  }
  std::string reference() const override { return "Dormand-Prince, long double"; }
  std::unique_ptr<ErrorMetric> fresh() const override {
    return std::make_unique<HeavyTop>(scenario_, top_, exact_);
  }

 private:
  const Scenario& scenario_;
  Top top_;
  std::shared_ptr<const std::vector<TopMoment>> exact_;  // at each sample
  JointGaps gaps_;
  std::size_t next_ = 0;
  Worst angle_, place_;
  double gap_ = 0;
};

Top top_of(const Scenario& scenario) {
  if (scenario.world.dimension != 3) refuse_problem(scenario, "the world must be solid");
  require_links(scenario, 1);
  require_nothing_else(scenario);
  const LinkSpec& link = scenario.links.front();
  Top top;
  top.body = the_body(scenario);
  const BodySpec& body = scenario.bodies[top.body];
  if (link.kind != LinkSpec::Kind::pin || link.a != top.body || link.b)
    refuse_problem(scenario, "it needs a pin from the body to a point of the world");
  if (body.linear_drag != 0 || body.angular_drag != 0)
    refuse_problem(scenario, "nothing may brake it");
  MassProperties<3> mass = mass_of<3>(body.shape, body.density);
  if (body.mass > 0) mass = scaled_to<3>(mass, body.mass);
  if (!turns(body) || !(std::min({mass.inertia.x, mass.inertia.y, mass.inertia.z}) > 0))
    refuse_problem(scenario, "its body cannot turn; give a box `oriented = true`");
  const Rotation<3> start = turned(Rotation<3>(), body.axis * body.angle);
  top.mass = mass.mass;
  top.orientation = glm::normalize(LongQuat(start.q.w, start.q.x, start.q.y, start.q.z));
  top.pivot = link.at_b;
  top.arm = -LongVec(link.at_a);
  top.gravity = scenario.world.gravity;
  top.spin = glm::conjugate(top.orientation) * (LongVec(body.axis_of_spin()) * LongVec(body.spin));
  const long double square = glm::dot(top.arm, top.arm);
  if (!(square > 0)) refuse_problem(scenario, "its pin is at its centre");
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      top.inertia[i][j] = (i == j ? mass.inertia[i] + top.mass * square : 0.0L) -
                          top.mass * top.arm[i] * top.arm[j];
  top.inverse = glm::inverse(top.inertia);
  const LongVec centre = top.pivot + top.orientation * top.arm;
  const LongVec velocity = top.orientation * glm::cross(top.spin, top.arm);
  if (glm::length(centre - LongVec(body.position)) > 1e-12L * std::sqrt(square) ||
      glm::length(velocity - LongVec(body.velocity)) > 1e-12L * (1 + glm::length(velocity)))
    refuse_problem(scenario, "its pin is not met at first");
  return top;
}

}  // namespace

void require_heavy_top(const Scenario& scenario) { top_of(scenario); }

OwnMetric heavy_top_metric(const Scenario& scenario) {
  const Top top = top_of(scenario);
  return std::make_unique<HeavyTop>(
      scenario, top, std::make_shared<std::vector<TopMoment>>(top_motion(top, *scenario.problem)));
}

}  // namespace lantern::measure
