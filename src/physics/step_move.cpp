// The second half of a step: bodies move, some fall asleep, and what touches is noted.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "base/stop.hpp"
#include "geometry/not_finite.hpp"
#include "physics/contact_solver.hpp"
#include "physics/crushing.hpp"
#include "physics/impacts.hpp"
#include "physics/step.hpp"

namespace lantern::physics {

// Which bodies, pairs and joints the solver is given together: those of each island, or of the
// whole world. What neither touches nor is joined is in none of them, but flies.
template <int D>
auto World<D>::Step::groups_to_solve(bool whole_world) const -> std::vector<Group> {
  const auto dynamic = [&](std::uint32_t i) { return moved[i].kind == BodyKind::dynamic_body; };
  const auto own = [&](std::uint32_t i) { return whole_world ? 0 : root[i]; };
  const auto owner = [&](std::uint32_t a, std::uint32_t b) { return own(dynamic(a) ? a : b); };
  const auto places = [&](const auto& tie) { return std::pair(place_of(tie.a), place_of(tie.b)); };
  // Of each root the number of its group, if pairs or joints are to be solved in it.
  std::vector<std::uint32_t> number(moved.size(), kNone);
  for (const NearPair& pair : near) number[owner(pair.a, pair.b)] = 0;
  for (const auto& [id, joint] : world.joints_) number[std::apply(owner, places(joint))] = 0;
  std::vector<Group> groups;
  for (std::uint32_t& n : number) {
    if (n == kNone) continue;
    n = static_cast<std::uint32_t>(groups.size());
    groups.emplace_back();
  }
  const auto add = [&](std::uint32_t to, auto list, auto what) {
    if (number[to] != kNone) (groups[number[to]].*list).push_back(what);
  };
  for (std::size_t i = 0; i < near.size(); ++i) add(owner(near[i].a, near[i].b), &Group::pairs, i);
  for (std::size_t i = 0; i < world.joints_.size(); ++i)
    add(std::apply(owner, places(world.joints_[i].second)), &Group::joints, i);
  for (std::size_t i = 0; i < forces.springs.size(); ++i) {
    const auto [a, b] = places(forces.springs[i]);
    if (whole_world || dynamic(a) || dynamic(b)) add(owner(a, b), &Group::springs, i);
  }
  for (std::size_t i = 0; i < forces.pushes.size(); ++i) {
    const std::uint32_t pushed = place_of(forces.pushes[i].body);
    if (whole_world || dynamic(pushed)) add(own(pushed), &Group::pushes, i);
  }
  for (std::uint32_t i = 0; i < moved.size(); ++i)
    if (whole_world || dynamic(i)) add(own(i), &Group::bodies, i);
  std::erase_if(groups, [&](const Group& group) {
    return std::ranges::all_of(group.bodies, [&](std::uint32_t i) { return moved[i].asleep; });
  });
  return groups;
}

template <int D>
void World<D>::Step::solve_and_integrate() {
  const ContactSolver<D>& solver = contact_solver<D>(world.config_.contacts);
  std::vector<std::uint8_t> solved(moved.size());
  touch_of.assign(near.size(), kNone);
  touching.reserve(std::min(near.size(), world.touching_.size() + world.touching_.size() / 8));
  int budget = world.config_.impact_budget;
  const std::uint64_t located = world.work_.impacts_located;
  for (const Group& group : groups_to_solve(solver.whole_world)) {
    stop_if_asked();
    Island<D> island = gather(group);
    ++world.work_.islands_solved;
    if (solver.whole_world)
      solver.solve(island, world.config_, h, h, world.work_);
    else
      move_through_impacts(island, solver, world.config_, h, budget, world.work_, impacts);
    bring_back(island, group);
    for (const std::uint32_t i : group.bodies)
      solved[i] = moved[i].kind == BodyKind::dynamic_body && !moved[i].asleep;
  }
  struck = world.work_.impacts_located != located;
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (!solved[i]) fly(moved[i], increments()[i], h, world.config_.rotation, world.work_);
}

template <int D>
Island<D> World<D>::Step::gather(const Group& group) {
  Island<D> island;
  std::vector<std::uint32_t> others;  // static bodies, and ends of springs
  const auto add = [&](BodyId id) { others.push_back(place_of(id)); };
  for (const std::size_t i : group.pairs)
    for (const std::uint32_t place : {near[i].a, near[i].b})
      if (moved[place].kind != BodyKind::dynamic_body) others.push_back(place);
  for (const std::size_t i : group.joints) {
    add(world.joints_[i].second.a);
    add(world.joints_[i].second.b);
  }
  island.forces.gravity = forces.gravity;
  island.forces.gravitation = forces.gravitation;
  if (forces.gravitation > 0)
    for (const Body<D>& body : moved) add(body.id);
  for (const std::size_t i : group.springs) {
    const Spring<D>& spring = forces.springs[i];
    island.forces.springs.push_back(spring);
    add(spring.a);
    add(spring.b);
  }
  for (const std::size_t i : group.pushes) island.forces.pushes.push_back(forces.pushes[i]);
  // Once each, in their order.
  std::ranges::sort(others);
  others.erase(std::unique(others.begin(), others.end()), others.end());
  island.places.reserve(group.bodies.size() + others.size());
  std::ranges::set_union(group.bodies, others, std::back_inserter(island.places));
  for (const std::uint32_t place : island.places) island.bodies.push_back(moved[place]);

  local_place.resize(moved.size());
  for (std::uint32_t i = 0; i < island.places.size(); ++i) local_place[island.places[i]] = i;
  const auto local = [&](std::uint32_t place) { return local_place[place]; };
  island.pairs.reserve(group.pairs.size());
  for (const std::size_t i : group.pairs) {
    stop_if_asked();
    island.pairs.push_back(island_pair(near[i]));
    ContactRows<D>& rows = island.pairs.back().rows;
    rows.a = local(rows.a);
    rows.b = local(rows.b);
  }
  for (const std::size_t i : group.joints) {
    JointRows<D> rows{.joint = world.joints_[i].second, .place = static_cast<std::uint32_t>(i)};
    rows.a = local(place_of(rows.joint.a));
    rows.b = local(place_of(rows.joint.b));
    const JointMemory& memory = world.joint_memories_[i];
    rows.seconds = memory.seconds;
    rows.backoff = memory.backoff;
    if (memory.seconds > 0) rows.impulse = memory.impulse;
    island.joints.push_back(rows);
  }
  return island;
}

template <int D>
void World<D>::Step::bring_back(Island<D>& island, const Group& group) {
  for (std::size_t i = 0; i < island.places.size(); ++i)
    if (island.bodies[i].kind == BodyKind::dynamic_body)
      moved[island.places[i]] = std::move(island.bodies[i]);
  for (const JointRows<D>& rows : island.joints)
    joint_memories[rows.place] = {rows.impulse, island.joint_seconds, rows.backoff};
  for (std::size_t i = 0; i < island.pairs.size(); ++i) {
    stop_if_asked();
    const IslandPair<D>& pair = island.pairs[i];
    if (!pair.touched) continue;
    touch_of[group.pairs[i]] = static_cast<std::uint32_t>(touching.size());
    touching.push_back({pair.record, pair.memory, pair.remembered ? pair.seconds : 0});
  }
}

template <int D>
void World<D>::Step::require_no_overflow() const {
  const auto refuse = [&](const Body<D>& body, const char* field) {
    throw Refused(
        fmt::format("body '{}': {} overflows in step {}", body.name, field, world.work_.steps + 1));
  };
  for (const Body<D>& body : moved) {
    if (!is_finite(body.velocity)) refuse(body, "velocity");
    if (!is_finite(body.angular_momentum)) refuse(body, "angular_momentum");
    if (!is_valid(body.box())) refuse(body, "position");
  }
}

// Whether all bodies were looked for where they have been; if not, `reach` has grown.
template <int D>
bool World<D>::Step::stayed_within_reach() {
  if (!locates_impacts()) return true;
  // What is pushed apart goes no farther than it is allowed to; only an impact does.
  if (world.config_.wanted_error > 0 && !struck) return true;
  bool stayed = true;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (moved[i].kind != BodyKind::dynamic_body || moved[i].asleep) continue;
    const double way = glm::length(moved[i].position - world.bodies_[i].position);
    if (way <= reach[i] * (1 + kStepSettings.rounding)) continue;
    reach[i] = 2 * std::max(way, glm::length(moved[i].velocity) * h);
    stayed = false;
  }
  return stayed;
}

// Slow, and slow for another second if it is accelerated as in this step: a pendulum at its turning
// point is not at rest.
template <int D>
bool World<D>::Step::is_slow(std::size_t place) const {
  const Body<D>& body = moved[place];
  const Body<D>& before = world.bodies_[place];
  const double gained = glm::length(body.velocity - before.velocity) / h;
  const Spin<D> spin = angular_velocity(body), spin_before = angular_velocity(before);
  const Spin<D> turned_faster = spin - spin_before;
  const double spun = std::sqrt(dot(turned_faster, turned_faster)) / h;
  // What is pushed out of another one moves, too, though it has no velocity.
  const double way = glm::length(body.position - before.position) / h;
  return std::max(glm::length(body.velocity), way) + gained <= world.config_.sleep_speed &&
         std::sqrt(dot(spin, spin)) + spun <= world.config_.sleep_spin;
}

// An island sleeps when all of it has been slow for a while and something holds it, or drag brakes
// it; a body that flies freely sleeps only if it does not move at all. What attracts each other
// never rests: something far away may come nearer.
template <int D>
void World<D>::Step::fall_asleep() {
  world.work_.asleep = 0;
  if (world.config_.may_sleep && !(forces.gravitation > 0)) {
    std::vector<std::uint8_t> restless(moved.size()), held(moved.size());
    for (const Touch& touch : touching)
      for (const BodyId id : {touch.record.a, touch.record.b}) {
        held[root[place_of(id)]] = true;
        const BodyId other = id == touch.record.a ? touch.record.b : touch.record.a;
        if (moved[place_of(id)].kind != BodyKind::dynamic_body && moved[place_of(id)].stirs())
          restless[root[place_of(other)]] = true;
      }
    for (const auto& entry : world.joints_)
      for (const BodyId id : {entry.second.a, entry.second.b}) held[root[place_of(id)]] = true;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const Body<D>& body = moved[i];
      if (body.kind != BodyKind::dynamic_body || body.asleep) continue;
      ++world.work_.rest_checks;
      const bool still = body.velocity == Vec<D>(0.0) && body.angular_momentum == Spin<D>(0.0) &&
                         increments()[i].kick == Vec<D>(0.0);
      const bool braked = body.linear_drag > 0 && (body.angular_drag > 0 || !body.may_turn ||
                                                   body.angular_momentum == Spin<D>(0.0));
      rested[i] = (held[root[i]] || braked ? is_slow(i) : still) ? rested[i] + h : 0;
      if (!(rested[i] >= world.config_.sleep_after)) restless[root[i]] = true;
    }
    for (std::size_t i = 0; i < moved.size(); ++i) {
      Body<D>& body = moved[i];
      if (body.kind != BodyKind::dynamic_body || body.asleep || restless[root[i]]) continue;
      body.asleep = true;
      body.velocity = Vec<D>(0.0);
      body.angular_momentum = Spin<D>(0.0);
    }
  }
  for (const Body<D>& body : moved) world.work_.asleep += body.asleep;
}

// In order of ids, as the near pairs are, with those of bodies that slept through.
template <int D>
void World<D>::Step::order_touches() {
  std::vector<Touch> slept, ordered;
  const auto rests = [&](BodyId id) {
    return !world.bodies_[place_of(id)].stirs() && !moved[place_of(id)].stirs();
  };
  for (const Touch& touch : world.touching_)
    if (rests(touch.record.a) && rests(touch.record.b)) slept.push_back(touch);
  ordered.reserve(touching.size() + slept.size());
  auto next = slept.begin();
  for (std::size_t i = 0; i < near.size(); ++i) {
    stop_if_asked();
    if (touch_of[i] == kNone) continue;
    Touch& touch = touching[touch_of[i]];
    while (next != slept.end() && next->record.pair() < touch.record.pair())
      ordered.push_back(std::move(*next++));
    if (next != slept.end() && next->record.pair() == touch.record.pair()) ++next;
    ordered.push_back(std::move(touch));
  }
  ordered.insert(ordered.end(), next, slept.end());
  touching = std::move(ordered);
}

// Contacts in order of ids, and what is new about them.
template <int D>
void World<D>::Step::update_contact_events() {
  order_touches();
  for (const Touch& touch : touching) contacts.push_back(touch.record);

  const std::vector<std::uint8_t> crush =
      crushing<D>(contacts, [&](BodyId id) -> const Body<D>& { return moved[place_of(id)]; });
  const int frames = contact_solver<D>(world.config_.contacts).frames_remembered;
  const std::vector<Told>& old = world.told_;
  std::size_t i = 0, j = 0;
  while (i < old.size() || j < contacts.size()) {
    stop_if_asked();
    const bool parted =
        j == contacts.size() || (i < old.size() && old[i].pair < contacts[j].pair());
    const bool known = parted || (i < old.size() && old[i].pair == contacts[j].pair());
    const Told now = {parted ? old[i].pair : contacts[j].pair(),
                      (parted ? std::min(old[i].frames_left, frames) : frames) - 1};
    if (parted && now.frames_left < 0)
      events.push_back({ContactEvent::Kind::end, now.pair.a, now.pair.b});
    else
      told.push_back(now);
    if (!parted)
      events.push_back({known ? ContactEvent::Kind::stay : ContactEvent::Kind::begin, now.pair.a,
                        now.pair.b, !crush.empty() && crush[j] != 0});
    if (known) ++i;
    if (!parted) ++j;
  }
}

template <int D>
void World<D>::Step::commit() {
  world.bodies_ = std::move(moved);
  world.rested_ = std::move(rested);
  world.may_rest_ = world.work_.asleep > 0 ||
                    std::ranges::any_of(world.rested_, [](double seconds) { return seconds > 0; });
  for (std::size_t i = 0; i < world.bodies_.size(); ++i)
    world.islands_[i] =
        world.bodies_[i].kind == BodyKind::dynamic_body ? world.bodies_[root[i]].id : kNoIsland;
  world.joint_memories_ = std::move(joint_memories);
  world.pushes_ = std::move(pushes);
  world.forces_.pushes = std::move(forces.pushes);
  world.touching_ = std::move(touching);
  world.contacts_ = std::move(contacts);
  world.events_ = std::move(events);
  world.told_ = std::move(told);
  world.pairs_ = std::move(pairs);
  world.impacts_ = std::move(impacts);
  world.ahead_.reset();
  world.time_ += h;
  ++world.work_.steps;
  world.work_.narrow_pairs += narrow_pairs;
}

#define LANTERN_INSTANTIATE(D)                               \
  template void World<D>::Step::solve_and_integrate();       \
  template void World<D>::Step::require_no_overflow() const; \
  template bool World<D>::Step::stayed_within_reach();       \
  template void World<D>::Step::fall_asleep();               \
  template void World<D>::Step::update_contact_events();     \
  template void World<D>::Step::commit();

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern::physics
