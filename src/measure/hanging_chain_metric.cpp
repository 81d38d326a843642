// A chain that hangs straight down from a fixed point. No link should grow, and the pull in each is
// the weight of all below it.
#include <utility>

#include <fmt/format.h>

#include "measure/error_metrics.hpp"
#include "measure/problem_scene.hpp"

namespace lantern {
namespace {

bool are_nearly_parallel(const Vec<3>& a, const Vec<3>& b) {
  return glm::length(glm::cross(a, b)) <= 1e-9 * (glm::length(a) + 1) * glm::length(b);
}

// Joints in order from above, each turned so that `a` is its lower end.
std::vector<LinkSpec> from_above(const Scenario& scenario) {
  const auto is_fixed = [&](const std::optional<std::size_t>& body) {
    return !body || scenario.bodies[*body].kind == BodyKind::static_body;
  };
  if (scenario.world.gravity == Vec<3>(0.0)) refuse_problem(scenario, "there is no gravity");
  if (scenario.links.size() != moving_bodies(scenario).size())
    refuse_problem(scenario, "it needs one joint for each body");
  std::vector<LinkSpec> chain;
  std::vector<bool> used(scenario.links.size());
  std::optional<std::size_t> above;  // nothing: fixed
  while (chain.size() < used.size()) {
    const std::size_t before = chain.size();
    for (std::size_t i = 0; i < used.size() && chain.size() == before; ++i) {
      LinkSpec link = scenario.links[i];
      if (link.kind == LinkSpec::Kind::spring) refuse_problem(scenario, "it has a spring");
      const auto hangs_on = [&](const std::optional<std::size_t>& end) {
        return above ? end == above : is_fixed(end);
      };
      if (used[i] || (!hangs_on(link.b) && !(link.b && hangs_on(link.a)))) continue;
      if (!hangs_on(link.b)) {
        link.b = std::exchange(link.a, *link.b);
        std::swap(link.at_a, link.at_b);
      }
      used[i] = true;
      above = link.a;
      chain.push_back(link);
    }
    if (chain.size() == before || is_fixed(above))
      refuse_problem(scenario, "its joints are no chain that hangs from one fixed point");
  }
  return chain;
}

std::vector<std::size_t> lower_ends(const std::vector<LinkSpec>& links) {
  std::vector<std::size_t> bodies;
  for (const LinkSpec& link : links) bodies.push_back(link.a);
  return bodies;
}

class HangingChain : public ErrorMetric {
 public:
  explicit HangingChain(const Scenario& scenario)
      : links_(from_above(scenario)), bodies_(lower_ends(links_)), burdens_(scenario, bodies_) {
    const Vec<3>& g = scenario.world.gravity;
    for (const std::size_t i : moving_bodies(scenario))
      if (scenario.bodies[i].velocity != Vec<3>(0.0) || scenario.bodies[i].spin != 0)
        refuse_problem(scenario,
                       fmt::format("'{}' does not begin at rest", scenario.bodies[i].name));
    const std::vector<BodyState> states = first_states(scenario);
    for (const LinkSpec& link : links_) {
      const Vec<3> span = upper(link, states) - lower(link, states);
      if (glm::dot(span, g) > 0 || !are_nearly_parallel(span, g))
        refuse_problem(scenario, "it does not hang straight down");
      const bool is_pin = link.kind == LinkSpec::Kind::pin;
      const double length = is_pin ? 0 : link.rest_length.value_or(glm::length(span));
      if (std::abs(length - glm::length(span)) > 1e-9 * (length + 1))
        refuse_problem(scenario, "a joint is not as long as it is at first");
      length_ += length;
    }
    for (const std::size_t i : bodies_) {
      const Vec<3> off = scenario.bodies[i].position - scenario.bodies[bodies_.front()].position;
      if (!are_nearly_parallel(off, g)) refuse_problem(scenario, "it does not hang straight down");
    }
  }

  void look(const Observation& now) override {
    double grown = -length_;
    for (const LinkSpec& link : links_)
      grown += glm::length(upper(link, now.states) - lower(link, now.states));
    stretch_.meet(grown);
    burdens_.look(now);
  }

  std::vector<Norm> norms() const override {
    return {{"stretch", stretch_.value(), "units",
             "largest change of the chain's length over the run; it starts at rest with its exact "
             "length, so 0 means undisturbed"},
            {"tension", burdens_.worst(), "1",
             "largest error of the mean pull of a joint between two samples, relative"}};
  }

 private:
  static std::vector<BodyState> first_states(const Scenario& scenario) {
    std::vector<BodyState> states(scenario.bodies.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
      const BodySpec& body = scenario.bodies[i];
      states[i].position = body.position;
      states[i].orientation = turned(Rotation<3>(), body.axis * body.angle);
    }
    return states;
  }

  Vec<3> lower(const LinkSpec& link, const std::vector<BodyState>& states) const {
    return states[link.a].position + matrix(states[link.a].orientation) * link.at_a;
  }
  Vec<3> upper(const LinkSpec& link, const std::vector<BodyState>& states) const {
    if (!link.b) return link.at_b;
    return states[*link.b].position + matrix(states[*link.b].orientation) * link.at_b;
  }

  std::vector<LinkSpec> links_;  // from above
  std::vector<std::size_t> bodies_;
  Burdens burdens_;
  double length_ = 0;
  Worst stretch_;
};

}  // namespace

std::unique_ptr<ErrorMetric> hanging_chain_metric(const Scenario& scenario) {
  return std::make_unique<HangingChain>(scenario);
}

}  // namespace lantern
