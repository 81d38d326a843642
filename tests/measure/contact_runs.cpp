#include "measure/contact_runs.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "base/file.hpp"
#include "language/method.hpp"
#include "run/engine.hpp"

namespace lantern::measure {
namespace {

class EngineRun : public Simulation {
 public:
  explicit EngineRun(const Scenario& scenario) : engine_(make_engine(scenario, work_)) {
    for (std::size_t i = 0; i < scenario.bodies.size(); ++i) engine_->enter(i);
  }
  void advance(std::uint64_t steps) override {
    while (steps-- > 0) engine_->step();
  }
  void act(const Verb& verb) override { engine_->apply(std::get<Move>(verb)); }
  void observe(std::vector<BodyState>& states) const override { engine_->observe(states); }
  std::uint64_t impacts() const override { return engine_->world_work().impacts_located; }

 private:
  Work work_;
  std::unique_ptr<Engine> engine_;
};

}  // namespace

Scenario problem(const std::string& name, const Changes& changes) {
  std::string text = read_file(LANTERN_ROOT "/scenarios/problems/" + name + ".toml", 1 << 20);
  for (const auto& [from, to] : changes) {
    std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << name << " has no '" << from << "'";
    for (; at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  }
  return parse_scenario(text, name + ".toml");
}

Observation at_start(const Scenario& scenario) {
  Observation now;
  for (const BodySpec& body : scenario.bodies) {
    BodyState state;
    state.there = true;
    state.position = body.position;
    state.velocity = body.velocity;
    state.orientation = turned(Rotation<3>(), body.axis * body.angle);
    now.states.push_back(state);
  }
  return now;
}

Norms norms_of(const ErrorMetric& metric) {
  Norms norms;
  for (const Norm& norm : metric.norms()) norms[norm.name] = norm.value;
  return norms;
}

Norms run(const Scenario& scenario, const std::string& method, double step) {
  const ProblemSpec& spec = *scenario.problem;
  const double between = spec.seconds / spec.samples;
  const auto steps = static_cast<std::uint64_t>(std::ceil(between / step - 1e-9));
  const double h = between / static_cast<double>(steps);
  const Scenario moved = moved_by(scenario, method_named(method).value(), h);
  EngineRun simulation(moved);
  const auto metric = metrics_of(moved)();
  Observation now;
  for (std::uint32_t i = 0; i <= spec.samples; ++i) {
    if (i > 0) simulation.advance(steps);
    now.time = static_cast<double>(i * steps) * h;
    simulation.observe(now.states);
    now.impacts = simulation.impacts();
    metric->look(now);
    metric->interfere(now, simulation);
  }
  return norms_of(*metric);
}

}  // namespace lantern::measure
