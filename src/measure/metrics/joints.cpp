// Bodies on joints.

#include "measure/forms/linkage.hpp"
#include "measure/metrics/reading.hpp"
#include "physics/body.hpp"

namespace lantern::measure {

std::vector<BodyState> first_states(const Scenario& scenario) {
  std::vector<BodyState> states(scenario.bodies.size());
  for (std::size_t i = 0; i < states.size(); ++i) {
    const BodySpec& body = scenario.bodies[i];
    const bool flat = scenario.world.dimension == 2;
    states[i].there = true;
    states[i].position = body.position;
    states[i].velocity = body.velocity;
    states[i].orientation =
        turned(Rotation<3>(), (flat ? Vec<3>(0, 0, 1) : body.axis) * body.angle);
    states[i].angle = body.angle;
  }
  return states;
}

Vec<3> point_of(const BodyState& state, const Vec<3>& at) {
  return state.position + matrix(state.orientation) * at;
}

Vec<3> far_end(const LinkSpec& link, const std::vector<BodyState>& states) {
  return link.b ? point_of(states[*link.b], link.at_b) : link.at_b;
}

namespace {

// --- how far the joints of a scenario part, by the states of its bodies alone ---

class JointGaps {
 public:
  // Of its pins and rods. Refuses a scenario without any.
  explicit JointGaps(const Scenario& scenario) {
    const std::vector<BodyState> states = first_states(scenario);
    for (const LinkSpec& link : scenario.links) {
      if (link.kind == LinkSpec::Kind::spring) continue;
      const bool is_pin = link.kind == LinkSpec::Kind::pin;
      joints_.push_back({link, is_pin ? 0 : link.rest_length.value_or(distance(link, states))});
    }
    if (joints_.empty()) refuse_problem(scenario, "it has no joints");
  }

  void look(const std::vector<BodyState>& states) {
    for (const Joint& joint : joints_) worst_.meet(distance(joint.link, states) - joint.length);
  }
  double worst() const { return worst_.value(); }  // units, so far

 private:
  struct Joint {
    LinkSpec link;
    double length = 0;  // 0 of a pin
  };
  static double distance(const LinkSpec& link, const std::vector<BodyState>& states) {
    return glm::length(point_of(states[link.a], link.at_a) - far_end(link, states));
  }

  std::vector<Joint> joints_;
  Worst worst_;
};

// --- what swings ---

FlatLong flat_long(const Vec<3>& v) { return {v.x, v.y}; }

Linkage::Body linked_body(const Scenario& scenario, std::size_t index) {
  const BodySpec& body = scenario.bodies[index];
  if (body.brain != Brain::none || body.linear_drag != 0 || body.angular_drag != 0)
    refuse_problem(scenario, fmt::format("'{}' is braked or steered", body.name));
  require_at_rest(scenario, index);
  MassProperties<2> mass = mass_of<2>(in_dimension<2>(body.shape), body.density);
  if (body.mass > 0) mass = scaled_to<2>(mass, body.mass);
  if (!turns(body) || !(mass.inertia > 0))
    refuse_problem(scenario, fmt::format("'{}' does not turn", body.name));
  return {mass.mass, mass.inertia, flat_long(body.position), FlatLong(0.0L), body.angle, 0};
}

// Bodies by their place in the linkage; what does not move is a point of the world.
Linkage linkage_of(const Scenario& scenario, const std::vector<std::size_t>& bodies) {
  const auto place = [&](std::size_t body) -> std::optional<std::size_t> {
    const auto found = std::ranges::lower_bound(bodies, body);
    if (found == bodies.end() || *found != body) return std::nullopt;
    return static_cast<std::size_t>(found - bodies.begin());
  };
  const std::vector<BodyState> states = first_states(scenario);
  auto linked = mapped(bodies, [&](std::size_t i) { return linked_body(scenario, i); });
  std::vector<Linkage::Joint> joints;
  for (LinkSpec link : scenario.links) {
    if (link.kind == LinkSpec::Kind::spring) refuse_problem(scenario, "it has a spring");
    if (!place(link.a) && link.b) {
      link.a = std::exchange(*link.b, link.a);
      std::swap(link.at_a, link.at_b);
    }
    if (!place(link.a)) refuse_problem(scenario, "nothing moves on one of its joints");
    Linkage::Joint joint{*place(link.a), {}, flat_long(link.at_a), flat_long(link.at_b), {}};
    if (link.b) joint.b = place(*link.b);
    const Vec<3> end = far_end(link, states);
    if (link.b && !joint.b) joint.at_b = flat_long(end);
    const double gap = glm::length(point_of(states[link.a], link.at_a) - end);
    if (link.kind == LinkSpec::Kind::distance) joint.length = link.rest_length.value_or(gap);
    if (std::abs(gap - static_cast<double>(joint.length.value_or(0))) > 1e-12 * (1 + gap))
      refuse_problem(scenario, "a joint is not met at first");
    joints.push_back(joint);
  }
  return Linkage(std::move(linked), std::move(joints), flat_long(scenario.world.gravity));
}

// How far it reaches at first from its first fixed point.
double reach_of(const Scenario& scenario) {
  const std::vector<BodyState> states = first_states(scenario);
  std::optional<Vec<3>> fixed;
  for (const LinkSpec& link : scenario.links)
    for (const bool first : {true, false}) {
      const std::optional<std::size_t> body = first ? std::optional(link.a) : link.b;
      if (body && scenario.bodies[*body].kind == BodyKind::dynamic_body) continue;
      if (!fixed) fixed = body ? point_of(states[*body], first ? link.at_a : link.at_b) : link.at_b;
    }
  if (!fixed) refuse_problem(scenario, "it hangs on nothing");
  return greatest_of<double>(0, dynamic_bodies(scenario), [&](std::size_t i) {
    return glm::length(states[i].position - *fixed);
  });
}

using Swinging = std::vector<std::vector<TrajectoryMetric::Exact>>;  // at each sample

std::shared_ptr<const Swinging> swinging(const Scenario& scenario) {
  const std::vector<std::size_t> bodies = dynamic_bodies(scenario);
  Linkage linkage = linkage_of(scenario, bodies);
  auto all = at_samples(*scenario.problem, [&](long double time) {
    std::vector<TrajectoryMetric::Exact> states;
    for (const Linkage::Body& body : linkage.at(time))
      states.push_back({bodies[states.size()], Vec<3>(LongVec(body.position, 0)),
                        Vec<3>(LongVec(body.velocity, 0))});
    return states;
  });
  LANTERN_CHECK(linkage.energy_error(), <, 1e-12L);
  return all;
}

class LinkageMetric : public TrajectoryMetric {
 public:
  LinkageMetric(const Scenario& scenario, const std::shared_ptr<const Swinging>& exact)
      : TrajectoryMetric(reach_of(scenario),
                         std::sqrt(reach_of(scenario) * glm::length(scenario.world.gravity)),
                         [exact, part = scenario.problem->seconds / scenario.problem->samples](
                             double time, std::vector<Exact>& states) {
                           states = exact->at(static_cast<std::size_t>(std::llround(time / part)));
                         }),
        gaps_(scenario),
        reach_(reach_of(scenario)) {}

  void look(const Observation& now) override {
    TrajectoryMetric::look(now);
    gaps_.look(now.states);
    gap_.set(gaps_.worst() / reach_);
  }
  std::string reference() const override { return "Dormand-Prince, long double"; }

 private:
  JointGaps gaps_;
  double reach_;
  Worst& gap_ = norm("joint", "1", "widest gap of a joint over the run, over the reach of all");
};

// --- what should hold ---

// Planks on pins, on which something falls.
class Bridge : public ErrorMetric {
 public:
  explicit Bridge(const Scenario& scenario) : gaps_(scenario), energy_(scenario) {
    for (const LinkSpec& link : scenario.links)
      if (link.kind != LinkSpec::Kind::spring)
        plank_ = std::max(plank_, 2 * reach_along(scenario.bodies[link.a], Vec<3>(1, 0, 0)));
    if (!(plank_ > 0)) refuse_problem(scenario, "its joints hold nothing that has a length");
  }
  void look(const Observation& now) override {
    gaps_.look(now.states);
    energy_.look(now);
    gap_.set(gaps_.worst() / plank_);
    gain_.set(energy_.gain());
  }
  std::optional<std::string> collapse() const override {
    if (!(gap_.value() > 0.5)) return std::nullopt;
    return fmt::format("its joints part by {:.2g} planks", gap_.value());
  }

 private:
  JointGaps gaps_;
  EnergyMeter energy_;
  double plank_ = 0;
  Worst& gap_ = norm("gap", "1", "widest gap of a joint over the run, over the length of a plank");
  Worst& gain_ = norm("gain", "1", EnergyMeter::kGainMeaning);
};

// Stretched springs along a chain of bodies that pins hold: whatever the step, nothing may grow.
class SpringsAlongPins : public ErrorMetric {
 public:
  explicit SpringsAlongPins(const Scenario& scenario) : gaps_(scenario), energy_(scenario) {
    if (scenario.world.gravity != Vec<3>(0.0)) refuse_problem(scenario, "it has gravity");
    require_nothing_else(scenario);
    if (std::ranges::none_of(scenario.links, [](const LinkSpec& link) {
          return link.kind == LinkSpec::Kind::spring && link.stiffness > 0;
        }))
      refuse_problem(scenario, "it has no springs");
  }
  void look(const Observation& now) override {
    gaps_.look(now.states);
    energy_.look(now);
    gain_.set(energy_.growth());
    gap_.set(gaps_.worst());
  }

 private:
  JointGaps gaps_;
  EnergyMeter energy_;
  Worst& gain_ =
      norm("gain", "1", "largest gain of energy over the run, over what the springs hold at first");
  Worst& gap_ = norm("joint", "units", "widest gap of a joint over the run");
};

void require_linkage(const Scenario& scenario) {
  if (scenario.world.dimension != 2) refuse_problem(scenario, "the world must be flat");
  require_nothing_else(scenario);
  if (!(glm::length(scenario.world.gravity) > 0)) refuse_problem(scenario, "there is no gravity");
  reach_of(scenario);  // refuses
  linkage_of(scenario, dynamic_bodies(scenario));
  const JointGaps gaps(scenario);
}

MetricMaker linkage_metric(const Scenario& scenario) {
  require_linkage(scenario);
  return [&scenario, exact = swinging(scenario)] {
    return std::make_unique<LinkageMetric>(scenario, exact);
  };
}
// --- a body that turns about a fixed point under gravity ---

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

std::shared_ptr<const std::vector<TopMoment>> top_motion(const Top& top,
                                                         const ProblemSpec& problem) {
  const LongQuat& q = top.orientation;
  TopState y{q.w, q.x, q.y, q.z, top.spin.x, top.spin.y, top.spin.z};
  TopState scale(7, 1.0L);
  const long double fastest =
      std::max(1.0L, std::max({std::abs(y[4]), std::abs(y[5]), std::abs(y[6])}));
  for (std::size_t i = 4; i < 7; ++i) scale[i] = fastest;
  DormandPrince<long double> method(1e-16L, scale);
  long double time = 0;
  return at_samples(problem, [&](long double end) -> TopMoment {
    method.run([&](long double, const TopState& now, TopState& dy) { top_slope(top, now, dy); },
               time, end, y);
    time = end;
    const LongQuat at = quaternion_of(y);
    const LongVec w(y[4], y[5], y[6]);
    return {at, top.pivot + at * top.arm, at * glm::cross(w, top.arm)};
  });
}

class HeavyTop : public ErrorMetric {
 public:
  HeavyTop(const Scenario& scenario, const Top& top,
           std::shared_ptr<const std::vector<TopMoment>> exact)
      : top_(top), exact_(std::move(exact)), gaps_(scenario) {}

  void look(const Observation& now) override {
    const TopMoment& exact = exact_->at(next_++);
    const BodyState& state = now.states[top_.body];
    angle_.meet(angle_between(exact.orientation, state));
    const auto length = static_cast<double>(glm::length(top_.arm));
    place_.meet(glm::length(state.position - Vec<3>(exact.position)) / length);
    gaps_.look(now.states);
    gap_.set(gaps_.worst() / length);
  }
  std::string reference() const override { return "Dormand-Prince, long double"; }

 private:
  Top top_;
  std::shared_ptr<const std::vector<TopMoment>> exact_;  // at each sample
  JointGaps gaps_;
  std::size_t next_ = 0;
  Worst& angle_ = norm("att", "rad", kAttitudeMeaning);
  Worst& place_ =
      norm("place", "1",
           "largest error of the centre's place over the run, over its distance from the pin");
  Worst& gap_ =
      norm("joint", "1", "widest gap of the pin over the run, over the centre's distance from it");
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

void require_heavy_top(const Scenario& scenario) { top_of(scenario); }

MetricMaker heavy_top_metric(const Scenario& scenario) {
  const Top top = top_of(scenario);
  const auto exact = top_motion(top, *scenario.problem);
  return [&scenario, top, exact] { return std::make_unique<HeavyTop>(scenario, top, exact); };
}

}  // namespace

std::span<const Problem> joints_problems() {
  static constexpr Problem kAll[] = {{Solution::linkage, linkage_metric, require_linkage},
                                     {Solution::heavy_top, heavy_top_metric, require_heavy_top},
                                     {Solution::bridge, made_of<Bridge>},
                                     {Solution::springs_along_pins, made_of<SpringsAlongPins>}};
  return kAll;
}

}  // namespace lantern::measure
