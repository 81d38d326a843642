// One interface for whoever can move the bodies of a scenario: Lantern's engine by any of its
// methods, and the peers that it is measured beside. All are fed the same scenario and asked for
// the same states, so that one metric fits them all.
#pragma once

#include "frame/body_state.hpp"
#include "language/scenario.hpp"
#include "physics/world_config.hpp"

namespace lantern::measure {

// Work that is counted, not timed: the same on every machine. Zero for what a peer does not tell.
struct Counted {
  std::uint64_t steps = 0;
  std::uint64_t force_evaluations = 0;
  std::uint64_t constraint_rows = 0;
  std::uint64_t pair_tests = 0;
};

// A scenario on its way. Bodies are named by their index in the scenario.
class Simulation {
 public:
  virtual ~Simulation() = default;

  // `steps` steps. This is what is timed: nothing else happens in it. Throws Refused if it cannot
  // go on, naming the reason; it may then only be destroyed.
  virtual void advance(std::uint64_t steps) = 0;

  // The script's other verbs. Peers know none: their bodies are there from the start.
  virtual void act(const Verb&) {}
  // What Lantern's world has counted so far; null for a peer.
  virtual const WorldWork* world_work() const { return nullptr; }

  // One state a body of the scenario, in its order.
  virtual void observe(std::vector<BodyState>& states) const = 0;
  virtual std::uint64_t impacts() const { return 0; }  // so far; 0 if it does not tell
  // How far it keeps others off a body's surface, units: what rests on a body with such a skin
  // hovers, and that is no error of its contacts.
  virtual double skin(std::size_t) const { return 0; }
  virtual Counted counted() const { return {}; }    // so far
  virtual std::uint64_t hash() const { return 0; }  // of the state; 0 if it has none
};

// How an engine is run, for whoever reads its numbers.
struct PeerSettings {
  std::string precision;   // "single"
  std::string integrator;  // "semi-implicit Euler"
  std::string solver;      // of contacts and joints
  std::string iterations;  // "8 of velocities, 3 of positions"
  std::string joints;      // what pins and rods are made of
  std::string flags;       // what else differs from the engine's defaults, and what is left to them
  std::string source;      // who recommends it
  bool operator==(const PeerSettings&) const = default;
};

// Who makes simulations: a method of Lantern, or a peer.
class Solver {
 public:
  virtual ~Solver() = default;
  virtual std::string name() const = 0;               // "velocity_verlet", "Bullet"
  virtual std::string version() const { return {}; }  // of a peer; empty for Lantern itself
  bool is_peer() const { return !version().empty(); }
  virtual PeerSettings settings() const { return {}; }  // of a peer

  // Why it cannot do this scenario ("Box2D is flat"); nothing if it can.
  virtual std::optional<std::string> cannot(const Scenario& scenario) const = 0;

  // All bodies as the scenario's first frame has them, with steps of `h` > 0 seconds. The scenario
  // must outlive the simulation. Throws Refused for what it cannot do.
  virtual std::unique_ptr<Simulation> start(const Scenario& scenario, double h) const = 0;
};

// What Lantern asks of another physics engine, and what it tells it. A peer is a module of its own
// (src/peers), loaded only when it is measured: it is built with nothing of Lantern but headers.

// A body with everything derived that Lantern's engine would derive: its mass is 0 for what no
// force moves, its shape in a flat world without extent along z.
struct PeerBody : BodySpec {
  Rotation<3> orientation{};
  Vec<3> turning{0.0};         // radians a second, world's axes
  Vec<3> inertia{0.0};         // about its own axes; of a flat body thrice the one about z
  double attracting_mass = 0;  // by which it attracts others; of what stands still if it was given

  bool is_dynamic() const { return kind == BodyKind::dynamic_body; }
  double inverse_mass() const { return mass > 0 ? 1 / mass : 0; }
};

struct PeerLink : LinkSpec {
  Vec<3> from{0.0}, to{0.0};  // both ends in the world, at the start
  double length = 0;          // at rest
};

struct PeerScene : WorldSpec {
  std::vector<PeerBody> bodies;
  std::vector<PeerLink> links;

  bool is_flat() const { return dimension == 2; }
  bool collides() const { return contacts != ContactMethod::none; }  // else all pass through all
};

// One engine by one of its methods.
struct Peer {
  std::string name, version;  // "Bullet:50": an engine, and which of its methods and efforts
  PeerSettings settings;
  // Why it cannot do this scene; nothing if it can.
  std::function<std::optional<std::string>(const PeerScene& scene)> cannot;
  // Throws Refused for what `cannot` names, and for steps and speeds that it has no room for.
  std::function<std::unique_ptr<Simulation>(const PeerScene& scene, double h)> start;
};

// The one function of a module: adds its peers. By the name "lantern_peers", C linkage.
using PeersOfModule = void (*)(std::vector<Peer>&);

}  // namespace lantern::measure
