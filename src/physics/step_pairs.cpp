// The first half of a step: what may touch, what wakes, what hangs together.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/memory.hpp"
#include "base/stop.hpp"
#include "physics/step.hpp"
#include "physics/waking.hpp"

namespace lantern::physics {
namespace {

template <int D>
double slack(const Body<D>& body) {
  const double t = thickness<D>(body.shape);
  return t < kEndless ? t * kStepSettings.slack : 0;
}

// How far a surface moves because its body turns.
template <int D>
double turning_way(const Body<D>& body, double h) {
  const double radius = turning_reach<D>(body.shape);
  if (radius == 0 || !body.moves() || body.asleep) return 0;
  const Spin<D> spin = angular_velocity(body);
  return radius * std::min(std::sqrt(dot(spin, spin)) * h, std::numbers::pi);
}

template <int D>
Vec<D> velocity_of(const Body<D>& body) {
  return body.moves() && !body.asleep ? body.velocity : Vec<D>(0.0);
}

// How far a surface may come if no force acts.
template <int D>
double coasting_reach(const Body<D>& body, double h) {
  return slack(body) + turning_way(body, h) + glm::length(velocity_of(body)) * h;
}

}  // namespace

template <int D>
void World<D>::Step::find_forces() {
  std::vector<std::uint32_t> released;
  for (const TimedPush& push : world.pushes_) {
    if (push.until && *push.until <= world.time_ + kStepSettings.rounding * h)
      released.push_back(place_of(push.push.body));
    else
      pushes.push_back(push);
  }
  forces.pushes.clear();
  for (const TimedPush& push : pushes) forces.pushes.push_back(push.push);
  wake(std::move(released));
  // Once a step, by looking ahead or in the first of several tries: they follow from the world as
  // it was before.
  if (!world.ahead_ || world.ahead_->h != h) {
    Ahead found{h, {}, 0};
    if (flies_anywhere())
      find_increments_if_any<D>(world.config_, moved, forces, h, found.increments, world.work_);
    else
      found.increments.resize(moved.size());
    world.ahead_ = std::move(found);
  }
  world.work_.force_evaluations += std::exchange(world.ahead_->force_evaluations, 0);
  find_reach();
}

// Whether anything flies, or may be met, where it would fly: not if joints hold all that moves.
template <int D>
bool World<D>::Step::flies_anywhere() const {
  if (collides()) return true;
  std::vector<std::uint8_t> held(moved.size());
  for (const auto& entry : world.joints_)
    for (const BodyId id : {entry.second.a, entry.second.b}) held[place_of(id)] = true;
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (moved[i].kind == BodyKind::dynamic_body && !held[i]) return true;
  return false;
}

template <int D>
void World<D>::Step::find_reach() {
  reach.resize(moved.size());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const Body<D>& body = moved[i];
    const Increment<D>& increment = increments()[i];
    const double way =
        coasting_reach(body, h) + glm::length(increment.kick) * h + glm::length(increment.drift);
    reach[i] = std::max(reach[i], way);
  }
}

template <int D>
Box<D> World<D>::Step::enlarged_box(std::size_t place) const {
  const Box<D> box = moved[place].box();
  return {box.lo - Vec<D>(reach[place]), box.hi + Vec<D>(reach[place])};
}

template <int D>
void World<D>::Step::require_boxes() const {
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (!is_valid(enlarged_box(i)))
      throw Refused(fmt::format("body '{}': position overflows in step {}", moved[i].name,
                                world.work_.steps + 1));
}

template <int D>
std::vector<Proxy<D>> World<D>::Step::enlarged_boxes() const {
  std::vector<Proxy<D>> proxies;
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (moved[i].collides)
      proxies.push_back({moved[i].id, enlarged_box(i), !moved[i].moves(), moved[i].stirs()});
  return proxies;
}

template <int D>
void World<D>::store(std::span<const BodyId> ids, double h,
                     const typename BroadPhase<D>::Watch& watch) {
  std::vector<Proxy<D>> proxies;
  for (const BodyId id : ids) {
    const Body<D>& body = bodies_[index_of(id)];
    const Vec<D> reach(config_.contacts == ContactMethod::none ? 0 : coasting_reach(body, h));
    const Box<D> box = body.box();
    proxies.push_back({id, {box.lo - reach, box.hi + reach}, !body.moves(), body.stirs()});
  }
  structure().insert(proxies, watch);
}

// How all would fly on, and the structure in which the next step looks for pairs. A step that would
// be refused is not foreseen: it will say so itself.
template <int D>
void World<D>::look_ahead(double h, const typename BroadPhase<D>::Watch& watch) {
  BroadPhase<D>& broad_phase = structure();
  Step step{*this, h, {}};
  step.reach.resize(bodies_.size());
  if (config_.contacts == ContactMethod::none)
    return broad_phase.build(step.enlarged_boxes(), watch);
  const WorldWork before = work_;
  try {
    step.find_forces();
    step.require_boxes();
    ahead_->force_evaluations = work_.force_evaluations - before.force_evaluations;
  } catch (const Refused&) {
    ahead_.reset();
    step.reach.assign(bodies_.size(), 0);
  }
  work_ = before;
  broad_phase.build(step.enlarged_boxes(), watch);
}

template <int D>
Body<D> World<D>::flown(BodyId id, double h) const {
  const std::size_t place = index_of(id);
  Body<D> body = bodies_[place];
  const bool known = ahead_ && ahead_->h == h && place < ahead_->increments.size();
  WorldWork nobody_counts;
  fly(body, known ? ahead_->increments[place] : Increment<D>(), h, config_.rotation, nobody_counts);
  return body;
}

template <int D>
bool World<D>::Step::looks_for_contacts() const {
  return collides() && std::ranges::any_of(moved, &Body<D>::stirs);
}

template <int D>
void World<D>::Step::refresh_boxes() {
  require_boxes();
  if (looks_for_contacts()) boxes = enlarged_boxes();
}

template <int D>
void World<D>::Step::broad_phase() {
  if (!looks_for_contacts()) return;
  BroadPhase<D>& structure = world.structure();
  structure.update(boxes);
  pairs = structure.pairs();
  ++world.work_.broad_phases;
  world.work_.pair_tests += structure.counters().pair_tests;
  world.work_.candidate_pairs += pairs.size();
}

template <int D>
void World<D>::Step::narrow_phase() {
  near.clear();
  narrow_pairs = 0;
  manifolds.clear();
  axes.clear();
  for (const Body<D>& body : moved) axes.push_back(axes_of(body));
  const std::vector<Pair> joined = joined_pairs();
  auto touch = world.touching_.begin();  // in order of ids, as the pairs are
  for (const Pair& pair : pairs) {
    stop_if_asked();
    if (std::ranges::binary_search(joined, pair)) continue;
    auto found = nearing(pair);
    if (!found) continue;
    while (touch != world.touching_.end() && touch->record.pair() < pair) ++touch;
    if (touch != world.touching_.end() && touch->record.pair() == pair) found->touch = &*touch;
    near.push_back(*found);
  }
  // They are made when their islands are moved, and remembered for the next step.
  constexpr std::uint64_t kEach =
      sizeof(NearPair) + sizeof(IslandPair<D>) + 2 * (sizeof(Touch) + sizeof(Contact<D>));
  require_memory(kEach * near.size(), fmt::format("{} pairs that may touch", near.size()),
                 "take fewer bodies that overlap");
}

// What a joint ties together without letting it touch; ascending.
template <int D>
std::vector<Pair> World<D>::Step::joined_pairs() const {
  std::vector<Pair> joined;
  for (const auto& [id, joint] : world.joints_)
    if (!joint.collide) joined.push_back({std::min(joint.a, joint.b), std::max(joint.a, joint.b)});
  std::ranges::sort(joined);
  return joined;
}

// The pair, if the two may come to touch in this step.
template <int D>
auto World<D>::Step::nearing(const Pair& pair) -> std::optional<NearPair> {
  NearPair found;
  found.a = place_of(pair.a);
  found.b = place_of(pair.b);
  const Body<D>& a = moved[found.a];
  const Body<D>& b = moved[found.b];
  if (a.kind != BodyKind::dynamic_body && b.kind != BodyKind::dynamic_body) return std::nullopt;
  const double way =
      glm::length(velocity_of(b) - velocity_of(a)) * h + turning_way(a, h) + turning_way(b, h);
  // An impact with a third body may turn either of them towards the other.
  found.reach = reach[found.a] + reach[found.b];
  ++narrow_pairs;
  ++world.work_.narrow_tests;
  const auto manifold =
      collide<D>({a.shape, a.position, a.orientation, axes[found.a]},
                 {b.shape, b.position, b.orientation, axes[found.b]}, found.reach);
  if (!manifold) return std::nullopt;
  found.restitution = std::max(a.material.restitution, b.material.restitution);
  found.friction = std::sqrt(a.material.friction * b.material.friction);
  const double thin = std::min(thickness<D>(a.shape), thickness<D>(b.shape));
  const double fast =
      world.config_.wanted_error > 0 ? kStepSettings.fast_quick : kStepSettings.fast;
  found.located = locates_impacts() && (found.restitution > 0 || way > fast * thin);
  if (manifolds.size() < kStepSettings.most_manifolds) {
    found.manifold = static_cast<std::uint32_t>(manifolds.size());
    manifolds.push_back(*manifold);
  }
  return found;
}

template <int D>
IslandPair<D> World<D>::Step::island_pair(const NearPair& from) const {
  IslandPair<D> pair;
  pair.rows.a = from.a;
  pair.rows.b = from.b;
  pair.rows.restitution = from.restitution;
  pair.rows.friction = from.friction;
  pair.reach = from.reach;
  pair.located = from.located;
  pair.pressed = !from.located;
  pair.record.a = pair.memory.a = moved[from.a].id;
  pair.record.b = pair.memory.b = moved[from.b].id;
  if (from.manifold != kNone) pair.seen = &manifolds[from.manifold];
  if (from.touch != nullptr) {
    pair.remembered = from.touch->seconds > 0;
    pair.memory = from.touch->memory;
    pair.seconds = from.touch->seconds;
  }
  return pair;
}

template <int D>
bool World<D>::Step::wake_what_is_touched() {
  if (!looks_for_contacts()) return false;
  std::vector<std::uint32_t> woken;
  for (const NearPair& pair : near) {
    if (moved[pair.a].asleep) woken.push_back(pair.a);
    if (moved[pair.b].asleep) woken.push_back(pair.b);
  }
  const auto tied = [&](BodyId first, BodyId second) {
    const std::uint32_t a = place_of(first), b = place_of(second);
    if (moved[a].asleep && moved[b].stirs()) woken.push_back(a);
    if (moved[b].asleep && moved[a].stirs()) woken.push_back(b);
  };
  for (const auto& entry : world.joints_) tied(entry.second.a, entry.second.b);
  for (const Spring<D>& spring : forces.springs) tied(spring.a, spring.b);
  if (woken.empty()) return false;
  wake(std::move(woken));
  find_increments_if_any<D>(world.config_, moved, forces, h, anew, world.work_);
  find_reach();
  return true;
}

template <int D>
void World<D>::Step::wake(std::vector<std::uint32_t> places) {
  wake_together<D>(moved, rested, std::move(places), world.links(), Disturbed::sleepers);
}

// Static and kinematic bodies do not join what touches them.
template <int D>
void World<D>::Step::make_islands() {
  DisjointSets sets(moved.size());
  const auto unite = [&](std::uint32_t a, std::uint32_t b) {
    if (moved[a].kind == BodyKind::dynamic_body && moved[b].kind == BodyKind::dynamic_body)
      sets.unite(a, b);
  };
  for (const NearPair& pair : near) unite(pair.a, pair.b);
  // What sleeps is not looked at: it hangs together as when it fell asleep.
  for (const Touch& touch : world.touching_) {
    const std::uint32_t a = place_of(touch.record.a), b = place_of(touch.record.b);
    if (moved[a].asleep && moved[b].asleep) unite(a, b);
  }
  for (const auto& entry : world.joints_) unite(place_of(entry.second.a), place_of(entry.second.b));
  for (const Spring<D>& spring : forces.springs) unite(place_of(spring.a), place_of(spring.b));
  // What attracts hangs together over any distance.
  std::optional<std::uint32_t> first;
  for (std::uint32_t i = 0; forces.gravitation > 0 && i < moved.size(); ++i) {
    if (moved[i].kind != BodyKind::dynamic_body) continue;
    if (!first) first = i;
    unite(*first, i);
  }
  root.clear();
  for (std::size_t i = 0; i < moved.size(); ++i)
    root.push_back(sets.root(static_cast<std::uint32_t>(i)));
  world.work_.islands = 0;
  for (std::size_t i = 0; i < moved.size(); ++i)
    world.work_.islands +=
        root[i] == i && moved[i].kind == BodyKind::dynamic_body && !moved[i].asleep;
}

#define LANTERN_INSTANTIATE(D)                                               \
  template void World<D>::Step::find_forces();                               \
  template void World<D>::Step::refresh_boxes();                             \
  template void World<D>::Step::broad_phase();                               \
  template void World<D>::Step::narrow_phase();                              \
  template bool World<D>::Step::wake_what_is_touched();                      \
  template void World<D>::Step::make_islands();                              \
  template IslandPair<D> World<D>::Step::island_pair(const NearPair&) const; \
  template void World<D>::look_ahead(double, const BroadPhase<D>::Watch&);   \
  template Body<D> World<D>::flown(BodyId, double) const;                    \
  template void World<D>::store(std::span<const BodyId>, double,             \
                                const typename BroadPhase<D>::Watch&);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern::physics
