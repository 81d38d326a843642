// Which bodies hang on which, for engines that give a joint the coordinates it leaves free instead
// of equations that it must keep.
#pragma once

#include <optional>
#include <vector>

#include "measure/simulation.hpp"

namespace lantern::peers {

// A body and how it hangs. Without a link it is free or never moves.
struct Hanging {
  std::size_t body = 0;
  std::optional<std::size_t> link = {};    // by which it hangs
  std::optional<std::size_t> parent = {};  // on this body; nothing: on the world
  bool is_rod = false;                     // else a pin
  Vec<3> at{0.0};      // where the link holds it, from its centre, in its own axes
  Vec<3> end{0.0};     // the same in the world at the start
  Vec<3> anchor{0.0};  // the link's other end, there
};

class JointTree {
 public:
  explicit JointTree(const PeerScene& scene)
      : scene_(scene), is_placed_(scene.bodies.size()), is_used_(scene.links.size()) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      if (!scene.bodies[i].is_dynamic()) place({.body = i});
    for (std::size_t i = 0; i < scene.links.size(); ++i)
      if (!scene.links[i].b) hang_on(std::nullopt, i);
    grow(0);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      if (is_placed_[i]) continue;
      const std::size_t from = all_.size();
      place({.body = i});
      grow(from);
    }
  }

  const std::vector<Hanging>& all() const { return all_; }  // every body, parents first
  bool hangs_by(std::size_t link) const { return is_used_[link]; }

 private:
  void place(const Hanging& one) {
    is_placed_[one.body] = true;
    all_.push_back(one);
  }

  void grow(std::size_t from) {
    for (std::size_t i = from; i < all_.size(); ++i)
      for (std::size_t k = 0; k < scene_.links.size(); ++k) {
        const PeerLink& link = scene_.links[k];
        if (link.a == all_[i].body || link.b == all_[i].body) hang_on(all_[i].body, k);
      }
  }

  // The body at the link's other end, if it may hang: an engine's joints brake no single body, and
  // a rod in space would leave its own turning undetermined.
  void hang_on(std::optional<std::size_t> parent, std::size_t index) {
    const PeerLink& link = scene_.links[index];
    if (link.kind == LinkSpec::Kind::spring || is_used_[index]) return;
    const bool is_rod = link.kind == LinkSpec::Kind::distance;
    const double length = glm::length(link.to - link.from);
    constexpr double kClosed = 1e-9;
    if (is_rod
            ? !scene_.is_flat() || std::abs(length - link.length) > kClosed * length || length == 0
            : length > kClosed)
      return;
    const bool child_is_a = parent != link.a;
    if (!child_is_a && !link.b) return;
    const std::size_t child = child_is_a ? link.a : *link.b;
    const PeerBody& body = scene_.bodies[child];
    if (is_placed_[child] || !body.is_dynamic() || !body.may_turn || body.linear_drag > 0 ||
        body.angular_drag > 0)
      return;
    is_used_[index] = true;
    if (child_is_a)
      place({child, index, parent, is_rod, link.at_a, link.from, link.to});
    else
      place({child, index, parent, is_rod, link.at_b, link.to, link.from});
  }

  const PeerScene& scene_;
  std::vector<Hanging> all_;
  std::vector<bool> is_placed_, is_used_;
};

// Of the start: how fast what hangs turns about each of its links' ends, in the world's axes.
struct HangingSpin {
  Vec<3> of_rod{0.0};   // about the anchor, against the parent; of a pin not used
  Vec<3> of_body{0.0};  // about its own end, against the rod or the parent
};
inline HangingSpin spin_of(const PeerScene& scene, const Hanging& one) {
  const PeerBody& body = scene.bodies[one.body];
  Vec<3> parents(0.0), anchors(0.0);  // turning; velocity
  if (one.parent && scene.bodies[*one.parent].is_dynamic()) {
    const PeerBody& parent = scene.bodies[*one.parent];
    parents = parent.turning;
    anchors = parent.velocity + cross(parent.turning, one.anchor - parent.position);
  }
  if (!one.is_rod) return {Vec<3>(0.0), body.turning - parents};
  const Vec<3> rod = one.end - one.anchor;
  const Vec<3> ends = body.velocity + cross(body.turning, one.end - body.position);
  const Vec<3> turning = cross(rod, ends - anchors) / glm::dot(rod, rod);
  return {turning - parents, body.turning - turning};
}

}  // namespace lantern::peers
