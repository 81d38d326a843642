

#include "measure/solvers.hpp"

#include "measure/forms/dormand_prince.hpp"
#include "physics/integrate/smooth_system.hpp"
#include "run/engine.hpp"
#include "run/players.hpp"

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

double tolerance_of(const Scenario& scenario, double h) {
  const double ratio = h / scenario.problem->step;
  return std::clamp(1e-3 * ratio * ratio * ratio * ratio * ratio, 1e-14, 1e-3);
}

// The forces are the engine's own. The unknowns are how far each body has come and how its velocity
// has changed, so that nothing is lost far from the origin.
template <int D>
class PointSimulation : public Simulation {
 public:
  PointSimulation(const Scenario& scenario, double h)
      : count_(scenario.bodies.size()),
        h_(h),
        players_(scenario),
        system_(entered(scenario), players_.world().forces(), evaluations_),
        state_(system_.start()),
        y_(2 * D * system_.movers().size(), 0.0),
        method_(tolerance_of(scenario, h), scale(scenario)) {}

  void advance(std::uint64_t steps) override {
    steps_ += steps;
    const double end = static_cast<double>(steps_) * h_;
    method_.run(
        [this](double, const std::vector<double>& y, std::vector<double>& dy) { slope(y, dy); },
        time_, end, y_);
    time_ = end;
    put(y_);
  }

  void observe(std::vector<BodyState>& states) const override {
    states.assign(count_, BodyState{});
    for (std::size_t i = 0; i < system_.bodies().size(); ++i) {
      const Body<D>& body = system_.bodies()[i];
      const auto index = players_.index_of(body.id);
      if (!index) continue;
      BodyState& state = states[*index];
      state.there = true;
      state.position = solid(Vec<D>(body.position + state_.shift[i]));
      state.velocity = solid(system_.velocity(state_, i));
    }
  }

  Counted counted() const override { return {method_.steps(), evaluations_, 0, 0}; }

 private:
  std::span<const Body<D>> entered(const Scenario& scenario) {
    for (std::size_t i = 0; i < scenario.bodies.size(); ++i) players_.enter(i);
    return players_.world().bodies();
  }

  // Of places, how far apart the bodies and the ends of springs are; of velocities the greatest
  // one, or that which the forces give over this length.
  std::vector<double> scale(const Scenario& scenario) {
    Box<3> box{scenario.bodies.front().position, scenario.bodies.front().position};
    double speed = 0;
    for (const BodySpec& body : scenario.bodies) {
      box = united(box, {body.position, body.position});
      speed = std::max(speed, glm::length(body.velocity));
    }
    for (const LinkSpec& link : scenario.links)
      if (!link.b) box = united(box, {link.at_b, link.at_b});
    double length = glm::length(box.size());
    const Pull<D> pull = system_.evaluate(state_);
    double most = 0;
    for (const Vec<D>& a : pull.acceleration) most = std::max(most, glm::length(a));
    const double seconds = scenario.problem->seconds;
    if (!(length > 0)) length = seconds * (speed + seconds * most);
    speed = std::max(speed, std::min(std::sqrt(length * most), seconds * most));
    std::vector<double> all(y_.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
      const double size = k % (2 * D) < D ? length : speed;
      all[k] = size > 0 ? size : 1;
    }
    return all;
  }

  void put(const std::vector<double>& y) {
    for (std::size_t n = 0; n < system_.movers().size(); ++n) {
      const std::size_t i = system_.movers()[n];
      for (int c = 0; c < D; ++c) {
        state_.shift[i][c] = y[2 * D * n + c];
        state_.kick[i][c] = y[2 * D * n + D + c];
      }
    }
  }

  void slope(const std::vector<double>& y, std::vector<double>& dy) {
    put(y);
    const Pull<D> pull = system_.evaluate(state_);
    for (std::size_t n = 0; n < system_.movers().size(); ++n) {
      const std::size_t i = system_.movers()[n];
      const Vec<D> velocity = system_.velocity(state_, i);
      for (int c = 0; c < D; ++c) {
        dy[2 * D * n + c] = velocity[c];
        dy[2 * D * n + D + c] = pull.acceleration[i][c];
      }
    }
  }

  std::size_t count_;
  double h_;
  double time_ = 0;
  std::uint64_t steps_ = 0;
  std::uint64_t evaluations_ = 0;
  Players<D> players_;
  SmoothSystem<D> system_;
  SmoothState<D> state_;
  std::vector<double> y_;
  DormandPrince<double> method_;
};

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
    return named({"explicit_gyroscopic", "splitting_2", "splitting_4", "exact"});
  Method as_written;
  as_written.name = "as written";
  return {as_written};
}

std::optional<std::string> DormandPrinceSolver::cannot(const Scenario& scenario) const {
  if (!scenario.problem) return "it has no [problem]";
  if (scenario.world.contacts != ContactMethod::none) return "its bodies collide";
  bool moves = false;
  for (const BodySpec& body : scenario.bodies) {
    moves = moves || body.kind == BodyKind::dynamic_body;
    if (body.kind == BodyKind::kinematic_body)
      return fmt::format("body '{}' is kinematic", body.name);
    if (body.spin != 0) return fmt::format("body '{}' turns", body.name);
  }
  if (!moves) return "nothing moves";
  for (const LinkSpec& link : scenario.links) {
    if (link.kind != LinkSpec::Kind::spring) return "it has joints";
    if (link.at_a != Vec<3>(0.0) || (link.b && link.at_b != Vec<3>(0.0)))
      return "its springs turn bodies";
  }
  return std::nullopt;
}

std::unique_ptr<Simulation> DormandPrinceSolver::start(const Scenario& scenario, double h) const {
  if (const auto reason = cannot(scenario))
    throw Refused(fmt::format("dormand_prince: {}", *reason));
  if (scenario.world.dimension == 3) return std::make_unique<PointSimulation<3>>(scenario, h);
  return std::make_unique<PointSimulation<2>>(scenario, h);
}

}  // namespace lantern::measure
