#include "measure/solvers.hpp"

#include <filesystem>

#include <dlfcn.h>
#include <fmt/format.h>

#include "measure/forms/dormand_prince.hpp"
#include "physics/body.hpp"
#include "physics/integrate/smooth_system.hpp"
#include "run/engine.hpp"
#include "run/players.hpp"

namespace lantern::measure {
namespace {

class WorldSimulation : public Simulation {
 public:
  explicit WorldSimulation(Scenario scenario) : scenario_(std::move(scenario)) {
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
  std::unique_ptr<Engine> engine_ = make_engine(scenario_, work_);
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
  return mapped(names, [](const std::string& name) { return *method_named(name); });
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
  SmoothState<D> state_ = system_.start();
  std::vector<double> y_ = std::vector<double>(2 * D * system_.movers().size());
  DormandPrince<double> method_;
};

namespace fs = std::filesystem;

// Where the module is; empty if it was not built: beside the lab, which is a module itself, or
// above the folder of the tests, which contain it.
fs::path place_of(const PeerModule& module) {
  static const int here = 0;
  Dl_info lab{};
  ::dladdr(&here, &lab);
  std::error_code error;
  fs::path of = lab.dli_fname;
  if (of.extension() != ".so") of = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path file = of.parent_path() / "peers" / module.file;
  return fs::is_regular_file(file, error) ? file : fs::path();
}

// As World::add derives it.
template <int D>
void weigh(PeerBody& body) {
  const double density = body.mass > 0 && body.density == 0 ? 1 : body.density;
  MassProperties<D> properties = mass_of<D>(in_dimension<D>(body.shape), density);
  if (body.mass > 0) properties = scaled_to<D>(properties, body.mass);
  body.mass = properties.mass;
  body.inertia = Vec<3>(properties.inertia);
}

PeerBody body_of(const BodySpec& spec, bool is_flat) {
  PeerBody body{spec};
  const Vec<3> axis = is_flat ? Vec<3>(0, 0, 1) : spec.axis;
  body.orientation = turned(Rotation<3>(), axis * spec.angle);
  body.turning = (is_flat ? axis : spec.axis_of_spin()) * spec.spin;
  body.attracting_mass = spec.mass;
  if (body.is_dynamic()) {
    is_flat ? weigh<2>(body) : weigh<3>(body);
    body.attracting_mass = body.mass;
  } else {
    body.mass = 0;
  }
  const bool has_inertia = std::min({body.inertia.x, body.inertia.y, body.inertia.z}) > 0;
  body.may_turn = spec.may_turn && has_inertia && turns<3>(spec.shape);
  if (body.is_dynamic() && !body.may_turn) body.turning = Vec<3>(0.0);
  return body;
}

PeerLink link_of(const LinkSpec& spec, const std::vector<PeerBody>& bodies) {
  const auto point = [&](std::size_t i, const Vec<3>& at) {
    return bodies[i].position + matrix(bodies[i].orientation) * at;
  };
  PeerLink link{spec};
  link.from = point(spec.a, spec.at_a);
  link.to = spec.b ? point(*spec.b, spec.at_b) : spec.at_b;
  link.length = spec.rest_length.value_or(glm::length(link.to - link.from));
  return link;
}

// All bodies as the first frame has them.
PeerScene peer_scene(const Scenario& scenario) {
  PeerScene scene{scenario.world, {}, {}};
  for (const BodySpec& spec : scenario.bodies)
    scene.bodies.push_back(body_of(spec, scene.is_flat()));
  for (const LinkSpec& spec : scenario.links) scene.links.push_back(link_of(spec, scene.bodies));
  return scene;
}

// A script that only lets the bodies in and then watches them.
bool only_watches(const std::vector<Step>& steps) {
  bool runs = false;
  for (const Step& step : steps) {
    const Verb& verb = step.verb;
    if (std::holds_alternative<Insert>(verb) && runs) return false;
    if (std::holds_alternative<Remove>(verb) || std::holds_alternative<Move>(verb) ||
        std::holds_alternative<ApplyForce>(verb) || std::holds_alternative<ApplyImpulse>(verb) ||
        std::holds_alternative<Sleep>(verb) || std::holds_alternative<Emit>(verb) ||
        std::holds_alternative<Wake>(verb))
      return false;
    runs |= traits_of(verb).passes_time;
  }
  return true;
}

class PeerSolver : public Solver {
 public:
  explicit PeerSolver(Peer peer) : peer_(std::move(peer)) {}

  std::string name() const override { return peer_.name; }
  std::string version() const override { return peer_.version; }
  PeerSettings settings() const override { return peer_.settings; }

  std::optional<std::string> cannot(const Scenario& scenario) const override {
    const std::string_view name = peer_.name;
    if (auto reason = engine_cannot(name.substr(0, name.find(':')), scenario)) return reason;
    return peer_.cannot(peer_scene(scenario));
  }

  std::unique_ptr<Simulation> start(const Scenario& scenario, double h) const override {
    if (!(h > 0)) throw Refused("{}: a step of {}", name(), h);
    if (auto reason = cannot(scenario)) throw Refused("{}: {}", name(), *reason);
    return peer_.start(peer_scene(scenario), h);
  }

 private:
  Peer peer_;
};

constexpr PeerModule kModules[] = {
    {"Bullet", "lantern_peer_bullet.so", "libbullet-dev"},
    {"Box2D", "lantern_peer_box2d.so", "libbox2d-dev"},
    {"MuJoCo", "lantern_peer_mujoco.so", "libmujoco-dev"},
};

}  // namespace

// What no peer can do, whatever it is: bodies that are steered, levels, scripts that change the
// scene on its way; and what one of them cannot at all.
std::optional<std::string> engine_cannot(std::string_view engine, const Scenario& scenario) {
  if (scenario.level) return "it has a level";
  if (scenario.bodies.empty()) return "it has no bodies";
  for (const BodySpec& body : scenario.bodies) {
    if (body.brain != Brain::none) return "body '" + body.name + "' is steered";
    if (body.asleep) return "body '" + body.name + "' begins asleep";
  }
  if (!scenario.problem && !only_watches(scenario.steps))
    return "its script changes bodies on their way";
  if (engine == "Box2D" && scenario.world.dimension == 3) return "Box2D is flat";
  if (engine == "MuJoCo" && scenario.world.gravitation > 0)
    return "MuJoCo has no forces between two bodies but tendons";
  return std::nullopt;
}

std::optional<std::string> LanternSolver::cannot(const Scenario& scenario) const {
  if (method_.contacts && scenario.world.contacts == ContactMethod::none)
    return "its bodies do not collide";
  const auto is_joint = [](const LinkSpec& link) { return link.kind != LinkSpec::Kind::spring; };
  if (method_.contacts == ContactMethod::lecture && std::ranges::any_of(scenario.links, is_joint))
    return "the lecture has no joints";
  if (method_.integrator && integration(*method_.integrator).of_places) {
    if (scenario.world.contacts != ContactMethod::none) return "its bodies collide";
    for (const BodySpec& body : scenario.bodies)
      if (body.linear_drag > 0 || body.angular_drag > 0)
        return fmt::format("body '{}' has drag", body.name);
    if (std::ranges::any_of(scenario.links, is_joint)) return "it has joints";
    for (const LinkSpec& link : scenario.links)
      if (link.damping > 0) return "its springs are damped";
  }
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
  if (has_forces(scenario)) {
    std::vector<Method> methods;
    for (const std::string_view name : integrator_names()) {
      const Method method = *method_named(name);
      if (!LanternSolver(method).cannot(scenario)) methods.push_back(method);
    }
    return methods;
  }
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
  if (const auto reason = cannot(scenario)) throw Refused("{}: {}", name(), *reason);
  if (scenario.world.dimension == 3) return std::make_unique<PointSimulation<3>>(scenario, h);
  return std::make_unique<PointSimulation<2>>(scenario, h);
}

std::optional<Library> load_module(const PeerModule& module, std::vector<std::string>& missing) {
  const fs::path path = place_of(module);
  if (!path.empty()) return Library({path.c_str()});
  missing.push_back(fmt::format("{}: not built in; apt-get install {} and build Lantern again",
                                module.name, module.package));
  return std::nullopt;
}

std::vector<std::unique_ptr<Solver>> load_peers(
    std::vector<std::string>& missing, const std::function<bool(std::string_view)>& wanted) {
  std::vector<PeerModule> modules;
  for (const PeerModule& module : kModules)
    if (wanted(module.name)) modules.push_back(module);
  return mapped<std::unique_ptr<Solver>>(
      peers_of<Peer>(modules, "lantern_peers", missing),
      [](Peer& peer) { return std::make_unique<PeerSolver>(std::move(peer)); });
}

}  // namespace lantern::measure
