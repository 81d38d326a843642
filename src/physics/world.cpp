#include "physics/world.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "geometry/not_finite.hpp"
#include "physics/islands.hpp"
#include "physics/waking.hpp"

namespace lantern::physics {
namespace {

void require_count(int value, int most, const char* field) {
  if (value < 1 || value > most)
    throw Refused(fmt::format("world: {} is {}, must be 1 ... {}", field, value, most));
}

template <int D>
void check_config(const WorldConfig<D>& config) {
  require_finite<D>(config.gravity, "world", "gravity");
  if (!std::isfinite(config.gravitation) || config.gravitation < 0)
    throw Refused("world: gravitation is negative or not finite");
  require_count(config.sub_steps, 1000, "sub_steps");
  require_count(config.iterations, 100000, "iterations");
  if (!std::isfinite(config.wanted_error) || config.wanted_error < 0)
    throw Refused("world: wanted_error is negative or not finite");
  if (config.impact_budget < 0) throw Refused("world: impact_budget is negative");
  for (const double value : {config.sleep_after, config.sleep_speed, config.sleep_spin})
    if (!std::isfinite(value) || value < 0)
      throw Refused("world: sleep_after, sleep_speed or sleep_spin is negative or not finite");
}

// Of lists that belong together, all at the places for which `goes(place)`.
template <class F, class... Lists>
void erase_where(F&& goes, Lists&... lists) {
  std::size_t kept = 0, size = std::max({lists.size()...});
  for (std::size_t i = 0; i < size; ++i) {
    if (goes(i)) continue;
    if (kept != i) ((lists[kept] = std::move(lists[i])), ...);
    ++kept;
  }
  (lists.erase(lists.begin() + static_cast<std::ptrdiff_t>(kept), lists.end()), ...);
}

Spin<2> momentum_for(const Body<2>& body, double spin) {
  return body.inverse_inertia > 0 ? spin / body.inverse_inertia : 0;
}
Spin<3> momentum_for(const Body<3>& body, const Vec<3>& spin) {
  const Mat<3> r = matrix(body.orientation);
  Vec<3> l = spin * r;  // into the body's axes
  for (int i = 0; i < 3; ++i)
    l[i] = body.inverse_inertia[i] > 0 ? l[i] / body.inverse_inertia[i] : 0;
  return r * l;
}

}  // namespace

template <int D>
World<D>::World(const WorldConfig<D>& config) : config_(config) {
  check_config(config);
  forces_.gravity = config.gravity;
  forces_.gravitation = config.gravitation;
  if (config.contacts != ContactMethod::none) BroadPhase<D>{config.broad_phase};  // refuses
}

template <int D>
BodyId World<D>::add(Body<D> body, const Spin<D>& angular_velocity) {
  check_body(body);
  derive_mass(body);
  if (body.kind != BodyKind::dynamic_body) body.asleep = false;
  if (body.asleep) {
    body.velocity = Vec<D>(0.0);
    body.angular_momentum = Spin<D>(0.0);
  }
  if (angular_velocity != Spin<D>(0.0)) spin(body, angular_velocity);
  body.id = next_id_;
  ahead_.reset();
  may_rest_ |= body.asleep;
  bodies_.push_back(std::move(body));
  rested_.push_back(0);
  islands_.push_back(kNoIsland);
  return next_id_++;
}

// All of them in one pass through all else: one after another would cost the square of them.
template <int D>
void World<D>::remove(std::span<const BodyId> ids) {
  std::vector<BodyId> gone, disturbed;
  for (const BodyId id : ids)
    if (find(id) != nullptr) gone.push_back(id);
  if (gone.empty()) return;
  std::ranges::sort(gone);
  disturbed = gone;
  const auto is_gone = [&](BodyId id) { return std::ranges::binary_search(gone, id); };
  const auto goes = [&](const auto& tie) { return is_gone(tie.a) || is_gone(tie.b); };
  const auto disturb = [&](const auto& tie) {
    if (goes(tie)) disturbed.insert(disturbed.end(), {tie.a, tie.b});
  };
  for (const Spring<D>& spring : forces_.springs) disturb(spring);
  for (const auto& entry : joints_) disturb(entry.second);
  wake_from(disturbed);
  erase_where([&](std::size_t i) { return goes(forces_.springs[i]); }, spring_ids_,
              forces_.springs);
  erase_where([&](std::size_t i) { return goes(joints_[i].second); }, joint_memories_, joints_);
  std::erase_if(pushes_, [&](const TimedPush& push) { return is_gone(push.push.body); });
  list_pushes();
  forget_contacts_of(gone);
  erase_where([&](std::size_t i) { return is_gone(bodies_[i].id); }, rested_, islands_, bodies_);
  part_islands();
}

template <int D>
const Body<D>* World<D>::find(BodyId id) const {
  if (id < bodies_.size() && bodies_[id].id == id)
    return &bodies_[id];  // as long as none is removed
  const auto body = std::lower_bound(bodies_.begin(), bodies_.end(), id,
                                     [](const Body<D>& b, BodyId wanted) { return b.id < wanted; });
  return body != bodies_.end() && body->id == id ? &*body : nullptr;
}

template <int D>
std::size_t World<D>::index_of(BodyId id) const {
  const Body<D>* body = find(id);
  if (body == nullptr) throw Refused(fmt::format("there is no body {}", id));
  return static_cast<std::size_t>(body - bodies_.data());
}

template <int D>
void World<D>::place(BodyId id, const Vec<D>& position, const Vec<D>& velocity,
                     const std::optional<Rotation<D>>& orientation) {
  const std::size_t index = index_of(id);
  Body<D> moved = bodies_[index];
  moved.position = position;
  moved.velocity = velocity;
  if (orientation) moved.orientation = *orientation;
  check_body(moved);
  wake_from(id);
  forget_contacts_of(std::span(&id, 1));
  part_islands();
  moved.asleep = false;
  bodies_[index] = std::move(moved);
}

template <int D>
void World<D>::set_velocities(std::span<const std::pair<BodyId, Vec<D>>> velocities) {
  if (velocities.empty()) return;
  std::vector<BodyId> ids;
  for (const auto& [id, velocity] : velocities) {
    require_finite<D>(velocity, fmt::format("body '{}'", bodies_[index_of(id)].name), "velocity");
    ids.push_back(id);
  }
  wake_from(ids);
  for (const auto& [id, velocity] : velocities) bodies_[index_of(id)].velocity = velocity;
}

template <int D>
void World<D>::set_angular_velocity(BodyId id, const Spin<D>& spin) {
  Body<D>& body = bodies_[index_of(id)];
  Body<D> turning = body;
  World::spin(turning, spin);
  wake_from(id);
  body.angular_momentum = turning.angular_momentum;
  body.kinematic_spin = turning.kinematic_spin;
}

template <int D>
void World<D>::spin(Body<D>& body, const Spin<D>& angular_velocity) {
  if (body.kind == BodyKind::dynamic_body)
    body.angular_momentum = momentum_for(body, angular_velocity);
  else
    body.kinematic_spin = angular_velocity;
  // Spin of a body that cannot turn is lost above, so it is looked at by itself.
  require_finite(angular_velocity, fmt::format("body '{}'", body.name), "angular velocity");
  check_body(body);
}

template <int D>
void World<D>::apply_impulse(BodyId id, const Vec<D>& impulse, const Vec<D>& at) {
  Body<D>& body = bodies_[index_of(id)];
  const std::string who = fmt::format("body '{}'", body.name);
  require_finite<D>(impulse, who, "impulse");
  require_finite<D>(at, who, "point of the impulse");
  if (body.kind != BodyKind::dynamic_body) return;
  Body<D> struck = body;
  struck.velocity += impulse * body.inverse_mass;
  if (body.inverse_inertia != Spin<D>(0.0))
    struck.angular_momentum += cross(Vec<D>(at - body.position), impulse);
  check_body(struck);
  wake_from(id);
  body.velocity = struck.velocity;
  body.angular_momentum = struck.angular_momentum;
}

template <int D>
void World<D>::set_gravity(const Vec<D>& gravity) {
  require_finite<D>(gravity, "world", "gravity");
  std::vector<BodyId> all;
  for (const Body<D>& body : bodies_) all.push_back(body.id);
  wake_from(all);
  config_.gravity = forces_.gravity = gravity;
}

template <int D>
void World<D>::wake_from(std::span<const BodyId> ids) {
  ahead_.reset();
  if (!may_rest_) return;
  std::vector<std::uint32_t> places;
  for (const BodyId id : ids) places.push_back(static_cast<std::uint32_t>(index_of(id)));
  wake_together<D>(bodies_, rested_, std::move(places), links(), Disturbed::all);
}

// Of each island what still touches or is tied stays together.
template <int D>
void World<D>::part_islands() {
  DisjointSets sets(bodies_.size());
  for (const Pair& link : links()) {
    const std::size_t a = index_of(link.a), b = index_of(link.b);
    if (islands_[a] != kNoIsland && islands_[a] == islands_[b])
      sets.unite(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (islands_[i] != kNoIsland)
      islands_[i] = bodies_[sets.root(static_cast<std::uint32_t>(i))].id;
}

// Ids ascend.
template <int D>
void World<D>::forget_contacts_of(std::span<const BodyId> ids) {
  const auto is_of = [&](BodyId id) { return std::ranges::binary_search(ids, id); };
  std::erase_if(touching_,
                [&](const Touch& touch) { return is_of(touch.record.a) || is_of(touch.record.b); });
}

template <int D>
void World<D>::sleep(BodyId id) {
  Body<D>& body = bodies_[index_of(id)];
  if (body.kind != BodyKind::dynamic_body) return;
  ahead_.reset();
  may_rest_ = body.asleep = true;
  body.velocity = Vec<D>(0.0);
  body.angular_momentum = Spin<D>(0.0);
}

template <int D>
void World<D>::wake(std::span<const BodyId> ids) {
  for (const BodyId id : ids) index_of(id);
  wake_from(ids);
}

template <int D>
BroadPhase<D>& World<D>::structure() {
  if (!broad_phase_) broad_phase_.emplace(config_.broad_phase);
  return *broad_phase_;
}

template <int D>
void World<D>::switch_broad_phase(const BroadPhaseConfig<D>& config) {
  broad_phase_.emplace(config);
  config_.broad_phase = config;
}

template <int D>
void World<D>::switch_contacts(ContactMethod method, int sub_steps, int iterations,
                               double wanted_error) {
  if (config_.contacts == ContactMethod::none || method == ContactMethod::none)
    throw Refused("world: contacts cannot be switched on or off, only be solved another way");
  WorldConfig<D> config = config_;
  config.contacts = method;
  config.sub_steps = sub_steps;
  config.iterations = iterations;
  config.wanted_error = wanted_error;
  check_config(config);
  config_ = config;
}

template class World<2>;
template class World<3>;

}  // namespace lantern::physics
