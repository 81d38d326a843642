#include "measure/lantern_solver.hpp"

#include <algorithm>

#include "run/engine.hpp"

namespace lantern::measure {
namespace {

class WorldSimulation : public Simulation {
 public:
  explicit WorldSimulation(Scenario scenario)
      : scenario_(std::move(scenario)), engine_(make_engine(scenario_, work_)) {
    if (!scenario_.problem) return;
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i) engine_->enter(i);
  }

  void advance(std::uint64_t steps) override {
    for (std::uint64_t i = 0; i < steps; ++i) engine_->step();
  }

  void act(const Verb& verb) override { carry_out(verb, *engine_, scenario_.world.time_step); }

  void observe(std::vector<BodyState>& states) const override { engine_->observe(states); }
  std::uint64_t impacts() const override { return engine_->world_work().impacts_located; }
  std::uint64_t hash() const override { return engine_->world_hash(); }
  const WorldWork* world_work() const override { return &engine_->world_work(); }
  Counted counted() const override {
    const WorldWork& work = engine_->world_work();
    return {work.steps, work.force_evaluations, work.constraint_rows, work.pair_tests};
  }

 private:
  Scenario scenario_;
  Work work_;
  std::unique_ptr<Engine> engine_;
};

bool has_forces(const Scenario& scenario) {
  const WorldSpec& world = scenario.world;
  if (world.gravity != Vec<3>(0.0) || world.gravitation > 0 || !scenario.links.empty()) return true;
  const auto brakes = [](const BodySpec& b) { return b.linear_drag > 0 || b.angular_drag > 0; };
  const auto pushes = [](const Step& s) { return std::holds_alternative<ApplyForce>(s.verb); };
  return std::ranges::any_of(scenario.bodies, brakes) ||
         std::ranges::any_of(scenario.steps, pushes);
}

// Boxes along the axes and half-spaces keep to them.
bool turns_in_space(const BodySpec& body) {
  return body.spin != 0 && body.kind != BodyKind::static_body && geometry::turns<3>(body.shape);
}

std::vector<Method> named(const std::vector<std::string>& names) {
  std::vector<Method> methods;
  for (const std::string& name : names) methods.push_back(*method_named(name));
  return methods;
}

}  // namespace

std::optional<std::string> LanternSolver::cannot(const Scenario& scenario) const {
  if (method_.contacts && scenario.world.contacts == ContactMethod::none)
    return "its bodies do not collide";
  const auto is_joint = [](const LinkSpec& link) { return link.kind != LinkSpec::Kind::spring; };
  if (method_.contacts == ContactMethod::lecture && std::ranges::any_of(scenario.links, is_joint))
    return "the lecture has no joints";
  if (method_.rotation && scenario.world.dimension == 2) return "a flat body turns by its spin";
  return std::nullopt;
}

std::unique_ptr<Simulation> LanternSolver::start(const Scenario& scenario, double h) const {
  return std::make_unique<WorldSimulation>(moved_by(scenario, method_, h));
}

std::vector<Method> methods_for(const Scenario& scenario) {
  if (scenario.problem && !scenario.problem->methods.empty())
    return named(scenario.problem->methods);
  if (scenario.world.contacts != ContactMethod::none)
    return named({"lecture", "impulse", "impulse:100", "soft", "soft:16"});
  if (has_forces(scenario))
    return named({"explicit_euler", "semi_implicit_euler", "velocity_verlet", "runge_kutta_4",
                  "implicit_midpoint", "implicit_euler"});
  if (scenario.world.dimension == 3 && std::ranges::any_of(scenario.bodies, turns_in_space))
    return named({"explicit_gyroscopic", "splitting_2", "splitting_4"});
  Method as_written;
  as_written.name = "as written";
  return {as_written};
}

}  // namespace lantern::measure
