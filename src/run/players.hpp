// Which body of the world plays which body of the scenario, and the springs and joints between
// them.
#pragma once

#include <limits>

#include "language/scenario.hpp"
#include "physics/world.hpp"

namespace lantern::run {

// Pairs met on one frame; more are refused.
inline constexpr std::uint64_t kMostPairs = 2'000'000;

// What a scenario says of its structure, as the world is told it. Without one the world compares
// every body with every other.
template <int D>
BroadPhaseConfig<D> broad_phase_of(const StructureSpec& spec, const Box<D>& bounds);

// Bodies are named by their index in the scenario. Each call throws Refused as the world does.
template <int D>
class Players {
 public:
  // A world by the scenario's rules, empty as yet.
  explicit Players(const Scenario& scenario);

  const Scenario& scenario() const { return scenario_; }
  World<D>& world() { return world_; }
  const World<D>& world() const { return world_; }

  // As the scenario says, with the springs and joints whose other end is there already.
  void enter(std::size_t index);
  void leave(std::span<const std::size_t> indices);

  std::optional<BodyId> id_of(std::size_t index) const { return ids_[index]; }
  // Null when it is not in the world.
  const Body<D>* body(std::size_t index) const {
    return ids_[index] ? world_.find(*ids_[index]) : nullptr;
  }
  // Nothing for the anchor of a spring or joint: it is not pictured.
  const BodySpec* spec_of(BodyId id) const {
    return index_of_[id] == kAnchor ? nullptr : &scenario_.bodies[index_of_[id]];
  }

  // Its index in the scenario; nothing for an anchor.
  std::optional<std::size_t> index_of(BodyId id) const {
    return index_of_[id] == kAnchor ? std::nullopt : std::optional(index_of_[id]);
  }

  // f(spec, from, to, rest length) for each spring and joint that is there; its ends in the world.
  void for_each_link(auto&& f) const {
    for (std::size_t i = 0; i < links_.size(); ++i) {
      if (!links_[i].there) continue;
      const auto [from, to] = ends_of(scenario_.links[i]);
      f(scenario_.links[i], from, to, links_[i].rest_length);
    }
  }

 private:
  static constexpr std::size_t kAnchor = std::numeric_limits<std::size_t>::max();

  struct Link {
    bool there = false;
    double rest_length = 0;
  };

  void make_link(const LinkSpec& spec, Link& link);
  Vec<D> out_of_the_way() const;
  BodyId add_anchor(const Vec<D>& at);
  std::pair<Vec<D>, Vec<D>> ends_of(const LinkSpec& link) const;

  const Scenario& scenario_;
  World<D> world_;
  std::vector<std::optional<BodyId>> ids_;          // of the scenario's bodies
  std::vector<std::size_t> index_of_;               // of a body id, in the scenario; or kAnchor
  std::vector<Link> links_;                         // of the scenario's links
  std::vector<std::vector<std::size_t>> links_of_;  // of each body, ascending; empty without links
};

// An angle or spin of the scenario, about `axis` in a solid world.
template <int D>
Spin<D> spin_about(const Vec<3>& axis, double radians) {
  if constexpr (D == 2)
    return radians;
  else
    return axis * radians;
}

// Whoever looks on while a world moves, whichever its dimension.
class WorldWatch {
 public:
  virtual ~WorldWatch() = default;
  virtual void see_world(const Players<2>& players) = 0;
  virtual void see_world(const Players<3>& players) = 0;
};

}  // namespace lantern::run
