#include "measure/peers.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "measure/boxes/bench.hpp"
#include "measure/peer.hpp"
#include "physics/body.hpp"

namespace lantern::measure {
namespace {

namespace fs = std::filesystem;

// Where the module is; empty if it was not built. Beside the program, or above the tests' folder: a
// folder above a program may be that of another build.
fs::path place_of(const PeerModule& module) {
  std::error_code error;
  const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path home = here.filename() == "tests" ? here.parent_path() : here;
  const fs::path file = home / "peers" / module.file;
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

// What no peer can do, whatever it is: bodies that are steered, levels, scripts that change the
// scene on its way. Nothing if there is none of it.
std::optional<std::string> only_lantern_can(const Scenario& scenario) {
  if (scenario.level) return "it has a level";
  if (scenario.bodies.empty()) return "it has no bodies";
  for (const BodySpec& body : scenario.bodies) {
    if (body.brain != Brain::none) return "body '" + body.name + "' is steered";
    if (body.asleep) return "body '" + body.name + "' begins asleep";
  }
  if (!scenario.problem && !only_watches(scenario.steps))
    return "its script changes bodies on their way";
  return std::nullopt;
}

class PeerSolver : public Solver {
 public:
  explicit PeerSolver(Peer peer) : peer_(std::move(peer)) {}

  std::string name() const override { return peer_.name; }
  std::string version() const override { return peer_.version; }
  PeerSettings settings() const override { return peer_.settings; }

  std::optional<std::string> cannot(const Scenario& scenario) const override {
    if (auto reason = only_lantern_can(scenario)) return reason;
    return peer_.cannot(peer_scene(scenario));
  }

  std::unique_ptr<Simulation> start(const Scenario& scenario, double h) const override {
    if (!(h > 0)) throw Refused(fmt::format("{}: a step of {}", name(), h));
    if (auto reason = cannot(scenario)) throw Refused(fmt::format("{}: {}", name(), *reason));
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

std::optional<Library> load_module(const PeerModule& module, std::vector<std::string>& missing) {
  const fs::path path = place_of(module);
  if (!path.empty()) return Library({path.c_str()});
  missing.push_back(
      fmt::format("{}: not built in; apt-get install {} and build again: an installed Lantern has "
                  "no engines beside it",
                  module.name, module.package));
  return std::nullopt;
}

std::vector<std::unique_ptr<Solver>> load_peers(std::vector<std::string>& missing) {
  std::vector<std::unique_ptr<Solver>> solvers;
  for (Peer& peer : peers_of<Peer>(kModules, "lantern_peers", missing))
    solvers.push_back(std::make_unique<PeerSolver>(std::move(peer)));
  return solvers;
}

}  // namespace lantern::measure
