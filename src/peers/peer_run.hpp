// What all peers' simulations share: springs and gravitation as forces, states as Lantern gives
// them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/error.hpp"
#include "measure/simulation.hpp"

namespace lantern::peers {

// How a body lies and moves in the peer's world.
struct PeerMotion {
  Vec<3> position{0.0};
  Vec<3> velocity{0.0};
  Rotation<3> orientation;
  Vec<3> spin{0.0};  // radians a second, world's axes
};

class PeerRun : public Simulation {
 public:
  PeerRun(PeerScene scene, double h) : scene_(std::move(scene)), h_(h) {
    for (const PeerBody& body : scene_.bodies) turns_.push_back({body.angle, body.turning.z, 0});
    find_attractions();
  }

  // Several of the engines stop the whole program, or never end, on a state that is not a number.
  void advance(std::uint64_t steps) override {
    for (std::uint64_t i = 0; i < steps; ++i) {
      for (const PeerLink& link : pulling_) pull(link);
      for (const Attraction& attraction : attractions_) pull(attraction);
      for (const ApplyForce& one : pushes_) push(one.body, one.force, one.at);
      step();
      ++steps_;
      if (!is_finite()) throw Refused("a position or velocity is no longer finite");
    }
  }

  // Of all verbs problems use two: to set a velocity anew, and to push from now on.
  void act(const Verb& verb) override {
    if (const auto* force = std::get_if<ApplyForce>(&verb)) {
      std::erase_if(pushes_, [&](const ApplyForce& one) { return one.body == force->body; });
      if (force->force != Vec<3>(0.0)) pushes_.push_back(*force);
      return;
    }
    if (std::holds_alternative<ApplyImpulse>(verb))
      throw Refused("other engines' bodies are not struck on their way");
    const auto* move = std::get_if<Move>(&verb);
    if (!move) return;
    if (move->to || move->turned || move->spin)
      throw Refused("other engines' bodies are not put elsewhere on their way");
    if (move->velocity) set_velocity(move->body, *move->velocity);
  }

  void observe(std::vector<BodyState>& states) const override {
    states.resize(scene_.bodies.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
      const PeerBody& body = scene_.bodies[i];
      const PeerMotion now = motion(i);
      BodyState& state = states[i];
      state = {true, now.position, now.velocity, now.orientation, 0, now.spin, Vec<3>(0.0)};
      const Mat<3> axes = matrix(now.orientation);
      if (body.is_dynamic() && body.may_turn)
        state.angular_momentum = axes * (body.inertia * (glm::transpose(axes) * now.spin));
      if (scene_.is_flat()) state.angle = angle_of(i, now);
    }
  }

  Counted counted() const override { return {steps_, 0, 0, 0}; }

 protected:
  // Pulls by a force from now on, in each step.
  void pull_by_force(const PeerLink& link) { pulling_.push_back(link); }

  // A force is the most exact spring as long as the step is short enough for it; a peer's own soft
  // joint is used beyond that. (A chain's inner bodies have two springs: hence 1/2 of the limit.)
  bool is_soft(const PeerLink& link) const {
    double inverse_mass = scene_.bodies[link.a].inverse_mass();
    if (link.b) inverse_mass += scene_.bodies[*link.b].inverse_mass();
    return link.stiffness * h_ * h_ * inverse_mass <= 1 && link.damping * h_ * inverse_mass <= 1;
  }

  virtual void step() = 0;
  virtual bool is_finite() const = 0;  // of all bodies
  virtual PeerMotion motion(std::size_t body) const = 0;
  virtual void push(std::size_t body, const Vec<3>& force, const Vec<3>& arm) = 0;
  virtual void set_velocity(std::size_t body, const Vec<3>& velocity) = 0;
  // Nothing if the peer keeps no whole turns itself.
  virtual std::optional<double> whole_angle(std::size_t) const { return std::nullopt; }

  const PeerScene scene_;
  const double h_;

 private:
  struct End {
    Vec<3> point, velocity, arm;
  };
  struct Turn {
    double angle, spin;
    std::uint64_t steps;
  };

  struct Attraction {
    std::size_t a, b;
    double strength;  // of the force at a distance of 1
  };

  void find_attractions() {
    if (!(scene_.gravitation > 0)) return;
    const std::vector<PeerBody>& all = scene_.bodies;
    for (std::size_t a = 0; a < all.size(); ++a)
      for (std::size_t b = a + 1; b < all.size(); ++b) {
        const double masses = all[a].attracting_mass * all[b].attracting_mass;
        if (masses > 0 && (all[a].is_dynamic() || all[b].is_dynamic()))
          attractions_.push_back({a, b, scene_.gravitation * masses});
      }
  }

  void pull(const Attraction& attraction) {
    const Vec<3> line = motion(attraction.b).position - motion(attraction.a).position;
    const double square = glm::dot(line, line);
    if (!(square > 0)) return;
    const Vec<3> force = line * (attraction.strength / (square * std::sqrt(square)));
    push(attraction.a, force, Vec<3>(0.0));
    push(attraction.b, -force, Vec<3>(0.0));
  }

  End end(std::size_t body, const Vec<3>& at) const {
    const PeerMotion m = motion(body);
    if (at == Vec<3>(0.0)) return {m.position, m.velocity, Vec<3>(0.0)};
    const Vec<3> arm = matrix(m.orientation) * at;
    return {m.position + arm, m.velocity + cross(m.spin, arm), arm};
  }

  void pull(const PeerLink& link) {
    const End a = end(link.a, link.at_a);
    const End b = link.b ? end(*link.b, link.at_b) : End{link.at_b, Vec<3>(0.0), Vec<3>(0.0)};
    const Vec<3> line = b.point - a.point;
    const double length = glm::length(line);
    if (!(length > 0)) return;
    const Vec<3> direction = line / length;
    const double rate = glm::dot(b.velocity - a.velocity, direction);
    const Vec<3> force =
        direction * (link.stiffness * (length - link.length) + link.damping * rate);
    push(link.a, force, a.arm);
    if (link.b) push(*link.b, -force, b.arm);
  }

  // With whole turns: of the angles that look alike the one nearest to where the mean spin since
  // the last look leads.
  double angle_of(std::size_t i, const PeerMotion& now) const {
    if (const auto angle = whole_angle(i)) return *angle;
    Turn& last = turns_[i];
    const double seconds = h_ * static_cast<double>(steps_ - last.steps);
    const double guess = last.angle + seconds * (last.spin + now.spin.z) / 2;
    const double seen = 2 * std::atan2(now.orientation.q.z, now.orientation.q.w);
    last = {guess + std::remainder(seen - guess, 2 * std::numbers::pi), now.spin.z, steps_};
    return last.angle;
  }

  std::vector<PeerLink> pulling_;
  std::vector<Attraction> attractions_;
  std::vector<ApplyForce> pushes_;
  std::uint64_t steps_ = 0;
  mutable std::vector<Turn> turns_;  // when last looked at
};

// What an engine makes of a shape: of a sphere, of either kind of box by its half sizes, of a
// capsule, of a half-space.
template <class OfSphere, class OfBox, class OfCapsule, class OfHalfSpace>
auto visit_peer_shape(const Shape<3>& shape, OfSphere&& of_sphere, OfBox&& of_box,
                      OfCapsule&& of_capsule, OfHalfSpace&& of_half_space) {
  return std::visit(EachShape{[&](const Sphere& s) { return of_sphere(s); },
                              [&](const AxisBox<3>& s) { return of_box(s.half_size); },
                              [&](const OrientedBox<3>& s) { return of_box(s.half_size); },
                              [&](const Capsule& s) { return of_capsule(s); },
                              [&](const HalfSpace<3>& s) { return of_half_space(s); }},
                    shape);
}

// The smallest extent from the centre; endless for a half-space, 0 for a point.
inline double least_extent(const Shape<3>& shape, bool is_flat) {
  return visit_peer_shape(
      shape, [](const Sphere& s) { return s.radius; },
      [&](const Vec<3>& half) {
        return is_flat ? std::min(half.x, half.y) : std::min({half.x, half.y, half.z});
      },
      [](const Capsule& c) { return c.radius; },
      [](const HalfSpace<3>&) { return std::numeric_limits<double>::infinity(); });
}

// Whether it starts so fast that it could pass through another in a step: what engines have
// continuous collision detection for, and advise against for all others.
inline bool needs_continuous(const PeerScene& scene, const PeerBody& body, double h) {
  return scene.collides() && body.is_dynamic() &&
         glm::length(body.velocity) * h > least_extent(body.shape, scene.is_flat());
}

// Whether there is nothing to solve, so that solvers and their efforts make no difference.
inline constexpr const char* kNothingToSolve =
    "nothing touches or is jointed: it is as at the default effort";

// A flat box is as deep as it is wide in an engine that knows no flat bodies.
inline Vec<3> with_depth(Vec<3> half, bool is_flat) {
  if (is_flat) half.z = std::max(half.x, half.y);
  return half;
}

// What no engine of solid bodies does as Lantern does. Drag turns a body alike about all axes only
// if its inertia is the same about all.
inline std::optional<std::string> solid_engine_cannot(const PeerScene& scene) {
  for (const PeerBody& body : scene.bodies) {
    const Vec<3>& i = body.inertia;
    if (body.angular_drag > 0 && (i.x != i.y || i.y != i.z))
      return "body '" + body.name + "': its drag depends on the axis";
    if (std::holds_alternative<HalfSpace<3>>(body.shape) && body.kind != BodyKind::static_body)
      return "body '" + body.name + "': a half-space must be static";
    const bool is_nothing = visit_peer_shape(
        body.shape, [](const Sphere& ball) { return ball.radius == 0; },
        [](const Vec<3>& half) { return std::min(half.x, half.y) == 0; },
        [](const Capsule& capsule) { return capsule.radius == 0; },
        [](const HalfSpace<3>&) { return false; });
    if (scene.collides() && is_nothing) return "body '" + body.name + "' has no size";
  }
  return std::nullopt;
}

}  // namespace lantern::peers
