// What Lantern asks of another physics engine, and what it tells it. A peer is a module of its own
// (src/peers), loaded only when it is measured: it is built with nothing of Lantern but headers.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "measure/simulation.hpp"

namespace lantern {

// A body with everything derived that Lantern's engine would derive.
struct PeerBody {
  std::string name;
  BodyKind kind = BodyKind::dynamic_body;
  Shape<3> shape;  // of a flat world without extent along z
  Vec<3> position{0.0};
  Vec<3> velocity{0.0};
  Rotation<3> orientation;
  double angle = 0;            // of a flat world, radians
  Vec<3> spin{0.0};            // radians a second, world's axes
  double mass = 0;             // 0 for what no force moves
  Vec<3> inertia{0.0};         // about its own axes; of a flat body thrice the one about z
  double attracting_mass = 0;  // by which it attracts others; of what stands still if it was given
  bool may_turn = true;
  Material material;
  double linear_drag = 0;
  double angular_drag = 0;

  bool is_dynamic() const { return kind == BodyKind::dynamic_body; }
  double inverse_mass() const { return mass > 0 ? 1 / mass : 0; }
};

struct PeerLink {
  LinkSpec::Kind kind = LinkSpec::Kind::spring;
  std::size_t a = 0;
  std::optional<std::size_t> b;  // none: tied to the world
  Vec<3> at_a{0.0};              // from the centre, in the body's own axes
  Vec<3> at_b{0.0};              // the same, or a point of the world
  Vec<3> from{0.0};              // both ends in the world, at the start
  Vec<3> to{0.0};
  double rest_length = 0;
  double stiffness = 0;
  double damping = 0;
};

struct PeerScene {
  int dimension = 2;
  Box<3> bounds;
  Vec<3> gravity{0.0};
  double gravitation = 0;  // Newton's constant between the bodies
  bool contacts = false;   // else bodies pass through each other
  std::vector<PeerBody> bodies;
  std::vector<PeerLink> links;

  bool is_flat() const { return dimension == 2; }
};

// One engine by one of its methods.
class Peer {
 public:
  virtual ~Peer() = default;
  virtual std::string name() const = 0;
  virtual std::string version() const = 0;
  // Why it cannot do this scene; nothing if it can.
  virtual std::optional<std::string> cannot(const PeerScene& scene) const = 0;
  // Throws Refused for what `cannot` names, and for steps and speeds that it has no room for.
  virtual std::unique_ptr<Simulation> start(const PeerScene& scene, double h) const = 0;
};

// The one function of a module: adds its peers. By the name "lantern_peers", C linkage.
using PeersOfModule = void (*)(std::vector<std::unique_ptr<Peer>>&);

}  // namespace lantern
