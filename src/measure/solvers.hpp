// Lantern's own engine, the one that makes the frames, by one of its methods.
#pragma once

#include "base/child.hpp"
#include "language/method.hpp"
#include "measure/row.hpp"

namespace lantern::measure {

class LanternSolver : public Solver {
 public:
  explicit LanternSolver(Method method) : method_(std::move(method)) {}
  std::string name() const override { return method_.name; }
  // What the method would not change it leaves to others: no contacts, no method of contacts.
  std::optional<std::string> cannot(const Scenario& scenario) const override;
  // A scenario without a [problem] starts empty: its script inserts the bodies.
  std::unique_ptr<Simulation> start(const Scenario& scenario, double h) const override;

 private:
  Method method_;
};

// The methods that the problem asks for; without a wish, all that make a difference to the scene:
// contact methods where bodies collide, integrators where forces act, rotations where a body of a
// solid world turns, else the file's own method under the name "as written".
std::vector<Method> methods_for(const Scenario& scenario);

// Dormand and Prince's pair as a solver: the reference for smooth problems, at its price.
// For scenes of points: bodies that neither collide nor are turned, without rods. It chooses its
// steps itself; what it is given as a step says how exact it is to be: 1e-3 of the scene's size and
// speed at the problem's largest step, and 32 times better for each halving, down to 1e-14.
class DormandPrinceSolver : public Solver {
 public:
  std::string name() const override { return std::string(kAdaptive); }
  std::optional<std::string> cannot(const Scenario& scenario) const override;
  std::unique_ptr<Simulation> start(const Scenario& scenario, double h) const override;
};

// A module of another library that Lantern is measured beside (src/peers), loaded when asked for.
// They are optional: what was not installed when Lantern was built is missing.

struct PeerModule {
  const char* name;     // of the library
  const char* file;     // of the module
  const char* package;  // that it is built from
};

// From the folder "peers" beside the lab. Nothing, and a line in `missing`, if it is not there:
// "Box2D: not built in; apt-get install libbox2d-dev and build Lantern again".
std::optional<Library> load_module(const PeerModule& module, std::vector<std::string>& missing);

// What the function `entry` of each module adds. A module once loaded stays.
template <class Peer>
std::vector<Peer> peers_of(std::span<const PeerModule> modules, const char* entry,
                           std::vector<std::string>& missing) {
  std::vector<Peer> peers;
  for (const PeerModule& module : modules) {
    const auto library = load_module(module, missing);
    if (!library) continue;
    void (*add)(std::vector<Peer>&) = nullptr;
    if (library->find(add, entry))
      add(peers);
    else
      missing.push_back(std::string(module.name) + ": cannot be loaded: " + library->problem());
  }
  return peers;
}

// Why the engine, "MuJoCo", does not run the scenario in any of its ways, as far as it is known
// without its module. Nothing if the module must be asked.
std::optional<std::string> engine_cannot(std::string_view engine, const Scenario& scenario);

// The engines that are wanted and whose modules are there; lines are added to `missing` as above.
std::vector<std::unique_ptr<Solver>> load_peers(
    std::vector<std::string>& missing,
    const std::function<bool(std::string_view)>& wanted = [](auto) { return true; });

// The libraries of boxes that `bench pairs` measures beside: "CGAL 5.5.1 (double)". Lines are added
// to `missing` as above.
std::vector<std::string> box_peer_names(std::vector<std::string>& missing);

}  // namespace lantern::measure
