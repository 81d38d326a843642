// What an engine does and keeps step by step beside its world: who steers bodies that are not left
// to physics alone, the ways that they went, which pairs touched.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>

#include "base/hash.hpp"
#include "frame/frame.hpp"
#include "geometry/flat.hpp"
#include "geometry/random_vec.hpp"
#include "language/scenario.hpp"
#include "physics/contact/contact_solver.hpp"
#include "physics/world.hpp"

namespace lantern::run {

template <int D>
class Brains {
 public:
  explicit Brains(const Scenario& scenario)
      : scenario_(scenario),
        some_wander_(std::ranges::count(scenario.bodies, Brain::wander, &BodySpec::brain) > 0) {}

  // Sets the velocities with which the next world step begins. `id_of(index)` finds bodies.
  void steer(World<D>& world, double h, auto&& id_of) {
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

inline double angle_of(const Rotation<2>& rotation) { return rotation.angle; }
inline double angle_of(const Rotation<3>&) { return 0; }

template <int D>
FramePlace place_of(const Vec<D>& position, const Rotation<D>& orientation) {
  return {solid(position), angle_of(orientation)};
}
template <int D>
FramePlace place_of(const Pose<D>& pose) {
  return place_of<D>(pose.position, pose.orientation);
}

// The last `steps` ends of steps, and what lies between them.
inline void keep_last(std::vector<FrameStop>& way, int steps) {
  int ends = 0;
  for (std::size_t i = way.size(); i-- > 0;) {
    ends += !way[i].impact;
    if (ends < steps) continue;
    way.erase(way.begin(), way.begin() + static_cast<std::ptrdiff_t>(i));
    return;
  }
}

// Where moving bodies were at the ends of the last kMostTrail world steps, and at the impacts
// between.
template <int D>
class Trails {
 public:
  // Before a step and after it.
  void begin(const World<D>& world) {
    for (const Body<D>& body : world.bodies()) {
      if (!body.moves() || body.asleep) continue;
      std::vector<FrameStop>& way = ways_[body.id];
      way.push_back({place_of<D>(body.position, body.orientation), false});
      keep_last(way, kMostTrail);
    }
  }
  void end(const World<D>& world) {
    std::vector<const ImpactMoment<D>*> moments;
    for (const ImpactMoment<D>& moment : world.impacts().moments) moments.push_back(&moment);
    std::ranges::stable_sort(moments, {}, &ImpactMoment<D>::time);
    for (const ImpactMoment<D>* moment : moments)
      for (const Pose<D>& pose : {moment->a, moment->b})
        if (const auto way = ways_.find(pose.body); way != ways_.end() && world.find(pose.body))
          way->second.push_back({place_of<D>(pose), true});
  }
  // The body was put somewhere else.
  void forget(BodyId id) { ways_.erase(id); }
  // Of as many steps as the frame shows; and where bodies fly in the next one, of `h` seconds.
  void picture(const World<D>& world, double h, Frame& frame) const {
    for (FrameBody& body : frame.bodies) {
      const Body<D>* now = world.find(body.id);
      if (!now || !now->moves() || now->asleep) continue;
      if (const auto way = ways_.find(body.id); way != ways_.end()) {
        body.trail = way->second;
        keep_last(body.trail, frame.display.trail);
      }
      const Body<D> flown = world.flown(body.id, h);
      if (flown.position != now->position)
        body.ahead = place_of<D>(flown.position, flown.orientation);
    }
  }

 private:
  std::map<BodyId, std::vector<FrameStop>> ways_;  // the oldest first
};

// The looks by which the step, of `h` seconds, found its first impact, in order; none if there was
// none. Of many that lie as good as at the moment itself only the one that found it.
template <int D>
std::vector<FrameLook> looks_of(const ImpactLog<D>& log, double h) {
  constexpr double kSameMoment = 0.004;  // of the step
  std::vector<FrameLook> looks;
  if (log.moments.empty()) return looks;
  const ImpactMoment<D>* first = &log.moments.front();
  for (const ImpactMoment<D>& moment : log.moments)
    if (moment.time < first->time) first = &moment;
  const ImpactLook<D>* last = nullptr;
  for (const ImpactLook<D>& look : log.looks) {
    if (look.a.body != first->a.body || look.b.body != first->b.body) continue;
    if (look.meets && std::abs(look.time - first->time) <= kSameMoment * h) {
      last = &look;
      break;
    }
  }
  if (last == nullptr) return looks;
  const auto add = [&](const ImpactLook<D>& look, int number) {
    looks.push_back({{look.a.body, look.b.body},
                     place_of<D>(look.a),
                     place_of<D>(look.b),
                     solid(look.on_a),
                     solid(look.on_b),
                     look.time / h,
                     look.gap,
                     look.free_until / h,
                     look.meets,
                     number});
  };
  int number = 0;
  for (const ImpactLook<D>& look : log.looks) {
    if (look.a.body != last->a.body || look.b.body != last->b.body) continue;
    if (look.time > last->time && look.gap >= 0) break;  // for what comes after the impact
    ++number;
    if (std::abs(look.time - last->time) > kSameMoment * h && looks.size() + 1 < kMostLooks)
      add(look, number);
  }
  add(*last, number);
  return looks;
}

class CollisionLog {
 public:
  // The world has just made a step. Pairs come in the order in which they first touched.
  template <int D>
  void see(const World<D>& world) {
    remembered_ = contact_solver(world.config().contacts).frames_remembered;
    const std::uint64_t step = world.work().steps;
    for (const auto& told : world.told()) row_of(told.pair).push_back({step, told.frames_left});
    for (const ContactEvent& event : world.events()) {
      std::vector<FrameCollision::Moment>& row = row_of({event.a, event.b});
      if (event.kind == ContactEvent::Kind::end) {
        row.push_back({step, -1});
      } else {
        row.back().touches = true;
        row.back().begins = event.kind == ContactEvent::Kind::begin;
      }
    }
  }

  void list(FrameCollisions& collisions) const {
    collisions.rows = rows_;
    collisions.remembered = remembered_;
  }

 private:
  std::vector<FrameCollision::Moment>& row_of(const Pair& pair) {
    const auto [place, is_new] = places_.emplace(pair, rows_.size());
    if (is_new) rows_.push_back({pair, {}});
    return rows_[place->second].moments;
  }

  std::vector<FrameCollision> rows_;
  std::map<Pair, std::size_t> places_;  // in rows_
  int remembered_ = 0;
};

}  // namespace lantern::run
