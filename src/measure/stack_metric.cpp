// Boxes that lie one on the other and should go on to do so. The contact below each must carry it
// and all above: in a step of h seconds by the impulse h g (sum of their masses).
#include <algorithm>

#include <fmt/format.h>

#include "measure/error_metrics.hpp"
#include "measure/problem_scene.hpp"

namespace lantern {
namespace {

std::vector<std::size_t> from_below(const Scenario& scenario, const Vec<3>& up) {
  std::vector<std::size_t> bodies = moving_bodies(scenario);
  std::stable_sort(bodies.begin(), bodies.end(), [&](std::size_t a, std::size_t b) {
    return glm::dot(scenario.bodies[a].position, up) < glm::dot(scenario.bodies[b].position, up);
  });
  return bodies;
}

class Stack : public ErrorMetric {
 public:
  explicit Stack(const Scenario& scenario)
      : ground_(ground_of(scenario)),
        bodies_(from_below(scenario, ground_.normal)),
        burdens_(scenario, bodies_) {
    require_links(scenario, 0);
    pull_onto(scenario, ground_);
    require_on_ground(scenario, ground_, bodies_.front());
    const Vec<3>& foot = scenario.bodies[bodies_.front()].position;
    double face = ground_.height;
    for (const std::size_t i : bodies_) {
      const BodySpec& body = scenario.bodies[i];
      if (body.velocity != Vec<3>(0.0) || body.spin != 0)
        refuse_problem(scenario, fmt::format("'{}' does not begin at rest", body.name));
      const double reach = reach_along(body, ground_.normal);
      const double at = glm::dot(body.position, ground_.normal);
      if (std::abs(at - reach - face) > 1e-9 * (reach + std::abs(face)))
        refuse_problem(scenario, fmt::format("'{}' does not lie on the one below", body.name));
      const Vec<3> off = body.position - foot;
      if (glm::length(off - ground_.normal * glm::dot(off, ground_.normal)) > 1e-9 * reach)
        refuse_problem(scenario, fmt::format("'{}' does not lie in one line", body.name));
      face = at + reach;
      reaches_.push_back(reach);
    }
  }

  void look(const Observation& now) override {
    double face = ground_.height;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const double at = glm::dot(now.states[bodies_[i]].position, ground_.normal);
      depth_.meet(face - (at - reaches_[i]));
      face = at + reaches_[i];
    }
    burdens_.look(now);
  }

  std::vector<Norm> norms() const override {
    return {{"depth", depth_.value(), "units",
             "deepest overlap or widest gap of a contact over the run, by the heights of the "
             "centres; it starts at rest with neither, so 0 means undisturbed"},
            {"impulse", burdens_.worst(), "1",
             "largest error of a contact's mean impulse between two samples, relative"}};
  }

 private:
  Footing ground_;
  std::vector<std::size_t> bodies_;  // from below
  std::vector<double> reaches_;      // half heights
  Burdens burdens_;
  Worst depth_;
};

}  // namespace

std::unique_ptr<ErrorMetric> stack_metric(const Scenario& scenario) {
  return std::make_unique<Stack>(scenario);
}

}  // namespace lantern
