#include "measure/peers.hpp"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "base/library.hpp"
#include "measure/peer_scene.hpp"

namespace lantern {
namespace {

namespace fs = std::filesystem;

class PeerSolver : public Solver {
 public:
  explicit PeerSolver(std::unique_ptr<Peer> peer) : peer_(std::move(peer)) {}

  std::string name() const override { return peer_->name(); }
  std::string version() const override { return peer_->version(); }

  std::optional<std::string> cannot(const Scenario& scenario) const override {
    if (auto reason = only_lantern_can(scenario)) return reason;
    return peer_->cannot(peer_scene(scenario));
  }

  std::unique_ptr<Simulation> start(const Scenario& scenario, double h) const override {
    if (!(h > 0)) throw Refused(fmt::format("{}: a step of {}", name(), h));
    if (auto reason = cannot(scenario)) throw Refused(fmt::format("{}: {}", name(), *reason));
    return peer_->start(peer_scene(scenario), h);
  }

 private:
  std::unique_ptr<Peer> peer_;
};

struct Module {
  const char* name;     // of the engine
  const char* file;     // of the module
  const char* package;  // that it is built from
};
constexpr Module kModules[] = {
    {"Bullet", "lantern_peer_bullet.so", "libbullet-dev"},
    {"Box2D", "lantern_peer_box2d.so", "libbox2d-dev"},
    {"ODE", "lantern_peer_ode.so", "libode-dev"},
    {"MuJoCo", "lantern_peer_mujoco.so", "libmujoco-dev"},
};

// Where the module is; empty if it was not built.
fs::path place_of(const Module& module) {
  std::error_code error;
  const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& folder : {here / "peers", here.parent_path() / "peers"})
    if (fs::is_regular_file(folder / module.file, error)) return folder / module.file;
  return {};
}

}  // namespace

std::vector<std::unique_ptr<Solver>> peers(std::vector<std::string>& missing) {
  std::vector<std::unique_ptr<Solver>> solvers;
  for (const Module& module : kModules) {
    const fs::path path = place_of(module);
    if (path.empty()) {
      missing.push_back(fmt::format("{}: not built in; apt-get install {} and build again",
                                    module.name, module.package));
      continue;
    }
    const Library library({path.c_str()});
    PeersOfModule add = nullptr;
    if (!library.find(add, "lantern_peers")) {
      missing.push_back(fmt::format("{}: cannot be loaded: {}", module.name, library.problem()));
      continue;
    }
    std::vector<std::unique_ptr<Peer>> found;
    add(found);
    for (auto& peer : found) solvers.push_back(std::make_unique<PeerSolver>(std::move(peer)));
  }
  return solvers;
}

}  // namespace lantern
