// Bodies on joints.
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "base/check.hpp"
#include "measure/energy_meter.hpp"
#include "measure/joint_gaps.hpp"
#include "measure/linkage.hpp"
#include "physics/mass.hpp"

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

JointGaps::JointGaps(const Scenario& scenario) {
  const std::vector<BodyState> states = first_states(scenario);
  for (const LinkSpec& link : scenario.links) {
    if (link.kind == LinkSpec::Kind::spring) continue;
    const bool is_pin = link.kind == LinkSpec::Kind::pin;
    joints_.push_back({link, is_pin ? 0 : link.rest_length.value_or(distance(link, states))});
  }
  if (joints_.empty()) refuse_problem(scenario, "it has no joints");
}

double JointGaps::distance(const LinkSpec& link, const std::vector<BodyState>& states) {
  const Vec<3> end = link.b ? point_of(states[*link.b], link.at_b) : link.at_b;
  return glm::length(point_of(states[link.a], link.at_a) - end);
}

void JointGaps::look(const std::vector<BodyState>& states) {
  for (const Joint& joint : joints_) worst_.meet(distance(joint.link, states) - joint.length);
}

namespace {

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
  std::vector<Linkage::Body> linked;
  for (const std::size_t i : bodies) linked.push_back(linked_body(scenario, i));
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
    const Vec<3> end = link.b ? point_of(states[*link.b], link.at_b) : link.at_b;
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
  double reach = 0;
  for (const std::size_t i : dynamic_bodies(scenario))
    reach = std::max(reach, glm::length(states[i].position - *fixed));
  return reach;
}

using Swinging = std::vector<std::vector<TrajectoryMetric::Exact>>;  // at each sample

std::shared_ptr<const Swinging> swinging(const Scenario& scenario) {
  const std::vector<std::size_t> bodies = dynamic_bodies(scenario);
  Linkage linkage = linkage_of(scenario, bodies);
  auto all = std::make_shared<Swinging>();
  const ProblemSpec& problem = *scenario.problem;
  for (std::uint32_t n = 0; n <= problem.samples; ++n) {
    auto& states = all->emplace_back();
    const auto& now = linkage.at(static_cast<long double>(problem.seconds) * n / problem.samples);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const Linkage::Body& body = now[i];
      states.push_back({bodies[i], Vec<3>(glm::vec<3, long double>(body.position, 0)),
                        Vec<3>(glm::vec<3, long double>(body.velocity, 0))});
    }
  }
  LANTERN_CHECK(linkage.energy_error(), <, 1e-12L);
  return all;
}

class LinkageMetric : public TrajectoryMetric {
 public:
  LinkageMetric(const Scenario& scenario, std::shared_ptr<const Swinging> exact)
      : TrajectoryMetric(reach_of(scenario),
                         std::sqrt(reach_of(scenario) * glm::length(scenario.world.gravity)),
                         [exact, part = scenario.problem->seconds / scenario.problem->samples](
                             double time, std::vector<Exact>& states) {
                           states = exact->at(static_cast<std::size_t>(std::llround(time / part)));
                         }),
        scenario_(scenario),
        exact_(std::move(exact)),
        gaps_(scenario),
        reach_(reach_of(scenario)) {}

  void look(const Observation& now) override {
    TrajectoryMetric::look(now);
    gaps_.look(now.states);
  }
  std::vector<Norm> norms() const override {
    std::vector<Norm> all = TrajectoryMetric::norms();
    all.push_back({"joint", gaps_.worst() / reach_, "1",
                   "widest gap of a joint over the run, over the reach of all"});
    return all;
  }
  std::string reference() const override { return "Dormand-Prince, long double"; }
  std::unique_ptr<ErrorMetric> fresh() const override {
    return std::make_unique<LinkageMetric>(scenario_, exact_);
  }

 private:
  const Scenario& scenario_;
  std::shared_ptr<const Swinging> exact_;
  JointGaps gaps_;
  double reach_;
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
  }
  std::vector<Norm> norms() const override {
    return {{"gap", gaps_.worst() / plank_, "1",
             "widest gap of a joint over the run, over the length of a plank"},
            energy_.gain_norm()};
  }
  std::optional<std::string> collapse() const override {
    if (!(gaps_.worst() > plank_ / 2)) return std::nullopt;
    return fmt::format("its joints part by {:.2g} planks", gaps_.worst() / plank_);
  }

 private:
  JointGaps gaps_;
  EnergyMeter energy_;
  double plank_ = 0;
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
  }
  std::vector<Norm> norms() const override {
    return {{"gain", energy_.growth(), "1",
             "largest gain of energy over the run, over what the springs hold at first"},
            {"joint", gaps_.worst(), "units", "widest gap of a joint over the run"}};
  }

 private:
  JointGaps gaps_;
  EnergyMeter energy_;
};

}  // namespace

void require_linkage(const Scenario& scenario) {
  if (scenario.world.dimension != 2) refuse_problem(scenario, "the world must be flat");
  require_nothing_else(scenario);
  if (!(glm::length(scenario.world.gravity) > 0)) refuse_problem(scenario, "there is no gravity");
  reach_of(scenario);  // refuses
  linkage_of(scenario, dynamic_bodies(scenario));
  const JointGaps gaps(scenario);
}

OwnMetric linkage_metric(const Scenario& scenario) {
  require_linkage(scenario);
  return std::make_unique<LinkageMetric>(scenario, swinging(scenario));
}

OwnMetric bridge_metric(const Scenario& s) { return std::make_unique<Bridge>(s); }
OwnMetric springs_along_pins_metric(const Scenario& s) {
  return std::make_unique<SpringsAlongPins>(s);
}

}  // namespace lantern::measure
