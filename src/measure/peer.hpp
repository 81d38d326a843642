// What Lantern asks of another physics engine, and what it tells it. A peer is a module of its own
// (src/peers), loaded only when it is measured: it is built with nothing of Lantern but headers.
#pragma once

#include "measure/simulation.hpp"

namespace lantern::measure {

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
