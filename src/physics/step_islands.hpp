// The islands of a step: which bodies hang together, what of them a solver is given and gives back,
// and which of them fall asleep.
#pragma once

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "base/scratch.hpp"
#include "base/stop.hpp"
#include "physics/contact/contact_solver.hpp"
#include "physics/islands.hpp"
#include "physics/world.hpp"

namespace lantern::physics {

// The numbers of a step, whatever the method.
struct StepSettings {
  int most_tries = 8;     // the last one counts even if a body went farther than was looked for
  double slack = 1e-3;    // of a body's thickness: nearer is looked at, too
  double fast = 0.5;      // of the thinner body's thickness in a step: may pass through
  double fast_quick = 2;  // the same where an error is wanted: rows hold what is slower
  std::size_t most_manifolds = 1 << 16;  // kept from the narrow phase; of more, made again
  double rounding = 1e-9;  // of a step's time, when a push ends; of a reach, whether it was kept
};
inline constexpr StepSettings kStepSettings;

// A body before the step, as each pair that it is in asks for it.
template <int D>
struct Look {
  Look(const Body<D>& body, double h)
      : axes(axes_of(body)),
        velocity(velocity_of(body)),
        turning(turning_way(body, h)),
        thick(thickness<D>(body.shape)) {}

  // How far its surface may come if no force acts.
  double coasting_reach(double h) const {
    const double slack = thick < kEndless ? thick * kStepSettings.slack : 0;
    return slack + turning + glm::length(velocity) * h;
  }

  Mat<D> axes;
  Vec<D> velocity;
  double turning;  // how far its surface turns
  double thick;
};

template <int D>
template <class F>
void World<D>::find_ties(Active& active, F&& moves) const {
  const auto look_at = [&](const auto& tie, std::size_t i, Scratch<std::size_t>& found) {
    const auto a = static_cast<std::uint32_t>(index_of(tie.a));
    const auto b = static_cast<std::uint32_t>(index_of(tie.b));
    if (!moves(a) && !moves(b)) return;
    found.push_back(i);
    active.bodies.insert(active.bodies.end(), {a, b});
  };
  for (std::size_t i = 0; i < joints_.size(); ++i) look_at(joints_[i].second, i, active.joints);
  for (std::size_t i = 0; i < forces_.springs.size(); ++i)
    look_at(forces_.springs[i], i, active.springs);
}

template <int D>
struct World<D>::StepIslands {
  // Two bodies that may touch. Of what an IslandPair holds only what is known before the island is
  // moved: there may be millions.
  struct NearPair {
    std::uint32_t a = 0, b = 0;  // places among those that take part
    double restitution = 0;
    double friction = 0;
    double reach = 0;
    const Touch<D>* touch = nullptr;  // of the step before, if they touched in it
    std::uint32_t manifold = kNone;   // as they were found to lie; none of too many
    double fast = 0;                  // see IslandPair
    bool located = false;
  };
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  // What a solver is given together: places of bodies, of near pairs, of joints, of what pulls and
  // pushes them; all ascending, and among those that take part.
  struct Group {
    Scratch<std::uint32_t> bodies;
    Scratch<std::size_t> pairs, joints, springs, pushes;
  };

  // How far each was looked for in an earlier try.
  struct Reached {
    Scratch<std::uint32_t> places;
    Scratch<double> reach;
  };

  StepIslands(World& of, double seconds, Reached before)
      : world(of), h(seconds), reached(std::move(before)) {
    forces.gravity = world.forces_.gravity;
    forces.gravitation = world.forces_.gravitation;
    asleep = world.active().asleep;
    take_part(world.active());
  }

  World& world;
  double h;
  Reached reached;
  // Who takes part: what is awake, and what it is tied to or may touch. The rest of the world is
  // neither copied nor looked at.
  Scratch<std::uint32_t> places = {};  // in the world, ascending
  std::vector<Body<D>>& moved = world.next_bodies_;
  Scratch<double> rested = {};
  Scratch<double> reach = {};  // of each: how far its surface may come; at least as given
  Scratch<Increment<D>> increments = {};  // over the whole step, if nothing touches
  Scratch<std::size_t> joints = {};       // that hold some of them: places in the world
  Scratch<JointMemory<D>> joint_memories = {};
  Forces<D> forces = {};        // that act among them
  std::size_t asleep = 0;       // bodies of the whole world
  bool woke = false;            // any, in this step
  Scratch<NearPair> near = {};  // in order of ids
  Scratch<Manifold<D>> manifolds = {};
  Scratch<std::uint32_t> root = {};         // of each body's island; static ones have their own
  Scratch<std::uint32_t> local_place = {};  // of each body in the island that was gathered last
  Scratch<double> farthest = {};            // of each body, in its island
  Scratch<Touch<D>> touching = {};
  Pair last = {};                        // of these
  bool in_order = true;                  // of ids are they
  Scratch<std::uint32_t> touch_of = {};  // of each near pair; kNone: it did not touch

  // Its place among those that take part; kNone if it does not.
  std::uint32_t local(std::uint32_t place) const {
    if (place < places.size() && places[place] == place) return place;  // as if all do
    const auto found = std::ranges::lower_bound(places, place);
    const bool is_there = found != places.end() && *found == place;
    return is_there ? static_cast<std::uint32_t>(found - places.begin()) : kNone;
  }
  std::uint32_t in_world(BodyId id) const { return static_cast<std::uint32_t>(world.index_of(id)); }
  std::uint32_t place_of(BodyId id) const { return local(in_world(id)); }
  const Joint<D>& joint(std::size_t i) const { return world.joints_[joints[i]].second; }

  // These, too, from now on.
  void take_part(Scratch<std::uint32_t> more) {
    if (!std::ranges::is_sorted(more)) std::ranges::sort(more);
    more.erase(std::ranges::unique(more).begin(), more.end());
    if (!places.empty())
      std::erase_if(more, [&](std::uint32_t place) { return local(place) != kNone; });
    const bool at_first = places.empty();  // then reaches are still to be found
    std::size_t from = places.size(), left = more.size(), to = from + left;
    const auto resize = [&](auto&... lists) { (lists.resize(to), ...); };
    resize(places, rested, reach, increments);
    to > 0 ? moved.resize(to, world.bodies_[0]) : moved.clear();
    while (left > 0) {
      --to;
      if (from > 0 && places[from - 1] > more[left - 1]) {
        --from;
        const auto shift = [&](auto&... lists) { ((lists[to] = std::move(lists[from])), ...); };
        shift(places, moved, rested, reach, increments);
        continue;
      }
      const std::uint32_t place = places[to] = more[--left];
      moved[to] = world.bodies_[place];
      rested[to] = world.rested_[place];
      increments[to] = {};
      const double coasting = at_first ? 0 : Look<D>(moved[to], h).coasting_reach(h);
      reach[to] = std::max(coasting, reach_before(place));
    }
  }
  double reach_before(std::uint32_t place) const {
    const auto known = std::ranges::lower_bound(reached.places, place);
    if (known == reached.places.end() || *known != place) return 0;
    return reached.reach[static_cast<std::size_t>(known - reached.places.begin())];
  }

  // Those at these places of the world, and what hangs on them, if they sleep.
  void wake(Scratch<std::uint32_t> sleepers) {
    if (sleepers.empty()) return;
    const auto sleeps = [&](std::uint32_t place) {
      const std::uint32_t i = local(place);
      return i == kNone ? world.bodies_[place].asleep : moved[i].asleep;
    };
    const Scratch<std::uint32_t> woken =
        woken_with<D>(world.bodies_, std::move(sleepers), world.links(), sleeps);
    if (woken.empty()) return;
    woke = true;
    asleep -= woken.size();
    take_part(woken);
    for (const std::uint32_t place : woken) {
      moved[local(place)].asleep = false;
      rested[local(place)] = 0;
    }
    Active active;
    world.find_ties(active, [&](std::uint32_t place) {
      const std::uint32_t i = local(place);
      return i != kNone && moved[i].moves();
    });
    take_part(active);
  }

  void take_part(const Active& active) {
    joints = active.joints;
    forces.springs.clear();
    for (const std::size_t i : active.springs) forces.springs.push_back(world.forces_.springs[i]);
    take_part(active.bodies);
  }

  // Static and kinematic bodies do not join what touches them.
  void make_islands() {
    if (near.empty() && joints.empty() && forces.springs.empty() && !(forces.gravitation > 0)) {
      root.resize(moved.size());
      std::iota(root.begin(), root.end(), 0u);
      return count_islands();
    }
    DisjointSets sets(moved.size());
    const auto unite = [&](std::uint32_t a, std::uint32_t b) {
      if (moved[a].is_dynamic() && moved[b].is_dynamic()) sets.unite(a, b);
    };
    for (const NearPair& pair : near) unite(pair.a, pair.b);
    for (std::size_t i = 0; i < joints.size(); ++i)
      unite(place_of(joint(i).a), place_of(joint(i).b));
    for (const Spring<D>& spring : forces.springs) unite(place_of(spring.a), place_of(spring.b));
    // What attracts hangs together over any distance.
    std::optional<std::uint32_t> first;
    for (std::uint32_t i = 0; forces.gravitation > 0 && i < moved.size(); ++i) {
      if (!moved[i].is_dynamic()) continue;
      if (!first) first = i;
      unite(*first, i);
    }
    root.clear();
    for (std::size_t i = 0; i < moved.size(); ++i)
      root.push_back(sets.root(static_cast<std::uint32_t>(i)));
    count_islands();
  }

  void count_islands() const {
    world.work_.islands = 0;
    for (std::size_t i = 0; i < moved.size(); ++i)
      world.work_.islands += root[i] == i && moved[i].is_pushed();
  }

  // Which bodies, pairs and joints the solver is given together: those of each island, or of the
  // whole world. What neither touches nor is joined is in none of them, but flies.
  Scratch<Group> groups_to_solve(bool whole_world) const {
    if (near.empty() && joints.empty()) return {};
    const auto dynamic = [&](std::uint32_t i) { return moved[i].is_dynamic(); };
    const auto own = [&](std::uint32_t i) { return whole_world ? 0 : root[i]; };
    const auto owner = [&](std::uint32_t a, std::uint32_t b) { return own(dynamic(a) ? a : b); };
    const auto ends = [&](const auto& tie) { return std::pair(place_of(tie.a), place_of(tie.b)); };
    // Of each root the number of its group, if pairs or joints are to be solved in it.
    Scratch<std::uint32_t> number(moved.size(), kNone);
    for (const NearPair& pair : near) number[owner(pair.a, pair.b)] = 0;
    for (std::size_t i = 0; i < joints.size(); ++i) number[std::apply(owner, ends(joint(i)))] = 0;
    Scratch<Group> groups;
    for (std::uint32_t& n : number) {
      if (n == kNone) continue;
      n = static_cast<std::uint32_t>(groups.size());
      groups.emplace_back();
    }
    const auto add = [&](std::uint32_t to, auto list, auto what) {
      if (number[to] != kNone) (groups[number[to]].*list).push_back(what);
    };
    for (std::size_t i = 0; i < near.size(); ++i)
      add(owner(near[i].a, near[i].b), &Group::pairs, i);
    for (std::size_t i = 0; i < joints.size(); ++i)
      add(std::apply(owner, ends(joint(i))), &Group::joints, i);
    for (std::size_t i = 0; i < forces.springs.size(); ++i) {
      const auto [a, b] = ends(forces.springs[i]);
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

  Island<D> gather(const Group& group) {
    Island<D> island;
    Scratch<std::uint32_t> others;  // static bodies, and ends of springs
    const auto add = [&](BodyId id) { others.push_back(place_of(id)); };
    for (const std::size_t i : group.pairs)
      for (const std::uint32_t place : {near[i].a, near[i].b})
        if (!moved[place].is_dynamic()) others.push_back(place);
    for (const std::size_t i : group.joints) {
      add(joint(i).a);
      add(joint(i).b);
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
      fill(island.pairs.emplace_back(), near[i]);
      ContactRows<D>& rows = island.pairs.back().rows;
      rows.a = local(rows.a);
      rows.b = local(rows.b);
    }
    for (const std::size_t i : group.joints) {
      JointRows<D> rows{.joint = joint(i), .place = static_cast<std::uint32_t>(i)};
      rows.a = local(place_of(rows.joint.a));
      rows.b = local(place_of(rows.joint.b));
      const JointMemory<D>& memory = world.joint_memories_[joints[i]];
      rows.seconds = memory.seconds;
      rows.backoff = memory.backoff;
      if (memory.seconds > 0) rows.impulse = memory.impulse;
      island.joints.push_back(rows);
    }
    return island;
  }

  void bring_back(Island<D>& island, const Group& group) {
    farthest.resize(moved.size());
    for (std::size_t i = 0; i < island.farthest.size(); ++i)
      farthest[island.places[i]] = island.farthest[i];
    for (std::size_t i = 0; i < island.places.size(); ++i)
      if (island.bodies[i].is_dynamic()) moved[island.places[i]] = std::move(island.bodies[i]);
    for (const JointRows<D>& rows : island.joints)
      joint_memories[rows.place] = {rows.impulse, island.joint_seconds, rows.backoff};
    for (std::size_t i = 0; i < island.pairs.size(); ++i) {
      stop_if_asked();
      const IslandPair<D>& pair = island.pairs[i];
      if (!pair.touched) continue;
      in_order = in_order && (touching.empty() || last < pair.record.pair());
      last = pair.record.pair();
      touch_of[group.pairs[i]] = static_cast<std::uint32_t>(touching.size());
      touching.push_back({pair.record, pair.remembered(), pair.seconds});
    }
  }

  // An island sleeps when all of it has been slow for a while and something holds it, or drag
  // brakes it; a body that flies freely sleeps only if it does not move at all. What attracts each
  // other never rests: something far away may come nearer.
  void fall_asleep() {
    if (world.config_.may_sleep && !(forces.gravitation > 0)) {
      Scratch<std::uint8_t> restless(moved.size()), held(moved.size());
      for (std::size_t k = 0; k < near.size(); ++k) {
        if (touch_of[k] == kNone) continue;
        const auto [a, b] = std::pair(near[k].a, near[k].b);
        for (const std::uint32_t i : {a, b}) {
          held[root[i]] = true;
          if (!moved[i].is_dynamic() && moved[i].stirs()) restless[root[i == a ? b : a]] = true;
        }
      }
      for (std::size_t i = 0; i < joints.size(); ++i)
        for (const BodyId id : {joint(i).a, joint(i).b}) held[root[place_of(id)]] = true;
      for (std::size_t i = 0; i < moved.size(); ++i) {
        const Body<D>& body = moved[i];
        if (!body.is_pushed()) continue;
        ++world.work_.rest_checks;
        const bool still = body.velocity == Vec<D>(0.0) && body.angular_momentum == Spin<D>(0.0) &&
                           increments[i].kick == Vec<D>(0.0);
        const bool braked = body.linear_drag > 0 && (body.angular_drag > 0 || !body.may_turn ||
                                                     body.angular_momentum == Spin<D>(0.0));
        rested[i] = (held[root[i]] || braked ? is_slow(i) : still) ? rested[i] + h : 0;
        if (!(rested[i] >= world.config_.sleep_after)) restless[root[i]] = true;
      }
      for (std::size_t i = 0; i < moved.size(); ++i) {
        Body<D>& body = moved[i];
        if (!body.is_pushed() || restless[root[i]]) continue;
        body.asleep = true;
        ++asleep;
        body.velocity = Vec<D>(0.0);
        body.angular_momentum = Spin<D>(0.0);
      }
    }
    world.work_.asleep = asleep;
  }

  // In order of ids, as the near pairs are.
  void order_touches() {
    if (in_order) return;
    Scratch<Touch<D>> ordered;
    ordered.reserve(touching.size());
    for (std::size_t i = 0; i < near.size(); ++i) {
      stop_if_asked();
      if (touch_of[i] != kNone) ordered.push_back(std::move(touching[touch_of[i]]));
    }
    touching = std::move(ordered);
  }

  // Touches of two that do not move any more leave the list of those that a step goes through.
  // Nothing if those that sleep are the same.
  Scratch<Touch<D>> slept;
  bool sleeps_anew = false;  // `slept` is the world's list
  static Pair pair_of(const Touch<D>& touch) { return touch.record.pair(); }
  bool is_in(const Scratch<Touch<D>>& touches, const Pair& pair) const {
    return std::ranges::binary_search(touches, pair, {}, pair_of);
  }
  void keep_slept(const Scratch<Touch<D>>& more) {
    if (more.empty() && !(woke && !sleeps_anew)) return;
    if (!std::exchange(sleeps_anew, true))
      std::ranges::copy_if(world.slept_, std::back_inserter(slept),
                           [&](const Touch<D>& touch) { return slept_through(touch); });
    slept.insert(slept.end(), more.begin(), more.end());
    std::ranges::sort(slept, {}, pair_of);
  }
  // Before this step and after it.
  bool slept_through(const Touch<D>& touch) const {
    const auto rests = [&](BodyId id) {
      const std::uint32_t place = in_world(id), i = local(place);
      return !world.bodies_[place].stirs() && (i == kNone || !moved[i].stirs());
    };
    return rests(touch.record.a) && rests(touch.record.b) && !is_in(touching, pair_of(touch));
  }

 private:
  void fill(IslandPair<D>& pair, const NearPair& from) const {
    pair.rows.a = from.a;
    pair.rows.b = from.b;
    pair.rows.restitution = from.restitution;
    pair.rows.friction = from.friction;
    pair.reach = from.reach;
    pair.fast = from.fast;
    pair.located = from.located;
    pair.pressed = !from.located;
    pair.before = from.touch;
    pair.record.a = moved[from.a].id;
    pair.record.b = moved[from.b].id;
    if (from.manifold != kNone) pair.found = &manifolds[from.manifold];
    pair.look_back();
  }

  // Slow, and slow for another second if it is accelerated as in this step: a pendulum at its
  // turning point is not at rest.
  bool is_slow(std::size_t place) const {
    const Body<D>& body = moved[place];
    const Body<D>& before = world.bodies_[places[place]];
    const double gained = glm::length(body.velocity - before.velocity) / h;
    const Spin<D> spin = angular_velocity(body), spin_before = angular_velocity(before);
    const Spin<D> turned_faster = spin - spin_before;
    const double spun = std::sqrt(dot(turned_faster, turned_faster)) / h;
    // What is pushed out of another one moves, too, though it has no velocity.
    const double way = glm::length(body.position - before.position) / h;
    return std::max(glm::length(body.velocity), way) + gained <= world.config_.sleep_speed &&
           std::sqrt(dot(spin, spin)) + spun <= world.config_.sleep_spin;
  }
};

}  // namespace lantern::physics
