// What is done to a world between its steps: to its bodies, to what ties and pushes them.
#include "physics/world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <tuple>

#include <fmt/format.h>

#include "base/hash.hpp"
#include "geometry/not_finite.hpp"
#include "physics/contact/contact_solver.hpp"
#include "physics/islands.hpp"
#include "physics/step_islands.hpp"

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
  if (const auto& e = config.wanted_error; e && (!std::isfinite(*e) || *e < 0))
    throw Refused("world: wanted_error is negative or not finite");
  if (config.impact_budget < 0) throw Refused("world: impact_budget is negative");
  for (const double value : {config.sleep_after, config.sleep_speed, config.sleep_spin})
    if (!std::isfinite(value) || value < 0)
      throw Refused("world: sleep_after, sleep_speed or sleep_spin is negative or not finite");
}

// Some methods know only forces that follow from where bodies are.
template <int D>
void require_known(const WorldConfig<D>& config, const Body<D>& body, bool acts,
                   const char* forces) {
  const Integrator by = body.integrator.value_or(config.integrator);
  if (acts && body.is_dynamic() && integration(by).of_places)
    throw Refused(fmt::format("body '{}': {} knows forces of places alone, no {}", body.name,
                              to_string(by), forces));
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

void add_to(Hash& hash, double value) { hash.add(value); }
template <int D>
void add_to(Hash& hash, const glm::vec<D, double>& value) {
  for (int i = 0; i < D; ++i) hash.add(value[i]);
}
void add_to(Hash& hash, const Rotation<2>& r) { hash.add(r.angle); }
void add_to(Hash& hash, const Rotation<3>& r) { hash.add(r.q.w).add(r.q.x).add(r.q.y).add(r.q.z); }

template <int D>
void add_to(Hash& hash, const Contact<D>& contact) {
  add_to(hash, contact.manifold.normal);
  for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
    hash.add(std::uint64_t{contact.manifold.room[i].feature}).add(contact.normal_impulses[i]);
    add_to(hash, contact.friction_impulses[i]);
  }
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
World<D>::World(const World& as, const WorldConfig<D>& config) : World(config) {
  const auto state_of = [](auto& w) {
    return std::tie(w.bodies_, w.rested_, w.may_rest_, w.islands_, w.roots_, w.knows_islands_,
                    w.forces_.springs, w.forces_.pushes, w.joints_, w.joint_memories_, w.next_id_,
                    w.next_spring_, w.next_joint_, w.time_, w.touching_, w.slept_, w.outcome_);
  };
  state_of(*this) = state_of(as);
  if (config.integrator != as.config_.integrator && integration(config.integrator).of_places)
    throw Refused(fmt::format("world: {} takes over no world that another integrator has moved",
                              to_string(config.integrator)));
  for (const Body<D>& body : bodies_)
    require_known(config, body, config.contacts != ContactMethod::none, "contacts");
}

template <int D>
BodyId World<D>::add(Body<D> body, const Spin<D>& angular_velocity) {
  check_body(body);
  require_known(config_, body, config_.contacts != ContactMethod::none, "contacts");
  require_known(config_, body, body.linear_drag > 0 || body.angular_drag > 0, "drag");
  derive_mass(body);
  if (!body.is_dynamic()) body.asleep = false;
  if (body.asleep) {
    body.velocity = Vec<D>(0.0);
    body.angular_momentum = Spin<D>(0.0);
  }
  if (angular_velocity != Spin<D>(0.0)) spin(body, angular_velocity);
  body.id = next_id_;
  disturb();
  told_all_ = false;
  write_islands();
  may_rest_ |= body.asleep;
  bodies_.push_back(std::move(body));
  rested_.push_back(0);
  islands_.push_back(kNoIsland);
  return next_id_++;
}

// All of them in one pass through all else: one after another would cost the square of them.
template <int D>
void World<D>::remove(std::span<const BodyId> ids) {
  Scratch<BodyId> gone, disturbed;
  for (const BodyId id : ids)
    if (find(id) != nullptr) gone.push_back(id);
  if (gone.empty()) return;
  std::ranges::sort(gone);
  disturbed = with_untold_sleepers(gone);
  const auto is_gone = [&](BodyId id) { return std::ranges::binary_search(gone, id); };
  const auto goes = [&](const auto& tie) { return is_gone(tie.a) || is_gone(tie.b); };
  const auto disturb = [&](const auto& tie) {
    if (goes(tie)) disturbed.insert(disturbed.end(), {tie.a, tie.b});
  };
  for (const Spring<D>& spring : forces_.springs) disturb(spring);
  for (const auto& entry : joints_) disturb(entry.second);
  wake_from(disturbed);
  write_islands();
  std::erase_if(forces_.springs, goes);
  erase_where([&](std::size_t i) { return goes(joints_[i].second); }, joint_memories_, joints_);
  std::erase_if(forces_.pushes, [&](const Push<D>& push) { return is_gone(push.body); });
  forget_contacts_of(gone);
  erase_where([&](std::size_t i) { return is_gone(bodies_[i].id); }, rested_, islands_, bodies_);
  told_all_ = false;
  part_islands();
}

template <int D>
const Body<D>* World<D>::find(BodyId id) const {
  if (id < bodies_.size() && bodies_[id].id == id)
    return &bodies_[id];  // as long as none is removed
  const auto body = std::ranges::lower_bound(bodies_, id, {}, &Body<D>::id);
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
  wake_from(with_untold_sleepers(std::span(&id, 1)));
  forget_contacts_of(std::span(&id, 1));
  part_islands();
  moved.asleep = false;
  const auto here = static_cast<std::uint32_t>(index);
  if (!std::ranges::binary_search(stirred_, here))
    stirred_.insert(std::ranges::upper_bound(stirred_, here), here);
  bodies_[index] = std::move(moved);
}

template <int D>
void World<D>::set_velocities(std::span<const std::pair<BodyId, Vec<D>>> velocities) {
  if (velocities.empty()) return;
  Scratch<BodyId> ids;
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
  if (body.is_dynamic())
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
  if (!body.is_dynamic()) return;
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
  Scratch<BodyId> all;
  for (const Body<D>& body : bodies_) all.push_back(body.id);
  wake_from(all);
  config_.gravity = forces_.gravity = gravity;
}

template <int D>
void World<D>::wake_from(std::span<const BodyId> ids) {
  disturb();
  if (!may_rest_) return;
  write_islands();
  Scratch<std::uint32_t> places;
  for (const BodyId id : ids) places.push_back(static_cast<std::uint32_t>(index_of(id)));
  // Those awake, too, must now rest anew before they may sleep.
  for (const std::uint32_t i :
       woken_with<D>(bodies_, std::move(places), links(), [](std::uint32_t) { return true; })) {
    bodies_[i].asleep = false;
    rested_[i] = 0;
  }
  rouse_touches();
}

template <int D>
Scratch<BodyId> World<D>::with_untold_sleepers(std::span<const BodyId> ids) const {
  Scratch<BodyId> all;
  all.assign(ids.begin(), ids.end());
  if (!may_rest_ || config_.contacts == ContactMethod::none) return all;
  Scratch<std::uint8_t> is_told(bodies_.size());
  each_touch([&](const Touch<D>& touch) {
    is_told[index_of(touch.record.a)] = is_told[index_of(touch.record.b)] = true;
  });
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body<D>& sleeper = bodies_[i];
    if (!sleeper.asleep || is_told[i]) continue;
    const auto touches = [&](BodyId id) {
      const Body<D>& body = bodies_[index_of(id)];
      const double slack = thinner(body, sleeper) * kStepSettings.slack;
      return body.id != sleeper.id && body.collides && sleeper.collides &&
             collide(placed(body), placed(sleeper), slack).has_value();
    };
    if (std::ranges::any_of(ids, touches)) all.push_back(sleeper.id);
  }
  return all;
}

template <int D>
auto World<D>::active() -> const Active& {
  if (active_) return *active_;
  constexpr std::size_t kFew = 8;  // costs less to look at all than to find out who is where
  Scratch<std::uint32_t> some;
  Active found;
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i].moves() && !bodies_[i].asleep) some.push_back(i);
    found.asleep += bodies_[i].asleep;
  }
  const Scratch<Pair> tied = ties();
  if (kFew * some.size() > bodies_.size() || forces_.gravitation > 0) {
    some.resize(bodies_.size());
    std::iota(some.begin(), some.end(), 0u);
  } else if (!tied.empty()) {
    some = woken_with<D>(bodies_, std::move(some), tied, [](std::uint32_t) { return true; });
  }
  Scratch<std::uint8_t> moves(bodies_.size());
  for (const std::uint32_t i : some) moves[i] = bodies_[i].moves();
  found.bodies = std::move(some);
  find_ties(found, [&](std::uint32_t i) { return moves[i]; });
  return active_.emplace(std::move(found));
}

// f(touch) for all, by pair.
template <int D>
template <class F>
void World<D>::each_touch(F&& f) const {
  auto next = slept_.begin();
  for (const Touch<D>& touch : touching_) {
    for (; next != slept_.end() && next->record.pair() < touch.record.pair(); ++next) f(*next);
    f(touch);
  }
  for (; next != slept_.end(); ++next) f(*next);
}

// What has touched in its sleep touches awake from now on.
template <int D>
void World<D>::rouse_touches() {
  if (slept_.empty()) return;
  told_whole();
  std::erase_if(slept_, [&](const Touch<D>& touch) {
    const bool stirs =
        bodies_[index_of(touch.record.a)].stirs() || bodies_[index_of(touch.record.b)].stirs();
    if (stirs) touching_.push_back(touch);
    return stirs;
  });
  std::ranges::sort(touching_, {}, [](const Touch<D>& touch) { return touch.record.pair(); });
}

// Of two that sleep a step tells what it told when they fell asleep, but that it is nothing new.
template <int D>
auto World<D>::told_whole() const -> const Outcome& {
  if (std::exchange(outcome_.whole, true) || slept_.empty()) return outcome_;
  const auto add = [&](auto& list, auto pair_of, auto&& made) {
    std::remove_reference_t<decltype(list)> all;
    all.reserve(list.size() + slept_.size());
    auto next = list.begin();
    for (const Touch<D>& slept : slept_) {
      const Pair pair = slept.record.pair();
      while (next != list.end() && std::invoke(pair_of, *next) < pair) all.push_back(*next++);
      if (next == list.end() || std::invoke(pair_of, *next) != pair) all.push_back(made(slept));
    }
    all.insert(all.end(), next, list.end());
    list = std::move(all);
  };
  const int left = contact_solver(config_.contacts).frames_remembered - 1;
  using T = const Touch<D>&;
  add(outcome_.contacts, &Contact<D>::pair, [](T slept) { return slept.record; });
  add(outcome_.told, &ToldPair::pair, [&](T slept) { return ToldPair{slept.record.pair(), left}; });
  add(outcome_.events, &ContactEvent::pair, [](T slept) {
    const auto [a, b] = slept.record.pair();
    return ContactEvent{ContactEvent::Kind::stay, a, b, slept.crushes};
  });
  return outcome_;
}

// Bodies that sleep hang together as when they fell asleep.
template <int D>
void World<D>::write_islands() const {
  if (std::exchange(knows_islands_, true)) return;
  DisjointSets sets(bodies_.size());
  for (const auto& [place, root] : roots_) sets.unite(place, root);
  const auto unite_sleepers = [&](const auto& link) {
    const std::size_t a = index_of(link.a), b = index_of(link.b);
    if (bodies_[a].asleep && bodies_[b].asleep)
      sets.unite(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
  };
  for (const Pair& link : links()) unite_sleepers(link);
  for (std::uint32_t i = 0; i < bodies_.size(); ++i)
    islands_[i] = bodies_[i].is_dynamic() ? bodies_[sets.root(i)].id : kNoIsland;
}

// Of each island what still touches or is tied stays together.
template <int D>
void World<D>::part_islands() {
  write_islands();
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
  const auto goes = [&](const Touch<D>& touch) {
    return is_of(touch.record.a) || is_of(touch.record.b);
  };
  told_whole();
  std::erase_if(touching_, goes);
  std::erase_if(slept_, goes);
}

template <int D>
void World<D>::sleep(BodyId id) {
  Body<D>& body = bodies_[index_of(id)];
  if (!body.is_dynamic()) return;
  disturb();
  write_islands();
  may_rest_ = body.asleep = true;
  body.velocity = Vec<D>(0.0);
  body.angular_momentum = Spin<D>(0.0);
}

template <int D>
void World<D>::switch_contacts(ContactMethod method, int sub_steps, int iterations,
                               std::optional<double> wanted_error) {
  if (config_.contacts == ContactMethod::none || method == ContactMethod::none)
    throw Refused("world: contacts cannot be switched on or off, only be solved another way");
  WorldConfig<D> config = config_;
  config.contacts = method;
  config.sub_steps = sub_steps;
  config.iterations = iterations;
  config.wanted_error = wanted_error;
  check_config(config);
  told_whole();
  config_ = config;
  rests_ = false;
}

template <int D>
SpringId World<D>::add_spring(const Spring<D>& spring) {
  const Body<D>& a = bodies_[index_of(spring.a)];
  const Body<D>& b = bodies_[index_of(spring.b)];
  const std::string who = fmt::format("spring {}", next_spring_);
  if (spring.a == spring.b)
    throw Refused(fmt::format("{}: both ends are on body {}", who, spring.a));
  require_finite<D>(spring.at_a, who, "at_a");
  require_finite<D>(spring.at_b, who, "at_b");
  require_not_negative(spring.rest_length, who, "rest_length");
  require_not_negative(spring.stiffness, who, "stiffness");
  require_not_negative(spring.damping, who, "damping");
  const Integrator of_a = a.integrator.value_or(config_.integrator);
  const Integrator of_b = b.integrator.value_or(config_.integrator);
  if (a.is_dynamic() && b.is_dynamic() && of_a != of_b)
    throw Refused(fmt::format("spring between '{}' and '{}': one is moved by {}, the other by {}",
                              a.name, b.name, to_string(of_a), to_string(of_b)));
  for (const Body<D>* end : {&a, &b}) require_known(config_, *end, spring.damping > 0, "damping");
  wake_from(std::array{spring.a, spring.b});
  forces_.springs.push_back(spring);
  forces_.springs.back().id = next_spring_;
  return next_spring_++;
}

template <int D>
JointId World<D>::add_joint(const Joint<D>& joint) {
  const std::string who = fmt::format("joint {}", next_joint_);
  const Body<D>& a = bodies_[index_of(joint.a)];
  const Body<D>& b = bodies_[index_of(joint.b)];
  if (joint.a == joint.b) throw Refused(fmt::format("{}: joins a body to itself", who));
  if (!a.is_dynamic() && !b.is_dynamic())
    throw Refused(fmt::format("{}: neither of its bodies can be moved", who));
  require_finite<D>(joint.at_a, who, "at_a");
  require_finite<D>(joint.at_b, who, "at_b");
  if (joint.kind == JointKind::distance && !(std::isfinite(joint.length) && joint.length > 0))
    throw Refused(fmt::format("{}: length is {}, must be above 0", who, joint.length));
  for (const Body<D>* end : {&a, &b}) require_known(config_, *end, true, "joints");
  wake_from(std::array{joint.a, joint.b});
  joints_.emplace_back(next_joint_, joint);
  joint_memories_.push_back({});
  return next_joint_++;
}

template <int D>
void World<D>::remove_spring(SpringId id) {
  const auto spring = std::ranges::find(forces_.springs, id, &Spring<D>::id);
  if (spring == forces_.springs.end()) return;
  wake_from(std::array{spring->a, spring->b});
  forces_.springs.erase(spring);
  part_islands();
}

template <int D>
void World<D>::remove_joint(JointId id) {
  const auto entry = std::ranges::find(joints_, id, &std::pair<JointId, Joint<D>>::first);
  if (entry == joints_.end()) return;
  wake_from(std::array{entry->second.a, entry->second.b});
  joint_memories_.erase(joint_memories_.begin() + (entry - joints_.begin()));
  joints_.erase(entry);
  part_islands();
}

template <int D>
Scratch<Pair> World<D>::links() const {
  Scratch<Pair> all = ties();
  each_touch([&](const Touch<D>& touch) { all.push_back(touch.record.pair()); });
  return all;
}

template <int D>
Scratch<Pair> World<D>::ties() const {
  Scratch<Pair> all;
  for (const Spring<D>& spring : forces_.springs) all.push_back({spring.a, spring.b});
  for (const auto& entry : joints_) all.push_back({entry.second.a, entry.second.b});
  return all;
}

template <int D>
void World<D>::push(BodyId id, const Vec<D>& force, const Vec<D>& at,
                    std::optional<double> seconds) {
  const Body<D>& body = bodies_[index_of(id)];
  const std::string who = fmt::format("body '{}'", body.name);
  require_finite<D>(force, who, "force");
  require_finite<D>(at, who, "point of the force");
  const Vec<D> arm = at - body.position;
  require_finite<D>(arm, who, "lever of the force");
  if (seconds && !(std::isfinite(*seconds) && *seconds > 0))
    throw Refused(fmt::format("{}: a push of {} seconds is not allowed", who, *seconds));
  wake_from(id);
  forces_.pushes.push_back({id, arm, force});
  if (seconds) forces_.pushes.back().until = time_ + *seconds;
}

template <int D>
void World<D>::clear_pushes() {
  Scratch<BodyId> pushed;
  for (const Push<D>& push : forces_.pushes) pushed.push_back(push.body);
  wake_from(pushed);
  forces_.pushes.clear();
}

template <int D>
void World<D>::clear_pushes(BodyId id) {
  if (find(id) != nullptr) wake_from(id);
  std::erase_if(forces_.pushes, [&](const Push<D>& push) { return push.body == id; });
}

template <int D>
std::uint64_t World<D>::hash() const {
  Hash hash;
  hash.add(time_);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body<D>& body = bodies_[i];
    hash.add(std::uint64_t{body.id}).add(std::uint64_t{body.asleep});
    add_to(hash, body.position);
    add_to(hash, body.orientation);
    add_to(hash, body.velocity);
    add_to(hash, body.angular_momentum);
    add_to(hash, body.kinematic_spin);
    hash.add(body.inverse_mass).add(rested_[i]);
  }
  add_to(hash, forces_.gravity);
  if (forces_.gravitation > 0) hash.add(forces_.gravitation);
  for (const Spring<D>& spring : forces_.springs) {
    hash.add(std::uint64_t{spring.a}).add(std::uint64_t{spring.b});
    add_to(hash, spring.at_a);
    add_to(hash, spring.at_b);
    hash.add(spring.rest_length).add(spring.stiffness).add(spring.damping);
  }
  for (const Push<D>& push : forces_.pushes) {
    hash.add(std::uint64_t{push.body});
    add_to(hash, push.at);
    add_to(hash, push.force);
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    hash.add(std::uint64_t{joints_[i].first});
    add_to(hash, joint_memories_[i].impulse);
  }
  each_touch([&](const Touch<D>& touch) {
    hash.add(std::uint64_t{touch.record.a}).add(std::uint64_t{touch.record.b});
    add_to(hash, touch.memory);
  });
  return hash.value();
}

template class World<2>;
template class World<3>;

}  // namespace lantern::physics
