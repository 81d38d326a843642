// Who steers bodies that are not left to physics alone: a bat that follows the ball, a ghost that
// wanders.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/hash.hpp"
#include "geometry/random_vec.hpp"
#include "language/scenario.hpp"
#include "physics/world.hpp"

namespace lantern::run {

template <int D>
class Brains {
 public:
  explicit Brains(const Scenario& scenario)
      : scenario_(scenario),
        some_wander_(std::ranges::count(scenario.bodies, Brain::wander, &BodySpec::brain) > 0) {}

  // Sets the velocities with which the next world step begins. `id_of(index)` finds bodies.
  template <class IdOf>
  void steer(World<D>& world, double h, IdOf&& id_of) {
    velocities_.clear();
    away_.clear();
    if (some_wander_) find_ways_out(world);
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i) {
      const BodySpec& spec = scenario_.bodies[i];
      const std::optional<BodyId> id = spec.brain == Brain::none ? std::nullopt : id_of(i);
      if (!id) continue;
      if (spec.brain == Brain::wander)
        wander(world, *id, spec);
      else if (const std::optional<BodyId> target = id_of(spec.follows))
        follow(world, *id, *target, spec, h);
    }
    world.set_velocities(velocities_);
  }

 private:
  // For each that touches something, away from all of it.
  void find_ways_out(const World<D>& world) {
    for (const auto& contact : world.contacts()) {
      away_.try_emplace(contact.a, 0.0).first->second -= contact.manifold.normal;
      away_.try_emplace(contact.b, 0.0).first->second += contact.manifold.normal;
    }
  }

  // As fast as it may, but not beyond the place of the other.
  void follow(const World<D>& world, BodyId id, BodyId target, const BodySpec& spec, double h) {
    const Body<D>& body = *world.find(id);
    const Vec<D> way = world.find(target)->position - body.position;
    Vec<D> velocity{0.0};
    for (int i = 0; i < D; ++i)
      if (spec.brain_axes[i] != 0)
        velocity[i] = std::clamp(way[i] / h, -spec.brain_speed, spec.brain_speed);
    if (velocity != body.velocity) velocities_.emplace_back(id, velocity);
  }

  // After a touch it goes another way, at random, but away from what it touched.
  void wander(const World<D>& world, BodyId id, const BodySpec& spec) {
    const auto out = away_.find(id);
    const Vec<D> away = out == away_.end() ? Vec<D>(0.0) : out->second;
    const Body<D>& body = *world.find(id);
    const bool touches = away != Vec<D>(0.0);
    const double speed = std::sqrt(glm::dot(body.velocity, body.velocity));
    if (!touches && speed > 0) {
      if (std::abs(speed - spec.brain_speed) > 1e-9 * spec.brain_speed)
        velocities_.emplace_back(id, body.velocity * (spec.brain_speed / speed));
      return;
    }
    // Clearly away, or it would touch again at once.
    constexpr double kClearly = 0.3;
    Random& random = random_of(id, spec);
    const double length = std::sqrt(glm::dot(away, away));
    Vec<D> way = direction(random);
    for (int attempt = 0; touches && attempt < 64; ++attempt) {
      if (glm::dot(way, away) > kClearly * length) break;
      way = direction(random);
    }
    velocities_.emplace_back(id, way * spec.brain_speed);
  }

  // On the floor of a solid world.
  static Vec<D> direction(Random& random) {
    const Vec<2> on_floor = random_direction<2>(random);
    Vec<D> way{0.0};
    way[0] = on_floor.x;
    way[D - 1] = on_floor.y;
    return way;
  }

  Random& random_of(BodyId id, const BodySpec& spec) {
    const auto found = random_.find(id);
    if (found != random_.end()) return found->second;
    const std::uint64_t seed = Hash().add(scenario_.seed).add(std::string_view(spec.name)).value();
    return random_.emplace(id, Random(seed)).first->second;
  }

  const Scenario& scenario_;
  bool some_wander_;
  std::map<BodyId, Random> random_;
  std::vector<std::pair<BodyId, Vec<D>>> velocities_;  // that bodies are given
  std::map<BodyId, Vec<D>> away_;
};

}  // namespace lantern::run
